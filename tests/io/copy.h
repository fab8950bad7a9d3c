// copy.h - input of exactly its size and the one zero byte, so that sanitizers see reads beyond.
#pragma once
#include "base/mem.h"

#include <string.h>

static inline char *exact_copy(const void *data, size_t size)
{
    char *copy = mem_zalloc(size + 1);
    memcpy(copy, data, size);
    return copy;
}
