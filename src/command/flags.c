// flags.c - values that name members of a set, between commas.
#include "command/flags.h"

#include <string.h>

bool flags_parse(uint32_t *out, const char *text, const struct flag_name *names, size_t count,
                 const char *option, const char *expected, struct error *err)
{
    for (size_t length; text; text = text[length] ? text + length + 1 : NULL) {
        size_t i = 0;
        length = strcspn(text, ",");
        while (i < count &&
               (strlen(names[i].name) != length || memcmp(names[i].name, text, length) != 0))
            i++;
        if (i == count) {
            error_set(err, "--%s: expected %s, got '%.*s'", option, expected, (int)length, text);
            return false;
        }
        *out |= names[i].bits;
    }
    return true;
}
