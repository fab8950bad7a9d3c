// angle.c - sine and cosine of degrees.
#include "base/angle.h"

#include <math.h>
#include <stdbool.h>

// For x in [0, 90].
static double sin_quadrant(double x)
{
    if (x == 30)
        return 0.5;
    if (x == 45)
        return M_SQRT1_2;
    if (x == 60)
        return 0.86602540378443864676;
    if (x == 90)
        return 1;
    return x < 45 ? sin(x * (M_PI / 180)) : cos((90 - x) * (M_PI / 180));
}

double sin_degrees(double x)
{
    if (!(fabs(x) < 360 * 0x1p52))
        return NAN;
    x -= 360 * floor(x / 360);
    bool negative = x >= 180;
    if (negative)
        x -= 180;
    double s = sin_quadrant(x > 90 ? 180 - x : x);
    return negative ? -s : s;
}

double cos_degrees(double x)
{
    if (!(fabs(x) < 360 * 0x1p52))
        return NAN;
    x -= 360 * floor(x / 360);
    if (x > 180)
        x = 360 - x;
    return x > 90 ? -sin_quadrant(x - 90) : sin_quadrant(90 - x);
}
