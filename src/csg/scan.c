// scan.c - the values of numbers and strings.
#include "csg/parser.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool is_digit(char c)
{
    return (unsigned char)(c - '0') < 10;
}

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

static bool is_word(char c)
{
    return isalnum((unsigned char)c) || c == '_' || c == '$';
}

void csg_count_lines(struct csg_parser *p, const char *from, const char *to)
{
    for (; (from = memchr(from, '\n', (size_t)(to - from))); from++) {
        p->line++;
        p->line_start = from + 1;
    }
}

// strtod, but with a decimal point in every locale.
static double slow_number(struct csg_parser *p, const char *text, char **end)
{
    if (!p->c_locale)
        p->c_locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    return strtod_l(text, end, p->c_locale);
}

// Up to 19 digits and a small power of ten: both are exact doubles when the digits fit 53 bits, and
// one correctly rounded operation gives what strtod gives. Everything else is strtod's.
double csg_scan_number(struct csg_parser *p, const char *text, const char **end)
{
    static const double powers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                    1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                    1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    const char *s = text;
    uint64_t digits = 0;
    int32_t count = 0, exponent = 0;

    for (; is_digit(*s) && count < 19; s++, count += digits != 0)
        digits = digits * 10 + (uint64_t)(*s - '0');
    if (*s == '.') {
        const char *point = ++s;
        for (; is_digit(*s) && count < 19; s++, count += digits != 0)
            digits = digits * 10 + (uint64_t)(*s - '0');
        exponent = s - point > 400 ? -400 : (int32_t)(point - s);
    }
    if (is_digit(*s))
        count = INT32_MAX;
    else if (*s == 'e' || *s == 'E') {
        bool negative = s[1] == '-';
        int32_t written = 0;
        for (s += s[1] == '-' || s[1] == '+' ? 2 : 1; is_digit(*s); s++)
            written = written < 10000 ? written * 10 + (*s - '0') : written;
        exponent += negative ? -written : written;
    }
    *end = s;
    if (count <= 19 && digits <= (uint64_t)1 << 53 && exponent >= -22 && exponent <= 22)
        return exponent < 0 ? (double)digits / powers[-exponent]
                            : (double)digits * powers[exponent];
    char *stop;
    double value = slow_number(p, text, &stop);
    *end = stop;
    return value;
}

// -1 for what is none.
static int hex_digit(char c)
{
    return is_digit(c)            ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
}

double csg_scan_hex(const char *text)
{
    double value = 0;
    for (text += 2; hex_digit(*text) >= 0; text++)
        value = value * 16 + hex_digit(*text);
    return value;
}

// Also counts the lines.
static const char *skip_blanks_in(struct csg_parser *p, const char *s)
{
    for (; is_blank(*s); s++)
        if (*s == '\n') {
            p->line++;
            p->line_start = s + 1;
        }
    return s;
}

// One element of a vector of numbers: returns its end, NULL when it is no plain number.
static const char *scan_element(struct csg_parser *p, const char *s, double *number)
{
    bool negative = *s == '-';
    s += *s == '-' || *s == '+';
    if (is_digit(*s) || (*s == '.' && is_digit(s[1]))) {
        *number = csg_scan_number(p, s, &s);
        if (!is_digit(s[-1]) && s[-1] != '.')
            return NULL; // an exponent without digits
    } else if (strncmp(s, "inf", 3) == 0 || strncmp(s, "nan", 3) == 0) {
        *number = *s == 'i' ? (double)INFINITY : (double)NAN;
        s += 3;
    } else
        return NULL;
    if (negative)
        *number = -*number;
    return s;
}

// A vector of numbers from past its '[' to past its ']', or NULL.
static const char *scan_row(struct csg_parser *p, const char *s, struct csg_value *value)
{
    uint32_t count = 0;
    double *copy = NULL;

    s = skip_blanks_in(p, s);
    while (*s != ']') {
        if (count == p->number_capacity)
            array_reserve(&p->numbers, &p->number_capacity, (size_t)count + 1);
        s = scan_element(p, s, &p->numbers[count++]);
        if (!s)
            return NULL;
        s = skip_blanks_in(p, s);
        if (*s == ']')
            break;
        if (*s != ',')
            return NULL;
        s = skip_blanks_in(p, s + 1);
        if (*s == ']')
            return NULL;
    }
    if (count) {
        copy = arena_alloc(&p->tree.arena, count * sizeof *copy);
        memcpy(copy, p->numbers, count * sizeof *copy);
    }
    *value = (struct csg_value){.kind = CSG_NUMBERS, .count = count, .numbers = copy};
    return s + 1;
}

