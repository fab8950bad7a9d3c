// defined.c - the parameters of the .scad as the loader has them: what the user changed, over
// saves.
#include "app/defined.h"

#include "base/file.h"
#include "customizer/assignments.h"

#include <stdlib.h>

struct parameter_texts parameter_texts_of(const struct parameters *p)
{
    struct parameter_texts t = {.items = mem_alloc(p->count * sizeof *t.items + 1),
                                .count = p->count};
    for (uint32_t i = 0; i < p->count; i++) {
        t.items[i].name = mem_strdup(p->items[i].name);
        t.items[i].text = parameter_text(&p->items[i]);
    }
    return t;
}

void parameter_texts_free(struct parameter_texts *t)
{
    for (uint32_t i = 0; i < t->count; i++) {
        free(t->items[i].name);
        free(t->items[i].text);
    }
    free(t->items);
    *t = (struct parameter_texts){0};
}

void parameters_delete(struct parameters *p)
{
    if (p)
        parameters_free(p);
    free(p);
}

struct parameters *defined_read(struct defined *d, const char *path)
{
    uint64_t stamp = file_stamp(path);
    char *text;
    size_t size;
    if (stamp == d->stamp || !file_read(path, SCAD_TEXT_MOST, &text, &size, NULL))
        return NULL;
    struct parameters now, *seen = mem_zalloc(sizeof *seen);
    parameters_read(&now, text, size);
    parameters_read(seen, text, size);
    free(text);
    parameters_carry(&now, &d->kept);
    parameters_carry(&now, &d->now);
    parameters_carry(seen, &now);
    struct parameters *old = d->good ? &d->kept : &d->now;
    parameters_free(old);
    if (d->good)
        d->kept = d->now;
    d->now = now;
    d->good = false;
    d->stamp = stamp;
    return seen;
}

void defined_set(struct defined *d, const struct parameter_texts *texts)
{
    for (uint32_t i = 0; i < texts->count; i++) {
        struct parameter *p = parameters_find(&d->now, texts->items[i].name);
        if (p)
            parameter_set(p, texts->items[i].text);
    }
}

void defined_exported(struct defined *d)
{
    d->good = true;
}

char **defined_arguments(const struct defined *d, uint32_t *count)
{
    char **arguments = mem_alloc((2 * (size_t)d->now.count + 1) * sizeof *arguments);
    *count = 0;
    for (uint32_t i = 0; i < d->now.count; i++)
        if (parameter_is_changed(&d->now.items[i])) {
            arguments[(*count)++] = mem_strdup("-D");
            arguments[(*count)++] = parameter_definition(&d->now.items[i]);
        }
    return arguments;
}

void defined_free(struct defined *d)
{
    parameters_free(&d->now);
    parameters_free(&d->kept);
    *d = (struct defined){0};
}
