// sample.h - measured values of one kind: median, smallest, number.
#pragma once
#include <stdint.h>

struct samples { // {0} is valid
    double *values;
    uint32_t count, capacity;
};

void samples_add(struct samples *s, double value);
double samples_median(const struct samples *s); // 0 when there is none
double samples_least(const struct samples *s);  // 0 when there is none
double samples_most(const struct samples *s);   // 0 when there is none
void samples_free(struct samples *s);           // leaves {0}
