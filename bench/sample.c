// sample.c - measured values of one kind: median, smallest, number.
#include "sample.h"

#include "base/mem.h"

#include <stdlib.h>

void samples_add(struct samples *s, double value)
{
    array_reserve(&s->values, &s->capacity, s->count + 1);
    uint32_t i = s->count++;
    for (; i > 0 && s->values[i - 1] > value; i--) // kept sorted: there are few
        s->values[i] = s->values[i - 1];
    s->values[i] = value;
}

double samples_median(const struct samples *s)
{
    if (!s->count)
        return 0;
    return (s->values[(s->count - 1) / 2] + s->values[s->count / 2]) / 2;
}

double samples_least(const struct samples *s)
{
    return s->count ? s->values[0] : 0;
}

double samples_most(const struct samples *s)
{
    return s->count ? s->values[s->count - 1] : 0;
}

void samples_free(struct samples *s)
{
    free(s->values);
    *s = (struct samples){0};
}
