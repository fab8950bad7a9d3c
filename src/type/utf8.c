// utf8.c - is this text UTF-8?
#include "type/utf8.h"

#include <stdint.h>

// The bytes that follow the first one; -1 when nothing starts with it.
static int bytes_after(unsigned char first)
{
    return first < 0x80                     ? 0
           : first >= 0xC2 && first <= 0xDF ? 1
           : first >= 0xE0 && first <= 0xEF ? 2
           : first >= 0xF0 && first <= 0xF4 ? 3
                                            : -1;
}

bool utf8_is_valid(const char *text)
{
    static const uint32_t least[] = {0, 0x80, 0x800, 0x10000};

    for (const unsigned char *s = (const unsigned char *)text; *s; s++) {
        int more = bytes_after(*s);
        if (more < 0)
            return false;
        uint32_t c = more ? *s & (0x3Fu >> more) : *s;
        for (int i = 0; i < more; i++) {
            if ((*++s & 0xC0) != 0x80)
                return false;
            c = c << 6 | (*s & 0x3F);
        }
        if (c < least[more] || c > 0x10FFFF || (c >= 0xD800 && c < 0xE000))
            return false;
    }
    return true;
}
