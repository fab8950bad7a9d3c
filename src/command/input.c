// input.c - the tree of the input file, read from a .csg or exported by openscad from a .scad.
#include "command/input.h"

#include "base/mem.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

// That each frame of an animation is exported is no news.
static void print_log(const char *log, bool quiet)
{
    for (size_t length; *log; log += length) {
        length = strcspn(log, "\n");
        length += log[length] == '\n';
        if (strncmp(log, "Exporting ", 10) == 0)
            continue;
        if (!quiet || strncmp(log, "ERROR:", 6) == 0)
            fwrite(log, 1, length, stderr);
    }
}

struct call {
    const char *arguments[2 * OPTION_LIST_MOST + 2 * PASSED_MOST + 16];
    const char *unknown[4]; // options that this openscad does not have
    uint32_t unknown_count;
    bool asks_view;
};

static bool is_unknown(const struct call *call, const char *option)
{
    bool found = false;
    for (uint32_t i = 0; i < call->unknown_count; i++)
        found |= strcmp(call->unknown[i], option) == 0;
    return found;
}

// What of the options openscad has to know.
static struct scad_options set_arguments(struct call *call, const struct request *r)
{
    const char **arguments = call->arguments;
    uint32_t n = 0;
    for (uint32_t i = 0; i < r->passed_count; i++)
        if (!is_unknown(call, r->passed[i].option)) {
            arguments[n++] = r->passed[i].option;
            arguments[n++] = r->passed[i].value;
        }
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
    if (call->asks_view) {
        arguments[n++] = "-D";
        arguments[n++] = SCAD_VIEW_DEFINITION;
    }
    if (r->mode == MODEL_RENDER)
        arguments[n++] = "--render=force"; // without a value it would take the file for one
    return (struct scad_options){r->openscad, arguments, n, r->frames};
}

// Which of the options that are passed on openscad has refused, NULL without one.
static const char *refused(const struct call *call, const struct request *r, const char *log)
{
    for (uint32_t i = 0; i < r->passed_count; i++) {
        char line[64];
        snprintf(line, sizeof line, "unrecognised option '%s'", r->passed[i].option);
        if (!is_unknown(call, r->passed[i].option) && strstr(log, line))
            return r->passed[i].option;
    }
    return NULL;
}

// Versions of openscad differ in what they know: without it most designs come out the same.
static bool call_openscad(struct call *call, struct input *out, const struct request *r,
                          struct messages *messages, struct error *err)
{
    for (;;) {
        struct scad_options options = set_arguments(call, r);
        if (scad_export(r->input, &options, &out->scad, err))
            return true;
        const char *option = refused(call, r, out->scad.log ? out->scad.log : "");
        if (!option)
            return false;
        messages_add(messages, MESSAGE_WARNING, (struct place){.file = r->input},
                     "openscad does not know %s and goes without", option);
        call->unknown[call->unknown_count++] = option;
        scad_result_free(&out->scad);
    }
}

static bool export_scad(struct input *out, const struct request *r, struct messages *messages,
                        struct error *err)
{
    struct call call = {0};
    struct stat st;
    if (stat(r->input, &st) != 0 || access(r->input, R_OK) != 0) {
        error_set(err, "%s: %s", r->input, strerror(errno));
        return false;
    }
    if (S_ISDIR(st.st_mode)) {
        error_set(err, "%s: is a folder, not a file", r->input);
        return false;
    }
    call.asks_view = !r->camera_given && scad_view_is_named(r);
    if (!call_openscad(&call, out, r, messages, err))
        return false;
    if (!call.asks_view && !r->camera_given &&
        scad_view_was_set(&out->scad)) { // by a file that it includes
        scad_result_free(&out->scad);
        call.asks_view = true;
        if (!call_openscad(&call, out, r, messages, err))
            return false;
    }
    uint32_t frames = r->frames ? r->frames : 1;
    out->views = mem_zalloc(frames * sizeof *out->views);
    bool known = scad_view_take(out->views, frames, r, &out->scad);
    print_log(out->scad.log, r->quiet);
    if (!known) {
        error_set(err, "%s: too many messages to know the camera of each frame; give --camera",
                  r->input);
        return false;
    }
    return !r->hard_warnings || !scad_warning(&out->scad, err);
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

bool input_open(struct input *out, const struct request *r, struct messages *messages)
{
    struct error err;
    *out = (struct input){0};
    if (!r->is_scad)
        note_useless(r, messages);
    else if (!export_scad(out, r, messages, &err)) {
        messages_add(messages, MESSAGE_ERROR, (struct place){0}, "%s", err.text);
        return false;
    }
    return true;
}

// "dir/part.scad (frame 00003)", as its picture is numbered.
static bool read_frame(struct input *in, const struct request *r, uint32_t frame,
                       struct messages *messages)
{
    struct error err;
    struct scad_text text;
    size_t size = strlen(r->input) + 32;
    if (!scad_read_frame(&in->scad.frames, frame, &text, &err)) {
        messages_add(messages, MESSAGE_ERROR, (struct place){.file = r->input}, "%s", err.text);
        return false;
    }
    in->frame_name = mem_realloc(in->frame_name, size);
    snprintf(in->frame_name, size, "%s (frame %05u)", r->input, frame);
    bool ok = csg_parse(&in->tree, in->frame_name, text.text, text.size, messages);
    free(text.text);
    return ok;
}

bool input_read(struct input *in, const struct request *r, uint32_t frame,
                struct messages *messages)
{
    csg_free(&in->tree);
    if (!r->is_scad)
        return csg_parse_file(&in->tree, r->input, messages);
    const struct scad_result *s = &in->scad;
    return r->frames ? read_frame(in, r, frame, messages)
                     : csg_parse(&in->tree, s->name, s->text, s->size, messages);
}

void input_free(struct input *in)
{
    csg_free(&in->tree);
    scad_result_free(&in->scad);
    free(in->views);
    free(in->frame_name);
    in->views = NULL;
    in->frame_name = NULL;
}
