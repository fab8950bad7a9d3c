// input.c - the tree of the input file, read from a .csg or exported by openscad from a .scad.
#include "command/input.h"

#include <string.h>

static void print_log(const char *log, bool quiet)
{
    for (size_t length; *log; log += length) {
        length = strcspn(log, "\n");
        length += log[length] == '\n';
        if (!quiet || strncmp(log, "ERROR:", 6) == 0)
            fwrite(log, 1, length, stderr);
    }
}

// What of the options openscad has to know.
static void set_arguments(struct scad_options *o, const char **arguments, const struct request *r)
{
    uint32_t n = 0;
    for (uint32_t i = 0; i < r->definitions.count; i++) {
        arguments[n++] = "-D";
        arguments[n++] = r->definitions.items[i];
    }
    const char *const more[][2] = {
        {"-p", r->parameter_file}, {"-P", r->parameter_set}, {"-m", r->make_command}};
    for (size_t i = 0; i < sizeof more / sizeof more[0]; i++)
        if (more[i][1]) {
            arguments[n++] = more[i][0];
            arguments[n++] = more[i][1];
        }
    if (r->time[0]) {
        arguments[n++] = "-D";
        arguments[n++] = r->time;
    }
    if (r->mode == MODEL_RENDER)
        arguments[n++] = "--render";
    *o = (struct scad_options){r->openscad, arguments, n};
}

static bool export_scad(struct scad_result *out, const struct request *r, struct error *err)
{
    const char *arguments[2 * OPTION_LIST_MOST + 16];
    struct scad_options options;
    set_arguments(&options, arguments, r);
    if (!scad_export(r->input, &options, out, err))
        return false;
    print_log(out->log, r->quiet);
    return !r->hard_warnings || !scad_warning(out, err);
}

static void note_useless(const struct request *r, struct messages *messages)
{
    const struct place place = {.file = r->input};
    if (r->definitions.count)
        messages_add(messages, MESSAGE_WARNING, place,
                     "-D does nothing: only a .scad file has variables");
    if (r->parameter_set)
        messages_add(messages, MESSAGE_WARNING, place,
                     "-p and -P do nothing: only a .scad file has parameters");
}

bool input_read(struct input *out, const struct request *r, struct messages *messages)
{
    struct error err;
    *out = (struct input){0};
    if (!r->is_scad) {
        note_useless(r, messages);
        return csg_parse_file(&out->tree, r->input, messages);
    }
    if (export_scad(&out->scad, r, &err))
        return csg_parse(&out->tree, out->scad.name, out->scad.text, out->scad.size, messages);
    messages_add(messages, MESSAGE_ERROR, (struct place){0}, "%s", err.text);
    return false;
}

void input_free(struct input *in)
{
    csg_free(&in->tree);
    scad_result_free(&in->scad);
}
