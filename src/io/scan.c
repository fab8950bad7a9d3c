// scan.c - words and numbers of a text file, by line, whatever the locale.
#include "io/scan.h"

#include "io/number.h"

#include <string.h>

void scan_open(struct scan *s, const char *path, const char *data, size_t size)
{
    *s = (struct scan){.at = data, .end = data + size, .path = path, .line = 1};
    s->numbers = newlocale(LC_ALL_MASK, "C", (locale_t)0);
}

void scan_close(struct scan *s)
{
    if (s->numbers)
        freelocale(s->numbers);
    s->numbers = (locale_t)0;
}

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v' || c == 0;
}

void scan_skip_line(struct scan *s)
{
    const char *newline = memchr(s->at, '\n', (size_t)(s->end - s->at));
    s->at = newline ? newline + 1 : s->end;
    s->line += newline != NULL;
}

bool scan_in_line(struct scan *s)
{
    while (s->at < s->end && is_blank(*s->at))
        s->at++;
    return s->at < s->end && *s->at != '\n' && !(s->hash_comments && *s->at == '#');
}

bool scan_to_word(struct scan *s)
{
    while (!scan_in_line(s)) {
        if (s->at == s->end)
            return false;
        scan_skip_line(s);
    }
    return true;
}

static bool in_word(const struct scan *s, const char *p)
{
    return p < s->end && *p != '\n' && !is_blank(*p) && !(s->hash_comments && *p == '#');
}

size_t scan_word(struct scan *s, const char **word)
{
    *word = s->at;
    while (in_word(s, s->at))
        s->at++;
    return (size_t)(s->at - *word);
}

bool scan_is(const char *word, size_t length, const char *text)
{
    return strlen(text) == length && memcmp(word, text, length) == 0;
}

bool scan_number(struct scan *s, double *out)
{
    if (!in_word(s, s->at))
        return false;
    const char *stop;
    double value;
    if (!number_read(s->at, s->numbers, &value, &stop) || stop > s->end || in_word(s, stop))
        return false;
    s->at = stop;
    *out = value;
    return true;
}

bool scan_count(struct scan *s, uint32_t *out)
{
    const char *p = s->at;
    uint64_t value = 0;
    while (p < s->end && *p >= '0' && *p <= '9' && value <= UINT32_MAX)
        value = value * 10 + (uint64_t)(*p++ - '0');
    if (p == s->at || in_word(s, p) || value > UINT32_MAX)
        return false;
    s->at = p;
    *out = (uint32_t)value;
    return true;
}

void scan_error(const struct scan *s, struct error *err, const char *what)
{
    error_at(err, (struct place){s->path, s->line, 0}, "%s", what);
}
