// simd.h - eight floats at a time, through the vector types of gcc and clang.
//
// Everything here means the same on every processor: without AVX the compiler splits each
// operation.
#pragma once
#include <math.h>
#include <stdint.h>
#ifdef __AVX__
#include <immintrin.h>
#endif

typedef float v8f __attribute__((vector_size(32)));
typedef int32_t v8i __attribute__((vector_size(32))); // comparisons give -1 or 0 in each lane

typedef double v4d __attribute__((vector_size(32))); // four doubles
typedef int64_t v4l __attribute__((vector_size(32)));
typedef float v4f __attribute__((vector_size(16)));

static inline v4d v4_set(double a)
{
    return (v4d){a, a, a, a};
}

// x within [-limit, limit].
static inline v4d v4_clamp(v4d x, double limit)
{
#ifdef __AVX__
    x = (v4d)_mm256_min_pd((__m256d)x, (__m256d)v4_set(limit));
    return (v4d)_mm256_max_pd((__m256d)x, (__m256d)v4_set(-limit));
#else
    v4l low = x < v4_set(limit);
    x = (v4d)(((v4l)x & low) | ((v4l)v4_set(limit) & ~low));
    v4l high = x > v4_set(-limit);
    return (v4d)(((v4l)x & high) | ((v4l)v4_set(-limit) & ~high));
#endif
}

static inline v8f v8_set(float a)
{
    return (v8f){a, a, a, a, a, a, a, a};
}

static inline v8i v8_seti(int32_t a)
{
    return (v8i){a, a, a, a, a, a, a, a};
}

// a > b ? a : b in each lane.
static inline v8f v8_max(v8f a, v8f b)
{
#ifdef __AVX__
    return (v8f)_mm256_max_ps((__m256)a, (__m256)b);
#else
    v8i more = a > b;
    return (v8f)(((v8i)a & more) | ((v8i)b & ~more));
#endif
}

// a < b ? a : b in each lane.
static inline v8f v8_min(v8f a, v8f b)
{
#ifdef __AVX__
    return (v8f)_mm256_min_ps((__m256)a, (__m256)b);
#else
    v8i less = a < b;
    return (v8f)(((v8i)a & less) | ((v8i)b & ~less));
#endif
}

static inline v8f v8_select(v8i mask, v8f yes, v8f no)
{
    return (v8f)(((v8i)yes & mask) | ((v8i)no & ~mask));
}

static inline v8i v8_selecti(v8i mask, v8i yes, v8i no)
{
    return (yes & mask) | (no & ~mask);
}

static inline v8f v8_abs(v8f a)
{
    return (v8f)((v8i)a & v8_seti(0x7fffffff));
}

// Bit i: lane i of the mask.
static inline int v8_bits(v8i mask)
{
#ifdef __AVX__
    return _mm256_movemask_ps((__m256)mask);
#else
    int bits = 0;
    for (int i = 0; i < 8; i++)
        bits |= (mask[i] & 1) << i;
    return bits;
#endif
}

static inline v8f v8_sqrt(v8f a)
{
#ifdef __AVX__
    return (v8f)_mm256_sqrt_ps((__m256)a);
#else
    for (int i = 0; i < 8; i++)
        a[i] = sqrtf(a[i]);
    return a;
#endif
}

// Lane i of the result is lane order[i] of a.
static inline v8f v8_permute(v8f a, v8i order)
{
#ifdef __AVX2__
    return (v8f)_mm256_permutevar8x32_ps((__m256)a, (__m256i)order);
#else
    v8f r;
    for (int i = 0; i < 8; i++)
        r[i] = a[order[i]];
    return r;
#endif
}

static inline float v8_lowest(v8f a)
{
    a = v8_min(a, __builtin_shufflevector(a, a, 4, 5, 6, 7, 0, 1, 2, 3));
    a = v8_min(a, __builtin_shufflevector(a, a, 2, 3, 0, 1, 6, 7, 4, 5));
    return a[0] < a[1] ? a[0] : a[1];
}

static inline float v8_highest(v8f a)
{
    a = v8_max(a, __builtin_shufflevector(a, a, 4, 5, 6, 7, 0, 1, 2, 3));
    a = v8_max(a, __builtin_shufflevector(a, a, 2, 3, 0, 1, 6, 7, 4, 5));
    return a[0] > a[1] ? a[0] : a[1];
}
