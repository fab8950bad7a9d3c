// request.c - what the options mean, checked.
#include "command/request.h"

#include "base/file.h"
#include "base/mem.h"
#include "command/parameters.h"
#include "render/scheme_choose.h"

#include <string.h>
#include <strings.h>

static bool set_input(struct request *out, const struct given *given, struct error *err)
{
    if (!given->operand_count) {
        error_set(err, "no input file; --help shows the options");
        return false;
    }
    if (given->operand_count > 1) {
        error_set(err, "expected one input file, got %d: %s, %s%s; outputs are named with -o",
                  given->operand_count, given->operands[0], given->operands[1],
                  given->operand_count > 2 ? ", ..." : "");
        return false;
    }
    out->input = given->operands[0];
    out->is_scad = strcasecmp(file_extension(out->input), "scad") == 0;
    if (!*out->input)
        error_set(err, "expected the name of an input file, got ''");
    return *out->input;
}

static bool is_truth(const char *text)
{
    static const char *const words[] = {"true", "false", "on", "off", "1", "0"};
    bool found = false;
    for (size_t i = 0; i < array_count(words); i++)
        found |= strcasecmp(text, words[i]) == 0;
    return found;
}

static bool set_passed(struct request *out, const struct given *given, struct error *err)
{
    const struct passed checks[] = {
        {"--check-parameters", given->check_parameters},
        {"--check-parameter-ranges", given->check_ranges},
        {"--debug", given->debug},
    };
    for (size_t i = 0; i < array_count(checks); i++) {
        const struct passed *one = &checks[i];
        if (one->value && one->value != given->debug && !is_truth(one->value)) {
            error_set(err, "%s: expected true or false, got '%s'", one->option, one->value);
            return false;
        }
        if (one->value)
            out->passed[out->passed_count++] = *one;
    }
    for (uint32_t i = 0; i < given->features.count; i++)
        out->passed[out->passed_count++] = (struct passed){"--enable", given->features.items[i]};
    return true;
}

// openscad goes on with the defaults after what is wrong here.
static bool set_openscad(struct request *out, const struct given *given, struct error *err)
{
    out->openscad = given->openscad;
    out->parameter_file = given->parameter_file;
    out->parameter_set = given->parameter_set;
    out->make_command = given->make_command;
    out->definitions = given->definitions;
    for (uint32_t i = 0; i < given->definitions.count; i++) {
        const char *definition = given->definitions.items[i], *equals = strchr(definition, '=');
        if (!equals || equals == definition || !equals[1]) {
            error_set(err, "-D: expected VARIABLE=VALUE, got '%s'", definition);
            return false;
        }
    }
    if (!given->parameter_file != !given->parameter_set) {
        error_set(err,
                  given->parameter_set ? "-P %s: expected the file of the set with -p"
                                       : "-p %s: expected the name of a set with -P",
                  given->parameter_set ? given->parameter_set : given->parameter_file);
        return false;
    }
    return !given->parameter_file ||
           parameters_check(given->parameter_file, given->parameter_set, err);
}

static bool is_map(enum output_kind kind)
{
    return kind != OUTPUT_PICTURE && kind != OUTPUT_GEOMETRY;
}

// A name of standard output must not be renamed over.
static const char *file_or_stream(const char *path)
{
    return path && strcmp(path, "/dev/stdout") == 0 ? "-" : path;
}

static bool set_summary(struct request *out, const struct given *given, struct error *err)
{
    for (uint32_t i = 0; i < given->summary.count; i++)
        if (!summary_parse(&out->summary, given->summary.items[i], err))
            return false;
    out->summary_file = file_or_stream(given->summary_file);
    if (out->summary_file && !out->summary)
        out->summary = SUMMARY_ALL;
    out->density = given->density;
    if (out->density > 0)
        out->summary |= SUMMARY_MASS;
    if (!out->summary_file || *out->summary_file)
        return true;
    error_set(err, "--summary-file: expected the name of a file, got ''");
    return false;
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
    uint32_t named = given->outputs.count, old = given->old_outputs.count;
    if (!named && !old && !out->summary && !given->reference) {
        error_set(err, "no output; give -o FILE.png");
        return false;
    }
    if (old && !given->quiet)
        fputs(
            "DEPRECATED: -s and -x; -o FILE.stl or -o FILE.dxf writes the geometry of one object, "
            "-o FILE.png a picture of any\n",
            stderr);
    for (uint32_t i = 0; i < named + old; i++) {
        const char *path = file_or_stream(i < named ? given->outputs.items[i]
                                                    : given->old_outputs.items[i - named]);
        const char *extension = file_extension(path);
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
        if (format->kind == OUTPUT_PARAMETERS && !out->is_scad) {
            error_set(err, "%s: only a .scad file has parameters, not %s", path, out->input);
            return false;
        }
        if (format->kind == OUTPUT_PARAMETERS) {
            out->parameter_outputs[out->parameter_output_count++] = path;
            continue;
        }
        bool per_view = out->style.views.count && strstr(path, VIEW_MARK);
        if (out->style.views.count && !per_view && is_map(format->kind)) {
            error_set(err, "%s: %s of several views need a file each: give -o NAME-%s.EXT", path,
                      format->name, VIEW_MARK);
            return false;
        }
        out->outputs[out->output_count++] = (struct output){path, per_view, format};
    }
    return true;
}

