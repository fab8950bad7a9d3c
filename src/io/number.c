// number.c - decimal numbers in text, whatever the locale of the program.
#include "io/number.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

// Adds the digits at *p to a mantissa of 19 digits at most; how many there were.
static int add_digits(const char **p, uint64_t *mantissa)
{
    const char *begin = *p;
    for (; **p >= '0' && **p <= '9' && *mantissa < UINT64_C(1000000000000000000); ++*p)
        *mantissa = *mantissa * 10 + (uint64_t)(**p - '0');
    return (int)(*p - begin);
}

// An exponent of up to three digits, if there is one.
static int read_exponent(const char **p)
{
    const char *at = *p;
    if (*at != 'e' && *at != 'E')
        return 0;
    at++;
    bool negative = *at == '-';
    at += negative || *at == '+';
    uint64_t value = 0;
    const char *digits = at;
    while (at < digits + 3 && *at >= '0' && *at <= '9')
        value = value * 10 + (uint64_t)(*at++ - '0');
    if (at > digits)
        *p = at;
    return negative ? -(int)value : (int)value;
}

// Numbers of up to 15 digits near 1, which nearly all are: the mantissa and the power of ten are
// exact then, and one operation rounds their product or quotient as strtod does.
static bool read_short(const char *p, double *out, const char **stop)
{
    static const double powers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                    1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                    1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    bool negative = *p == '-';
    p += negative || *p == '+';
    uint64_t mantissa = 0;
    int digits = add_digits(&p, &mantissa), decimals = 0;
    if (*p == '.') {
        p++;
        decimals = add_digits(&p, &mantissa);
    }
    if (digits + decimals == 0 || mantissa > UINT64_C(1) << 53)
        return false;
    int exponent = read_exponent(&p) - decimals;
    if (exponent < -22 || exponent > 22)
        return false;
    // Whatever else may belong to the number is strtod's: more digits, a longer exponent.
    if ((*p >= '0' && *p <= '9') || (*p >= 'A' && *p <= 'Z') || (*p >= 'a' && *p <= 'z'))
        return false;
    double value = (double)mantissa;
    value = exponent < 0 ? value / powers[-exponent] : value * powers[exponent];
    *out = negative ? -value : value;
    *stop = p;
    return true;
}

bool number_read(const char *text, locale_t numbers, double *out, const char **stop)
{
    if (read_short(text, out, stop))
        return true;
    const char *digits = text + (*text == '-' || *text == '+');
    if (digits[0] == '0' && (digits[1] | 32) == 'x')
        return false; // strtod would read it
    char *after;
    double value = strtod_l(text, &after, numbers);
    if (after == text || !isfinite(value))
        return false;
    *out = value;
    *stop = after;
    return true;
}
