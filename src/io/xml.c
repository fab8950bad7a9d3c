// xml.c - the elements of an XML file that a format knows, as they come, through expat.
#include "io/xml.h"

#include "base/mem.h"
#include "io/number.h"

#include <expat.h>
#include <limits.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

struct xml {
    XML_Parser parser;
    const struct xml_format *format;
    void *user;
    const char *path;
    struct error *err;
    int *inside; // the known elements that the reader is in, the innermost last
    uint32_t depth, room;
    uint64_t unknown; // unknown elements that it is in, within these
    char text[XML_TEXT_MOST + 1];
    size_t text_length; // more than XML_TEXT_MOST: too long
    bool failed;
    locale_t numbers;
};

void xml_error(struct xml *x, const char *format, ...)
{
    char what[512];
    va_list args;
    va_start(args, format);
    vsnprintf(what, sizeof what, format, args);
    va_end(args);
    error_at(x->err, (struct place){x->path, (uint32_t)XML_GetCurrentLineNumber(x->parser), 0},
             "%s", what);
    x->failed = true;
}

static void stop(struct xml *x)
{
    x->failed = true;
    XML_StopParser(x->parser, XML_FALSE);
}

// The id of an element within the one that the reader is in, or 0.
static int find_element(const struct xml *x, const char *name)
{
    const struct xml_format *f = x->format;
    const char *separator = strchr(name, *XML_SEPARATOR);
    if (f->xmlns && (!separator || strlen(f->xmlns) != (size_t)(separator - name) ||
                     memcmp(name, f->xmlns, (size_t)(separator - name)) != 0))
        return 0;
    const char *local = separator ? separator + 1 : name;
    int parent = x->depth ? x->inside[x->depth - 1] : 0;
    for (size_t i = 0; i < f->element_count; i++)
        if (f->elements[i].parent == parent && strcmp(f->elements[i].name, local) == 0)
            return f->elements[i].id;
    return 0;
}

static void XMLCALL on_start(void *user, const char *name, const char **attributes)
{
    struct xml *x = user;
    if (x->failed)
        return; // expat ends only after the element at hand
    int id = x->unknown ? 0 : find_element(x, name);
    if (!id) {
        x->unknown++;
        return;
    }
    array_reserve(&x->inside, &x->room, (size_t)x->depth + 1);
    x->inside[x->depth++] = id;
    x->text_length = 0;
    if (x->format->open && !x->format->open(x->user, x, id, attributes))
        stop(x);
}

static void XMLCALL on_end(void *user, const char *name)
{
    (void)name;
    struct xml *x = user;
    if (x->failed)
        return;
    if (x->unknown) {
        x->unknown--;
        return;
    }
    int id = x->inside[--x->depth];
    x->text[x->text_length <= XML_TEXT_MOST ? x->text_length : 0] = 0;
    x->text_length = 0;
    if (x->format->close && !x->format->close(x->user, x, id, x->text))
        stop(x);
}

static void XMLCALL on_text(void *user, const char *text, int length)
{
    struct xml *x = user;
    if (x->unknown || x->failed || x->text_length > XML_TEXT_MOST)
        return;
    size_t n = (size_t)length, left = XML_TEXT_MOST - x->text_length;
    memcpy(x->text + x->text_length, text, n < left ? n : left);
    x->text_length += n;
}

// No such file needs entities of its own, and a few of them can stand for terabytes.
static void XMLCALL on_entity(void *user, const char *name, int is_parameter, const char *value,
                              int length, const char *base, const char *system_id,
                              const char *public_id, const char *notation)
{
    (void)name, (void)is_parameter, (void)value, (void)length, (void)base;
    (void)system_id, (void)public_id, (void)notation;
    struct xml *x = user;
    if (x->failed)
        return;
    xml_error(x, "the file declares entities");
    stop(x);
}

struct xml *xml_new(const char *path, const struct xml_format *format, void *user,
                    struct error *err)
{
    struct xml *x = mem_zalloc(sizeof *x);
    *x = (struct xml){.format = format, .user = user, .path = path, .err = err};
    x->parser = XML_ParserCreateNS(NULL, *XML_SEPARATOR);
    if (!x->parser) {
        error_set(err, "%s: XML: out of memory", path);
        free(x);
        return NULL;
    }
    x->numbers = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    XML_SetUserData(x->parser, x);
    XML_SetElementHandler(x->parser, on_start, on_end);
    XML_SetCharacterDataHandler(x->parser, on_text);
    XML_SetEntityDeclHandler(x->parser, on_entity);
    return x;
}

void xml_delete(struct xml *x)
{
    if (!x)
        return;
    XML_ParserFree(x->parser);
    if (x->numbers)
        freelocale(x->numbers);
    free(x->inside);
    free(x);
}

static bool parse(struct xml *x, const char *data, int size, bool last)
{
    if (x->failed)
        return false;
    if (XML_Parse(x->parser, data, size, last) == XML_STATUS_ERROR && !x->failed)
        xml_error(x, "XML: %s", XML_ErrorString(XML_GetErrorCode(x->parser)));
    return !x->failed;
}

bool xml_push(struct xml *x, const char *data, size_t size)
{
    for (size_t part; size; data += part, size -= part) {
        part = size < INT_MAX / 2 ? size : INT_MAX / 2;
        if (!parse(x, data, (int)part, false))
            return false;
    }
    return true;
}

bool xml_finish(struct xml *x)
{
    return parse(x, "", 0, true);
}

const char *xml_attribute(const char **attributes, const char *name)
{
    for (; *attributes; attributes += 2)
        if (strcmp(attributes[0], name) == 0)
            return attributes[1];
    return NULL;
}

static const char *skip_blanks(const char *text)
{
    return text + strspn(text, " \t\r\n");
}

bool xml_is_blank(const char *text)
{
    return *skip_blanks(text) == 0;
}

bool xml_next_number(const struct xml *x, const char **text, double *out)
{
    const char *stop;
    if (!number_read(skip_blanks(*text), x->numbers, out, &stop) ||
        (*stop && skip_blanks(stop) == stop))
        return false;
    *text = stop;
    return true;
}

bool xml_number(const struct xml *x, const char *text, double *out)
{
    return xml_next_number(x, &text, out) && xml_is_blank(text);
}

bool xml_count(const char *text, uint32_t *out)
{
    uint64_t value = 0;
    const char *p = text = skip_blanks(text);
    while (*p >= '0' && *p <= '9' && value <= UINT32_MAX)
        value = value * 10 + (uint64_t)(*p++ - '0');
    if (p == text || value > UINT32_MAX || !xml_is_blank(p))
        return false;
    *out = (uint32_t)value;
    return true;
}
