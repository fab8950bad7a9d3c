// options.h - what test_oracle is asked to do.
#pragma once
#include "render/device.h"

struct options {
    bool agree; // compare two ways to draw
    const char *mode;
    const char *file; // NULL: random trees
    int width, height;
    uint32_t count, threads;
    uint64_t seed;
    bool one_pixel;
    int x, y;
    enum walk walk;
    bool gl;      // the device under test
    bool array;   // it walks by the array method
    bool budgets; // and with other slabs and memory, which may change nothing
    size_t memory;
    uint32_t slabs;
};

bool options_parse(struct options *out, int argc, char **argv); // false: it has said what is wrong
