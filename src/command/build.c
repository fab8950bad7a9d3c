// build.c - the model of the input, as the request wants it.
#include "command/build.h"

#include "base/mem.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// What the command prints does not mix with an output on standard output.
static char *command_line(const char *command, const char *path)
{
    static const char end[] = "' >&2";
    char *line = mem_alloc(strlen(command) + 4 * strlen(path) + sizeof end + 2), *out = line;
    out += sprintf(out, "%s '", command);
    for (; *path; path++)
        out += sprintf(out, *path == '\'' ? "'\\''" : "%c", *path);
    memcpy(out, end, sizeof end);
    return line;
}

// Whether there is now any that was missing.
static bool make_missing(const char *command, const struct model *m)
{
    bool made = false;
    for (uint32_t i = 0; i < m->import_count; i++) {
        const char *path = m->imports[i];
        if (access(path, F_OK) == 0)
            continue;
        char *line = command_line(command, path);
        (void)!system(line); // its failure shows as the missing file
        free(line);
        made |= access(path, F_OK) == 0;
    }
    return made;
}

void build_model(struct model *out, const struct request *r, const struct input *in,
                 struct solid_store *store, struct messages *messages)
{
    struct model_options options = MODEL_DEFAULTS;
    options.mode = r->mode;
    options.united = r->united;
    options.epsilon = r->epsilon;
    options.import_folders = r->import_folders.items;
    options.import_folder_count = r->import_folders.count;
    struct messages own = {0};
    model_build(out, &in->tree, store, &options, &own);
    if (r->make_command && !r->is_scad && make_missing(r->make_command, out)) {
        model_free(out);
        messages_free(&own);
        model_build(out, &in->tree, store, &options, &own);
    }
    messages_append(messages, &own);
    messages_free(&own);
}
