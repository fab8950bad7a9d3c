// compare.c - how much two pictures differ.
#include "render/compare.h"

#include <stddef.h>
#include <stdlib.h>

static int difference(const uint8_t *a, const uint8_t *b)
{
    int most = 0;
    if (!a[3] && !b[3])
        return 0;
    for (int k = 0; k < 4; k++)
        if (abs(a[k] - b[k]) > most)
            most = abs(a[k] - b[k]);
    return most;
}

struct comparison pictures_compare(const uint8_t *a, const uint8_t *b, int width, int height,
                                   int allowed)
{
    struct comparison c = {0};
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            size_t at = 4 * ((size_t)y * (size_t)width + (size_t)x);
            int d = difference(a + at, b + at);
            c.differing += d > allowed;
            if (d > c.largest) {
                c.largest = d;
                c.x = x;
                c.y = y;
            }
        }
    return c;
}
