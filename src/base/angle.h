// angle.h - sine and cosine of degrees.
#pragma once

// Exact at multiples of 30 and 45; NaN for numbers too large to have a fraction of a turn.
double sin_degrees(double x);
double cos_degrees(double x);