// A vector of such vectors, from its first '[' inside to past its ']', or NULL.
static const char *scan_rows(struct csg_parser *p, const char *s, struct csg_value *value)
{
    uint32_t before = p->value_count;

    while (*s == '[') {
        struct csg_value row;
        s = scan_row(p, s + 1, &row);
        if (!s)
            break;
        csg_push_value(p, row);
        s = skip_blanks_in(p, s);
        if (*s == ']') {
            *value = csg_vector(p, p->value_count - before);
            return s + 1;
        }
        if (*s != ',')
            break;
        s = skip_blanks_in(p, s + 1);
    }
    p->value_count = before;
    return NULL;
}

const char *csg_scan_numbers(struct csg_parser *p, const char *text, struct csg_value *value)
{
    uint32_t line = p->line;
    const char *line_start = p->line_start, *s = skip_blanks_in(p, text + 1);

    s = *s == '[' ? scan_rows(p, s, value) : scan_row(p, s, value);
    if (!s) { // its parts will be tokens
        p->line = line;
        p->line_start = line_start;
    }
    return s;
}

static const char *skip_blanks(const char *s)
{
    while (is_blank(*s))
        s++;
    return s;
}

static const char *skip_word(const char *s)
{
    while (is_word(*s))
        s++;
    return s;
}

// The first quote that is not escaped, or the zero byte behind the text.
static const char *closing_quote(const char *s)
{
    for (;;) {
        s += strcspn(s, "\"\\");
        if (*s != '\\' || !s[1])
            return *s == '\\' ? s + 1 : s;
        s += 2;
    }
}

// ", name =" or ")" with what ends a call: in an export nothing else follows a named string.
static bool export_follows(const char *s)
{
    s = skip_blanks(s);
    if (*s == ')') {
        s = skip_blanks(s + 1);
        return *s == ';' || *s == '{' || !*s;
    }
    if (*s != ',')
        return false;
    const char *name = skip_blanks(s + 1), *rest = skip_blanks(skip_word(name));
    return skip_word(name) > name && rest[0] == '=' && rest[1] != '=';
}

// Could this follow the closing quote of the string in `name = "..."`?
static bool any_follows(const char *s)
{
    s = skip_blanks(s);
    if (*s != ',')
        return !*s || strchr(")];/", *s);
    s = skip_blanks(s + 1);
    const char *rest = s;
    while (is_word(*rest) || *rest == '.' || *rest == '+' || *rest == '-')
        rest++;
    return rest == s || strchr("=,)", *skip_blanks(rest));
}

// OpenSCAD exports the strings of text() without escapes: those that hold a quote or end in a
// backslash are broken. The true end of such a string in the line, or NULL.
static const char *raw_end(struct csg_parser *p, const char *text)
{
    const char *line_end = text + strcspn(text, "\n");

    if (text < p->no_raw_end)
        return NULL;
    for (const char *s = text; (s = memchr(s, '"', (size_t)(line_end - s))); s++)
        if (export_follows(s + 1))
            return s;
    p->no_raw_end = line_end; // or a line of nothing but quotes would take forever
    return NULL;
}

// Does the text follow the pattern, in which # is anything but a comma, a quote or a line's end?
static bool follows(const char *s, const char *pattern)
{
    for (; *pattern; pattern++) {
        if (*pattern == '#')
            s += strcspn(s, ",\"\n");
        else if (*s++ != *pattern)
            return false;
    }
    return true;
}

