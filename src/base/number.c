// number.c - numbers as text.
#include "base/number.h"

#include "base/locale.h"

#include <stdio.h>
#include <stdlib.h>

int number_shortest(char out[NUMBER_TEXT], double number, int least, int most)
{
    struct own_locale own = locale_enter();
    int length;
    do
        length = snprintf(out, NUMBER_TEXT, "%.*g", least, number);
    while (++least <= most && strtod(out, NULL) != number);
    locale_leave(&own);
    return length;
}
