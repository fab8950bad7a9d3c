// pace.h - how fine a picture may be to follow the hand: learnt from the frames before.
#pragma once

// Time of a frame as a line over its pixels, fitted to the frames seen, the newest counting most.
// {0} knows nothing yet.
struct pace {
    double weight, pixels, seconds, pixels_squared, product; // sums over the frames
};

void pace_add(struct pace *p, double pixels, double seconds);

// The least number of window pixels, across, that one of the picture has to stand for so that a
// frame takes `most` seconds at most. Where even few pixels take longer, only as much is given up
// as makes a difference.
enum { PACE_DIVISOR_MOST = 8 };
int pace_divisor(const struct pace *p, int width, int height, double most);
