// clock.h - seconds since some fixed moment, monotonic.
#pragma once

double clock_seconds(void);
