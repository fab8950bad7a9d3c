// annotation.c - the language of the comments behind parameters: "[0:5:100]", "[S:Small, L:Large]".
#include "customizer/annotation.h"

#include "customizer/scan.h"

#include <stdlib.h>
#include <string.h>

enum { ITEMS_MOST = 3 }; // of an entry

// What follows an opening quote. One that is never closed ends with the comment.
struct literal annotation_string(struct annotation_parser *p, const char *text, size_t size)
{
    char *out = arena_alloc(p->arena, size + 1), *to = out;
    for (const char *end = text + size; text < end && *text != '"'; text++) {
        bool escape = *text == '\\';
        text += escape;
        if (text < end && *text)
            *to++ = (char)(escape && *text == 'n'   ? '\n'
                           : escape && *text == 't' ? '\t'
                           : escape && *text == 'r' ? '\r'
                                                    : *text);
    }
    *to = 0;
    return (struct literal){LITERAL_STRING, .text = out};
}

void annotation_word(struct annotation_parser *p, struct literal word)
{
    if (p->has_words)
        words_say(&p->words, " ");
    p->has_words = true;
    if (word.kind == LITERAL_NUMBER)
        words_number(&p->words, word.number, DIGITS_ALL);
    else
        words_say(&p->words, word.text);
}

struct literal annotation_words(struct annotation_parser *p)
{
    const char *text = arena_text(p->arena, p->words.data, p->words.size);
    p->words.size = 0;
    p->has_words = false;
    return (struct literal){LITERAL_STRING, .text = text};
}

void annotation_entry(struct annotation_parser *p, const struct literal *items, uint32_t count)
{
    uint32_t n = p->entry_count++;
    array_reserve(&p->entries, &p->entry_capacity, (size_t)ITEMS_MOST * p->entry_count);
    array_reserve(&p->sizes, &p->size_capacity, p->entry_count);
    memcpy(p->entries + (size_t)ITEMS_MOST * n, items, count * sizeof *items);
    p->sizes[n] = count;
}

static struct literal vector(struct annotation_parser *p, enum literal_kind kind,
                             const struct literal *items, uint32_t count)
{
    struct literal *copy = arena_alloc(p->arena, count * sizeof *copy);
    memcpy(copy, items, count * sizeof *copy);
    return (struct literal){kind, count, .items = copy};
}

// Numbers that are parted by colons and alone are a range; else two items are value and label.
bool annotation_list(struct annotation_parser *p, struct literal *out)
{
    uint32_t n = p->sizes[0], numbers = 0;
    for (uint32_t i = 0; i < n; i++)
        numbers += p->entries[i].kind == LITERAL_NUMBER;
    if (p->entry_count == 1 && n > 1 && numbers == n) {
        *out = vector(p, LITERAL_RANGE, p->entries, n);
        return true;
    }
    struct literal *items = arena_alloc(p->arena, p->entry_count * sizeof *items);
    for (uint32_t i = 0; i < p->entry_count; i++) {
        const struct literal *entry = p->entries + (size_t)ITEMS_MOST * i;
        if (p->sizes[i] > 2)
            return false;
        items[i] = p->sizes[i] == 2 ? vector(p, LITERAL_VECTOR, entry, 2) : *entry;
    }
    *out = (struct literal){LITERAL_VECTOR, p->entry_count, .items = items};
    return true;
}

struct literal annotation_read(struct arena *arena, const char *text, size_t size)
{
    struct annotation_parser p = {.arena = arena};
    if (size > SCAD_TEXT_MOST || !annotation_parse(&p, text, size))
        p.result = (struct literal){LITERAL_STRING, .text = ""};
    free(p.entries);
    free(p.sizes);
    free(p.words.data);
    return p.result;
}
