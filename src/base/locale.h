// locale.h - numbers with a point, whatever the locale of the program.
#pragma once
#include <locale.h>

struct own_locale {
    locale_t numbers, before;
};

static inline struct own_locale locale_enter(void)
{
    struct own_locale own = {.numbers = newlocale(LC_NUMERIC_MASK, "C", (locale_t)0)};
    own.before = uselocale(own.numbers);
    return own;
}

static inline void locale_leave(struct own_locale *own)
{
    uselocale(own->before);
    freelocale(own->numbers);
}
