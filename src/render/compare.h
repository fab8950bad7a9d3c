// compare.h - how much two pictures differ.
#pragma once
#include <stdint.h>

struct comparison {
    uint64_t differing; // pixels
    int largest;        // difference of a channel, 0 to 255
    int x, y;           // the first pixel that has it
};

// Both have four channels, not multiplied by alpha; colours of pixels that are invisible in both do
// not count. A pixel differs when a channel does by more than `allowed`.
struct comparison pictures_compare(const uint8_t *a, const uint8_t *b, int width, int height,
                                   int allowed);
