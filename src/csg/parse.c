// parse.c - text to tree, and what is said about broken text.
#include "base/file.h"
#include "csg/parser.h"
#include "csg_grammar.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

enum { ERRORS_SHOWN = 20, LARGEST = 1 << 30 };

static struct place place_of(const struct csg_parser *p, const char *at, const char **line_start)
{
    struct place place = {.file = p->tree.file, .line = 1};
    const char *line = p->text, *next;

    while ((next = memchr(line, '\n', (size_t)(at - line)))) {
        line = next + 1;
        place.line++;
    }
    place.column = (uint32_t)(at - line) + 1;
    *line_start = line;
    return place;
}

void csg_error(struct csg_parser *p, const char *at, const char *format, ...)
{
    struct error text;
    const char *line;
    va_list args;

    if (p->stop)
        return;
    va_start(args, format); // before the scanner's zero byte goes away, which ends yytext
    vsnprintf(text.text, sizeof text.text, format, args);
    va_end(args);
    if (p->scanner)
        csg_scanner_show(p, true);
    struct place place = place_of(p, at, &line);
    p->errors++;
    if (p->errors > ERRORS_SHOWN) {
        messages_add(p->messages, MESSAGE_ERROR, (struct place){.file = place.file},
                     "too many errors, the rest of the file is not read");
        p->stop = true;
    } else {
        const char *line_end = memchr(line, '\n', (size_t)(p->end - line));
        messages_add(p->messages, MESSAGE_ERROR, place, "%s", text.text);
        messages_source(p->messages, line, (size_t)((line_end ? line_end : p->end) - line),
                        place.column);
    }
    if (p->scanner)
        csg_scanner_show(p, false);
}

// The newest token as messages name it: in quotes, cut when long.
static void token_words(const struct csg_parser *p, char *out, size_t size)
{
    enum { SHOWN = 32 };
    size_t length = (size_t)(p->token_end - p->token), shown = 0;

    if (!length) {
        snprintf(out, size, "the end of the file");
        return;
    }
    while (shown < length && shown < SHOWN && (unsigned char)p->token[shown] >= ' ')
        shown++;
    while (shown < length && shown && ((unsigned char)p->token[shown] & 0xC0) == 0x80)
        shown--; // not in the middle of a character
    const char *quote = *p->token == '"' ? "" : "'";
    snprintf(out, size, "%s%.*s%s%s", quote, (int)shown, p->token, shown < length ? "..." : "",
             quote);
}

void csg_error_token(struct csg_parser *p, const char *expected)
{
    char words[80];

    if (p->previous_end == p->unclosed_end)
        return; // nothing that follows fits, and the cause has been told
    token_words(p, words, sizeof words);
    if (!*expected)
        csg_error(p, p->token, "unexpected %s", words);
    else if (p->token_end == p->token)
        csg_error(p, p->previous_end, "expected %s before %s", expected, words);
    else if (memchr(p->previous_end, '\n', (size_t)(p->token - p->previous_end)))
        csg_error(p, p->previous_end, "expected %s at the end of the line", expected);
    else
        csg_error(p, p->token, "expected %s before %s", expected, words);
}

void csg_error_scad(struct csg_parser *p, const char *at, const char *what)
{
    char words[80];

    if (!what)
        token_words(p, words, sizeof words);
    csg_error(p, at,
              "%s belongs to OpenSCAD source, not to an exported .csg: open the .scad file itself",
              what ? what : words);
    p->stop = true;
}

void csg_error_name(struct csg_parser *p, struct csg_name name)
{
    const char *at = p->text;
    uint32_t line = 1;

    for (; line < name.line; line++)
        at = (const char *)memchr(at, '\n', (size_t)(p->end - at)) + 1;
    csg_error(p, at + name.column - 1,
              "'%.40s' is no value: variables and functions belong to OpenSCAD source, not to an "
              "exported .csg: open the .scad file itself",
              name.text);
    p->stop = true;
}

static void run(struct csg_parser *p, char *text, size_t size)
{
    const char *zero = memchr(text, 0, size);

    p->end = text + size;
    if (size >= 3 && memcmp(text, "\xEF\xBB\xBF", 3) == 0) {
        text += 3;
        size -= 3;
    }
    p->text = p->line_start = p->token = p->token_end = p->previous_end = text;
    p->line = 1;
    if (zero) {
        struct place place = {.file = p->tree.file};
        messages_add(p->messages, MESSAGE_ERROR, place, "not a text file: byte %zu is zero",
                     (size_t)(zero - text) + 1);
        p->errors++;
        return;
    }
    if (size > LARGEST || !csg_scanner_open(p, text, size)) {
        csg_error(p, p->text, "the file is too large: %zu bytes", size);
        return;
    }
    p->assign = csg_intern(p, CSG_ASSIGN, strlen(CSG_ASSIGN));
    if (csg_yyparse(p->scanner, p) != 0 && !p->errors)
        csg_error(p, p->token, "the file cannot be read");
    csg_scanner_close(p);
}

bool csg_parse(struct csg_tree *out, const char *file, char *text, size_t size,
               struct messages *messages)
{
    struct csg_parser p = {.messages = messages, .tree.file = mem_strdup(file)};
    bool ok;

    run(&p, text, size);
    free(p.names);
    free(p.numbers);
    free(p.values);
    free(p.arguments);
    free(p.braces);
    if (p.c_locale)
        freelocale(p.c_locale);
    ok = !p.errors;
    if (!ok)
        csg_free(&p.tree);
    *out = p.tree;
    return ok;
}

bool csg_parse_file(struct csg_tree *out, const char *path, struct messages *messages)
{
    struct error err;
    char *text;
    size_t size;

    *out = (struct csg_tree){0};
    if (!file_read(path, LARGEST, &text, &size, &err)) {
        messages_add(messages, MESSAGE_ERROR, (struct place){0}, "%s", err.text);
        return false;
    }
    bool ok = csg_parse(out, path, text, size, messages);
    free(text);
    return ok;
}

void csg_free(struct csg_tree *t)
{
    free(t->file);
    arena_free(&t->arena);
    *t = (struct csg_tree){0};
}
