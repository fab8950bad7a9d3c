// scenes.c - the table scenes.txt.
#include "scenes.h"

#include "base/file.h"
#include "base/mem.h"

#include <stdlib.h>
#include <string.h>

bool scenes_read(struct scenes *out, const char *path, struct error *err)
{
    char *text, *rest;
    size_t size;
    if (!file_read(path, 1 << 20, &text, &size, err))
        return false;
    struct scenes s = {0};
    uint32_t number = 0;
    bool ok = true;
    for (char *line = text; ok && line; line = rest) {
        rest = strchr(line, '\n');
        if (rest)
            *rest++ = 0;
        number++;
        if (!*line || *line == '#')
            continue;
        array_reserve(&s.items, &s.capacity, s.count + 1);
        struct scene *scene = &s.items[s.count++];
        ok = sscanf(line, "%63s %*s %lf %lf", scene->name, &scene->at_least, &scene->after) == 3;
    }
    free(text);
    if (!ok) {
        error_at(err, (struct place){path, number, 0}, "expected a name, a file and two numbers");
        scenes_free(&s);
        return false;
    }
    *out = s;
    return true;
}

void scenes_free(struct scenes *s)
{
    free(s->items);
    *s = (struct scenes){0};
}
