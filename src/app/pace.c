// pace.c - how fine a picture may be to follow the hand: learnt from the frames before.
#include "app/pace.h"

#include <math.h>

static const double kept = 0.7; // of what is known, at each new frame

void pace_add(struct pace *p, double pixels, double seconds)
{
    p->weight = kept * p->weight + 1;
    p->pixels = kept * p->pixels + pixels;
    p->seconds = kept * p->seconds + seconds;
    p->pixels_squared = kept * p->pixels_squared + pixels * pixels;
    p->product = kept * p->product + pixels * seconds;
}

// Seconds of a frame without pixels, and for each pixel.
static void fit(const struct pace *p, double *fixed, double *each)
{
    double pixels = p->pixels / p->weight, seconds = p->seconds / p->weight;
    double spread = p->pixels_squared / p->weight - pixels * pixels;
    double rise = p->product / p->weight - pixels * seconds;
    *each = seconds / pixels;
    if (spread > 0.01 * pixels * pixels) // frames of several sizes
        *each = fmin(fmax(rise / spread, 0), *each);
    *fixed = seconds - *each * pixels;
}

int pace_divisor(const struct pace *p, int width, int height, double most)
{
    if (p->weight == 0)
        return 1;
    double fixed, each, pixels = (double)width * height;
    fit(p, &fixed, &each);
    double room = fmax(most - fixed, fixed / 2);
    int divisor = 1;
    while (divisor < PACE_DIVISOR_MOST && each * pixels / (divisor * divisor) > room)
        divisor++;
    return divisor;
}
