// hash.h - 64-bit hashes and random numbers: splitmix64 (Steele, Lea, Flood 2014).
#pragma once
#include <stddef.h>
#include <stdint.h>

// A bijection of 64-bit numbers that mixes all bits (the finalizer of splitmix64).
static inline uint64_t hash_mix(uint64_t x)
{
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

// Hash of bytes; `seed` chains several calls.
uint64_t hash_bytes(uint64_t seed, const void *data, size_t size);

// The next number of a stream; any state is a good seed.
static inline uint64_t random_next(uint64_t *state)
{
    *state += 0x9e3779b97f4a7c15u;
    return hash_mix(*state);
}

// Uniform in [0, 1).
static inline double random_unit(uint64_t *state)
{
    return (double)(random_next(state) >> 11) * 0x1p-53;
}
