// hash.c - hash of bytes.
#include "base/hash.h"

#include <string.h>

uint64_t hash_bytes(uint64_t seed, const void *data, size_t size)
{
    const unsigned char *p = data;
    uint64_t h = hash_mix(seed + 0x9e3779b97f4a7c15u + size);
    for (; size >= 8; p += 8, size -= 8) {
        uint64_t word;
        memcpy(&word, p, 8);
        h = hash_mix(h ^ word) + 0x9e3779b97f4a7c15u;
    }
    uint64_t rest = 0;
    if (size)
        memcpy(&rest, p, size);
    return hash_mix(h ^ rest);
}
