// values.c - random values of the classes.
#include "hcsg/values.h"

#include "base/hash.h"
#include "base/mem.h"
#include "hcsg/share.h"

#include <stdbool.h>
#include <stdlib.h>

// Adds a number to a set of non-zero numbers; false when it is there. `mask` + 1 places.
static bool set_add(uint32_t *set, uint32_t mask, uint32_t number)
{
    uint32_t i = number & mask;
    for (; set[i]; i = (i + 1) & mask)
        if (set[i] == number)
            return false;
    set[i] = number;
    return true;
}

void values_fill(struct value_class *classes, uint32_t count, uint64_t seed)
{
    for (uint32_t i = 0; i < count; i++)
        classes[i].value = 0;
    values_fill_rest(classes, count, seed);
}

void values_fill_rest(struct value_class *classes, uint32_t count, uint64_t seed)
{
    uint64_t places = 16;
    while (places < (uint64_t)count * 2)
        places *= 2;
    uint32_t *used = mem_zalloc(places * sizeof *used);
    for (uint32_t i = 0; i < count; i++)
        if (classes[i].value)
            set_add(used, (uint32_t)(places - 1), (uint32_t)classes[i].value);
    for (uint32_t i = 0; i < count; i++) {
        uint64_t value;
        if (classes[i].value)
            continue;
        do
            value = random_next(&seed) & VALUE_MASK;
        while ((uint32_t)value == 0 || !set_add(used, (uint32_t)(places - 1), (uint32_t)value));
        classes[i].value = value;
    }
    free(used);
}

void values_renew(struct value_class *classes, uint32_t count, uint64_t *state)
{
    for (uint32_t i = 0; i < count; i++) {
        uint64_t secondary = random_next(state) << VALUE_PRIMARY_BITS & VALUE_MASK;
        classes[i].value = secondary | (uint32_t)classes[i].value;
    }
}