// Is this the text or the font of a text() as OpenSCAD exports it? Then backslashes, too, are part
// of it. Exports have all arguments, in this order and with these blanks; nobody writes that by
// hand.
static bool is_exported(const struct csg_parser *p, const char *quote, const char *close)
{
    static const struct {
        const char *before, *after;
    } exports[] = {{"text(text = ", ", size = #, spacing = #, font = \""},
                   {", font = ", ", direction = \"#\", language = \"#\", "}};

    for (size_t i = 0; i < sizeof exports / sizeof *exports; i++) {
        size_t length = strlen(exports[i].before);
        if ((size_t)(quote - p->text) >= length &&
            memcmp(quote - length, exports[i].before, length) == 0 &&
            follows(close + 1, exports[i].after))
            return true;
    }
    return false;
}

static char *put_utf8(char *out, uint32_t c)
{
    if (c > 0x10FFFF || (c >= 0xD800 && c < 0xE000))
        c = 0xFFFD;
    if (c < 0x80) {
        *out++ = (char)(c ? c : ' ');
        return out;
    }
    int more = c < 0x800 ? 1 : c < 0x10000 ? 2 : 3;
    *out++ = (char)(0xFFu << (7 - more) | c >> 6 * more);
    while (more--)
        *out++ = (char)(0x80u | ((c >> 6 * more) & 0x3F));
    return out;
}

// The character of `digits` hex digits at s.
static bool hex_escape(const char *s, int digits, uint32_t *c)
{
    *c = 0;
    for (int i = 0; i < digits; i++) {
        int digit = hex_digit(s[i]);
        if (digit < 0)
            return false;
        *c = *c << 4 | (uint32_t)digit;
    }
    return true;
}

// Writes what the text between from and to means; returns its end. An escape that is none only
// loses its backslash.
static char *unescape(char *out, const char *from, const char *to)
{
    while (from < to) {
        uint32_t c;
        if (*from != '\\' || from + 1 == to) {
            *out++ = *from++;
            continue;
        }
        char kind = from[1];
        int digits = kind == 'x' ? 2 : kind == 'u' ? 4 : kind == 'U' ? 6 : 0;
        from += 2;
        if (digits && to - from >= digits && hex_escape(from, digits, &c) &&
            (kind != 'x' || c < 0x80)) {
            out = put_utf8(out, c);
            from += digits;
            continue;
        }
        *out++ = (char)(kind == 'n' ? '\n' : kind == 't' ? '\t' : kind == 'r' ? '\r' : kind);
    }
    return out;
}

static bool after_equals(struct csg_parser *p, const char *quote)
{
    do
        quote--;
    while (quote >= p->text && is_blank(*quote));
    return quote >= p->text && *quote == '=';
}

// The rule for strings: a string ends at the first quote without a backslash, and escapes mean what
// they mean in OpenSCAD, as long as something follows that can follow a string. Otherwise, and
// where all of an exported text() follows, the string is one that OpenSCAD wrote without escapes:
// all characters mean themselves, and it ends at the first quote before another argument or the
// end.
const char *csg_scan_string(struct csg_parser *p, const char *quote, struct csg_value *value)
{
    const char *text = quote + 1, *close = closing_quote(text), *raw = NULL;

    if (after_equals(p, quote) && (!*close || !any_follows(close + 1)))
        raw = raw_end(p, text);
    else if (memchr(text, '\\', (size_t)(close - text)) && is_exported(p, quote, close))
        raw = close;
    bool lines = memchr(text, '\n', (size_t)(close - text)) != NULL;
    if (!raw && (!*close || (lines && !any_follows(close + 1)))) {
        p->unclosed_end = text + strcspn(text, "\n");
        *value = (struct csg_value){.kind = CSG_STRING, .string = ""};
        csg_error(p, quote, "this string is never closed: '\"' is missing");
        return p->unclosed_end;
    }
    const char *end = raw ? raw : close;
    char *copy = arena_alloc(&p->tree.arena, (size_t)(end - text) + 1), *last;
    if (raw)
        last = (char *)memcpy(copy, text, (size_t)(end - text)) + (end - text);
    else
        last = unescape(copy, text, end);
    *last = 0;
    *value = (struct csg_value){CSG_STRING, (uint32_t)(last - copy), .string = copy};
    csg_count_lines(p, text, end);
    return end + 1;
}
