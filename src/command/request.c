// request.c - what the options mean, checked.
#include "command/request.h"

#include "base/file.h"

#include <string.h>

enum { PIXELS_MOST = 1 << 26 };

static bool set_input(struct request *out, const struct given *given, struct error *err)
{
    if (given->operand_count != 1) {
        error_set(err,
                  given->operand_count ? "expected one input file, got %d; --help shows the options"
                                       : "no input file; --help shows the options",
                  given->operand_count);
        return false;
    }
    out->input = given->operands[0];
    if (!*out->input)
        error_set(err, "expected the name of an input file, got ''");
    return *out->input;
}

static bool set_outputs(struct request *out, const struct given *given, struct error *err)
{
    const struct output_format *asked = NULL;
    char names[128];
    output_format_names(names, sizeof names);
    if (given->export_format && !(asked = output_format_find(given->export_format))) {
        error_set(err, "--export-format: expected %s, got '%s'", names, given->export_format);
        return false;
    }
    if (!given->outputs.count && !given->summary) {
        error_set(err, "no output; give -o FILE.png");
        return false;
    }
    for (uint32_t i = 0; i < given->outputs.count; i++) {
        const char *path = given->outputs.items[i], *extension = file_extension(path);
        if (!*path) {
            error_set(err, "--output: expected the name of a file, got ''");
            return false;
        }
        const struct output_format *format =
            asked ? asked : output_format_find(*extension ? extension : "png");
        if (!format) {
            error_set(err, "%s: cannot write .%s files, only %s", path, extension, names);
            return false;
        }
        out->outputs[out->output_count++] = (struct output){path, format};
    }
    return true;
}

static bool set_size(struct request *out, const struct given *given, struct error *err)
{
    out->width = given->size[0];
    out->height = given->size[1];
    if ((int64_t)out->width * out->height <= PIXELS_MOST)
        return true;
    error_set(err, "--imgsize: expected at most %d pixels, got %d,%d", PIXELS_MOST, out->width,
              out->height);
    return false;
}

static bool set_camera(struct request *out, const struct given *given, struct error *err)
{
    out->camera = CAMERA_DEFAULTS;
    out->viewall = given->viewall || !given->camera;
    out->autocenter = given->autocenter || !given->camera;
    return (!given->camera || camera_parse(&out->camera, given->camera, err)) &&
           (!given->projection || camera_parse_projection(&out->camera, given->projection, err));
}

static bool check_device(const struct given *given, struct error *err)
{
    if (!given->device || strcmp(given->device, "auto") == 0 || strcmp(given->device, "cpu") == 0)
        return true;
    error_set(err, "--device: expected auto or cpu, got '%s'", given->device);
    return false;
}

bool request_make(struct request *out, const struct given *given, struct error *err)
{
    *out = (struct request){.epsilon = given->epsilon,
                            .threads = given->threads,
                            .memory = (size_t)given->megabytes << 20,
                            .import_folders = given->import_folders,
                            .hard_warnings = given->hard_warnings,
                            .summary = given->summary};
    if (!set_input(out, given, err) || !check_device(given, err))
        return false;
    out->view = view_parse(given->view);
    out->scheme = scheme_find(given->scheme, err);
    return out->scheme && set_size(out, given, err) && set_camera(out, given, err) &&
           set_outputs(out, given, err);
}