static bool set_animation(struct request *out, const struct given *given, struct error *err)
{
    out->frames = given->frames;
    if (!out->frames)
        return true;
    if (!out->is_scad) {
        error_set(err, "--animate: only a .scad file has $t, not %s", out->input);
        return false;
    }
    for (uint32_t i = 0; i < out->output_count; i++)
        if (strcmp(out->outputs[i].path, "-") == 0) {
            error_set(err, "--animate: standard output takes only one picture");
            return false;
        }
    return true;
}

static bool set_rule(struct request *out, const struct given *given, struct error *err)
{
    bool targets = false;
    out->rule = file_or_stream(given->rule);
    for (uint32_t i = 0; i < out->output_count; i++)
        targets |= strcmp(out->outputs[i].path, "-") != 0;
    if (!out->rule || (targets && *out->rule))
        return true;
    error_set(err, targets ? "-d: expected the name of a file, got ''"
                           : "-d: expected a file that is made, with -o");
    return false;
}

// What goes there would be one behind the other.
static bool check_streams(const struct request *r, struct error *err)
{
    int count = (r->summary_file && strcmp(r->summary_file, "-") == 0) +
                (r->rule && strcmp(r->rule, "-") == 0);
    for (uint32_t i = 0; i < r->output_count; i++)
        count += strcmp(r->outputs[i].path, "-") == 0;
    if (count > 1)
        error_set(err, "standard output takes only one of the outputs, got %d for it", count);
    return count <= 1;
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
    out->camera_given = given->camera;
    out->framing_given = given->viewall || given->autocenter;
    out->viewall = given->viewall || !given->camera;
    out->autocenter = given->autocenter || !given->camera;
    return (!given->camera || camera_parse(&out->camera, given->camera, err)) &&
           (!given->projection || camera_parse_projection(&out->camera, given->projection, err));
}

static bool set_mode(struct request *out, const struct given *given, struct error *err)
{
    for (uint32_t i = 0; i < given->render.count; i++) {
        const char *how = given->render.items[i];
        if (*how && strcmp(how, "cgal") != 0 && strcmp(how, "force") != 0) {
            error_set(err, "--render: expected nothing, cgal or force, got '%s'", how);
            return false;
        }
        out->mode = MODEL_RENDER;
        out->united = strcmp(how, "cgal") == 0;
    }
    for (uint32_t i = 0; i < given->preview.count; i++) { // both: as in OpenSCAD a preview
        const char *how = given->preview.items[i];
        if (*how && strcmp(how, "throwntogether") != 0) {
            error_set(err, "--preview: expected nothing or throwntogether, got '%s'", how);
            return false;
        }
        out->mode = *how ? MODEL_THROWN_TOGETHER : MODEL_PREVIEW;
    }
    return true;
}

static bool set_transparency(struct request *out, const struct given *given, struct error *err)
{
    out->sorted = strcmp(given->transparency, "sorted") == 0;
    if (out->sorted || strcmp(given->transparency, "file") == 0)
        return true;
    error_set(err, "--transparency: expected file or sorted, got '%s'", given->transparency);
    return false;
}

bool request_make(struct request *out, const struct given *given, struct error *err)
{
    *out = (struct request){.epsilon = given->epsilon,
                            .threads = given->threads,
                            .memory = (size_t)given->megabytes << 20,
                            .import_folders = given->import_folders,
                            .hard_warnings = given->hard_warnings,
                            .quiet = given->quiet};
    if (!set_input(out, given, err) || !set_openscad(out, given, err) ||
        !set_passed(out, given, err) || !set_mode(out, given, err) ||
        !device_wish_parse(&out->device, given->device, err))
        return false;
    out->view = view_parse(given->view);
    out->scheme = scheme_choose(given->scheme, &out->own_scheme, err);
    return out->scheme && set_transparency(out, given, err) && set_size(out, given, err) &&
           set_camera(out, given, err) && style_parse(&out->style, given, err) &&
           set_summary(out, given, err) && set_outputs(out, given, err) &&
           set_animation(out, given, err) && set_rule(out, given, err) && check_streams(out, err);
}

bool request_draws(const struct request *r, const struct view *view)
{
    uint32_t of_picture = SUMMARY_CACHE | SUMMARY_TIME | SUMMARY_CAMERA;
    bool draws = !view && ((r->summary & of_picture) || r->style.reference);
    for (uint32_t i = 0; i < r->output_count; i++)
        draws |= r->outputs[i].per_view == (view != NULL) &&
                 r->outputs[i].format->kind == OUTPUT_PICTURE;
    return draws;
}

bool request_maps(const struct request *r, const struct view *view)
{
    bool maps = false;
    for (uint32_t i = 0; i < r->output_count; i++)
        maps |= r->outputs[i].per_view == (view != NULL) && is_map(r->outputs[i].format->kind);
    return maps;
}
