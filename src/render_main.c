// render_main.c - hcsg-render: the picture or the geometry of a model as a file, without a window.
#include "base/clock.h"
#include "base/file.h"
#include "base/mem.h"
#include "base/options.h"
#include "csg/csg.h"
#include "io/write_png.h"
#include "model/export.h"
#include "render/camera.h"
#include "render/picture.h"
#include "scad/openscad.h"

#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { EXIT_FINE = 0, EXIT_INPUT = 1, EXIT_PICTURE = 2 };
enum { SIDE_MOST = 32768, PIXELS_MOST = 1 << 26 };

// The command line as it was given.
static struct {
    const char *output, *export_format, *camera, *projection, *scheme, *device;
    int size[2];
    bool viewall, autocenter, summary;
    uint32_t threads, megabytes;
    double epsilon;
    struct option_list import_folders;
    bool hard_warnings;
} given = {.size = {512, 512}, .scheme = "Cornfield", .epsilon = -1, .megabytes = 256};

static const struct option options[] = {
    {"output", 'o', OPTION_TEXT, "FILE", "write the picture there; - is standard output",
     &given.output, 0, 0},
    {"export-format", 0, OPTION_TEXT, "png|stl|off|dxf",
     "what to write, whatever the extension of FILE says: a picture, or\n"
     "the vertices of a model that is one object without booleans",
     &given.export_format, 0, 0},
    {"imgsize", 0, OPTION_SIZE, "W,H", "size of the picture in pixels (default 512,512)",
     given.size, 1, SIDE_MOST},
    {"camera", 0, OPTION_TEXT, "NUMBERS",
     "tx,ty,tz,rx,ry,rz,distance or eyex,eyey,eyez,centrex,centrey,centrez;\n"
     "without it the whole model is shown, as by --viewall --autocenter",
     &given.camera, 0, 0},
    {"viewall", 0, OPTION_FLAG, NULL, "choose the distance so that the whole model shows",
     &given.viewall, 0, 0},
    {"autocenter", 0, OPTION_FLAG, NULL, "look at the centre of the model", &given.autocenter, 0,
     0},
    {"projection", 0, OPTION_TEXT, "o|p", "ortho or perspective (default)", &given.projection, 0,
     0},
    {"colorscheme", 0, OPTION_TEXT, "NAME", "Cornfield (default) or another of OpenSCAD's",
     &given.scheme, 0, 0},
    {"device", 0, OPTION_TEXT, "auto|cpu", "what draws", &given.device, 0, 0},
    {"threads", 0, OPTION_COUNT, "N", "threads to draw with; 0: one per processor (default)",
     &given.threads, 0, 256},
    {"eps", 0, OPTION_NUMBER, "MM",
     "ignore solid and gaps thinner than this; 0: none\n"
     "(default 0.001; 1e-5 of an extent below 100, 2e-6 of one above 500)",
     &given.epsilon, 0, 1e9},
    {"memory", 0, OPTION_COUNT, "MB", "memory to draw with, beside model and picture (default 256)",
     &given.megabytes, 1, 1 << 20},
    {"import-dir", 0, OPTION_LIST, "DIR",
     "look there for imported files that are not beside FILE;\nmay be given several times",
     &given.import_folders, 0, 0},
    {"hardwarnings", 0, OPTION_FLAG, NULL, "make no picture when there is a warning",
     &given.hard_warnings, 0, 0},
    {"summary", 0, OPTION_FLAG, NULL, "print numbers about model and picture", &given.summary, 0,
     0},
};

static const struct program program = {
    .name = "hcsg-render",
    .version = HCSG_VERSION,
    .summary = "Draws an OpenSCAD model, a .csg or through openscad a .scad, as a PNG picture, or "
               "writes the geometry of one object.",
    .operands = "FILE",
    .options = options,
    .option_count = array_count(options),
};

// What the options mean, checked.
struct request {
    const char *input;
    struct camera camera;
    bool viewall, autocenter;
    const struct scheme *scheme;
    bool exports; // geometry, no picture
    enum export_format format;
};

static bool check_size(struct error *err)
{
    if ((int64_t)given.size[0] * given.size[1] <= PIXELS_MOST)
        return true;
    error_set(err, "--imgsize: expected at most %d pixels, got %d,%d", PIXELS_MOST, given.size[0],
              given.size[1]);
    return false;
}

static bool check_output(struct request *r, const char *path, struct error *err)
{
    if (!path && !given.summary) {
        error_set(err, "no output; give -o FILE.png");
        return false;
    }
    if (path && !*path) {
        error_set(err, "--output: expected the name of a file, got ''");
        return false;
    }
    const char *extension = path ? file_extension(path) : "";
    const char *format = given.export_format ? given.export_format : extension;
    r->exports = export_format_find(&r->format, format);
    if (r->exports || strcasecmp(format, "png") == 0 || !(given.export_format || *format))
        return true;
    if (given.export_format)
        error_set(err, "--export-format: expected png, stl, off or dxf, got '%s'", format);
    else
        error_set(err, "%s: only PNG, STL, OFF and DXF can be written, not .%s", path, extension);
    return false;
}

static bool parse_request(struct request *out, int operands, char **argv, struct error *err)
{
    *out = (struct request){.input = argv[1], .camera = CAMERA_DEFAULTS};
    if (operands != 1) {
        error_set(err,
                  operands ? "expected one input file, got %d; --help shows the options"
                           : "no input file; --help shows the options",
                  operands);
        return false;
    }
    if (!*out->input) {
        error_set(err, "expected the name of an input file, got ''");
        return false;
    }
    if (given.device && strcmp(given.device, "auto") != 0 && strcmp(given.device, "cpu") != 0) {
        error_set(err, "--device: expected auto or cpu, got '%s'", given.device);
        return false;
    }
    out->viewall = given.viewall || !given.camera;
    out->autocenter = given.autocenter || !given.camera;
    out->scheme = scheme_find(given.scheme, err);
    return out->scheme && check_size(err) &&
           (!given.camera || camera_parse(&out->camera, given.camera, err)) &&
           (!given.projection || camera_parse_projection(&out->camera, given.projection, err)) &&
           check_output(out, given.output, err);
}

static bool read_tree(struct csg_tree *out, const char *path, struct scad_result *scad,
                      struct messages *messages)
{
    if (strcasecmp(file_extension(path), "scad") != 0)
        return csg_parse_file(out, path, messages);
    struct error err;
    if (!scad_export(path, NULL, scad, &err)) {
        messages_add(messages, MESSAGE_ERROR, (struct place){0}, "%s", err.text);
        return false;
    }
    fputs(scad->log ? scad->log : "", stderr);
    return csg_parse(out, scad->name, scad->text, scad->size, messages);
}

struct timing {
    double read, build, draw, write; // seconds
};

static void print_box(FILE *out, struct box b)
{
    if (box_is_empty(b)) {
        fprintf(out, "Bounding box:  empty\n");
        return;
    }
    struct vec3 size = vec3_sub(b.max, b.min);
    fprintf(out, "Bounding box:\n");
    fprintf(out, "   Min:  %.6g, %.6g, %.6g\n", b.min.x, b.min.y, b.min.z);
    fprintf(out, "   Max:  %.6g, %.6g, %.6g\n", b.max.x, b.max.y, b.max.z);
    fprintf(out, "   Size: %.6g, %.6g, %.6g\n", size.x, size.y, size.z);
}

static void print_summary(FILE *out, const struct request *r, const struct model *m,
                          const struct messages *messages, const struct render_stats *stats,
                          const struct timing *t)
{
    char camera[CAMERA_TEXT];
    uint32_t combinations = 0;
    for (uint32_t i = 0; i < m->body_count; i++)
        combinations += discovery_stats(m->bodies[i].table).combinations;
    camera_print(&r->camera, camera);
    fprintf(out, "Nodes:         %u\n", m->stats.nodes);
    fprintf(out, "Leaves:        %u\n", m->stats.leaves);
    fprintf(out, "Solids:        %u\n", m->stats.solids);
    fprintf(out, "Triangles:     %u\n", m->stats.triangles);
    fprintf(out, "Not drawn:     %u\n", m->stats.unsupported);
    fprintf(out, "Combinations:  %u\n", combinations);
    fprintf(out, "Open rays:     %llu\n", (unsigned long long)stats->open_rays);
    fprintf(out, "Warnings:      %u\n", messages->warnings);
    print_box(out, m->bounds);
    fprintf(out, "Camera:        --camera=%s\n", camera);
    fprintf(out, "Picture:       %d x %d\n", given.size[0], given.size[1]);
    fprintf(out, "Time:          read %.1f ms, build %.1f ms, draw %.1f ms, write %.1f ms\n",
            t->read * 1e3, t->build * 1e3, t->draw * 1e3, t->write * 1e3);
}

// Seconds since *start, which moves to now.
static double lap(double *start)
{
    double before = *start;
    *start = clock_seconds();
    return *start - before;
}

static bool draw(struct picture *out, struct request *r, const struct model *m,
                 struct render_stats *stats, struct error *err)
{
    if (r->autocenter)
        camera_autocenter(&r->camera, m->bounds);
    if (r->viewall)
        camera_viewall(&r->camera, m->bounds);
    if (!(r->camera.distance > 0)) {
        error_set(err, "--camera: the distance must be above 0");
        return false;
    }
    struct rays rays = camera_rays(&r->camera, given.size[0], given.size[1], m->bounds);
    const struct render_settings settings = {.epsilon = model_epsilon(m, given.epsilon),
                                             .threads = given.threads,
                                             .memory = (size_t)given.megabytes << 20};
    struct shader shader;
    struct cpu_device *device = cpu_device_new();
    shader_init(&shader, m, r->scheme);
    picture_draw(out, device, &shader, &rays, &settings, stats);
    shader_free(&shader);
    cpu_device_delete(device);
    return true;
}

static int fail(const struct error *err, int code)
{
    fprintf(stderr, "%s: %s\n", program.name, err->text);
    return code;
}

// Makes and writes what is asked for. *lap_start: when that began.
static int produce(struct request *r, const struct model *m, struct render_stats *stats,
                   struct timing *t, double *lap_start)
{
    int code = EXIT_FINE;
    struct error err;
    struct picture picture = {0};
    if (!r->exports && !draw(&picture, r, m, stats, &err))
        return fail(&err, EXIT_INPUT);
    t->draw = lap(lap_start);
    if (given.output &&
        !(r->exports ? model_export(m, r->format, given.output, &err)
                     : write_png(given.output, picture.rgb, picture.width, picture.height, &err)))
        code = fail(&err, EXIT_PICTURE);
    t->write = lap(lap_start);
    picture_free(&picture);
    return code;
}

static int run(struct request *r)
{
    int code = EXIT_INPUT;
    struct messages messages = {0};
    struct csg_tree tree = {0};
    struct scad_result scad = {0};
    struct model model = {0};
    struct render_stats stats = {0};
    struct timing t = {0};
    double start = clock_seconds();

    bool read = read_tree(&tree, r->input, &scad, &messages);
    t.read = lap(&start);
    if (!read) {
        messages_print(&messages, stderr);
        goto done;
    }
    struct solid_store *store = solid_store_new();
    struct model_options model_options = MODEL_DEFAULTS;
    model_options.epsilon = given.epsilon;
    model_options.import_folders = given.import_folders.items;
    model_options.import_folder_count = given.import_folders.count;
    model_build(&model, &tree, store, &model_options, &messages);
    solid_store_delete(store);
    t.build = lap(&start);
    messages_print(&messages, stderr);
    if (given.hard_warnings && messages.warnings + messages.errors)
        goto done;
    code = produce(r, &model, &stats, &t, &start);
    if (code == EXIT_FINE && given.summary) {
        bool taken = given.output && strcmp(given.output, "-") == 0;
        print_summary(taken ? stderr : stdout, r, &model, &messages, &stats, &t);
    }
done:
    model_free(&model);
    csg_free(&tree);
    scad_result_free(&scad);
    messages_free(&messages);
    return code;
}

// A standard stream that is closed would lend its number to the next file opened. This stands in
// for it, opened the wrong way round so that using it fails.
static void hold_standard_streams(void)
{
    for (int fd = 0; fd < 3; fd++)
        if (fcntl(fd, F_GETFD) == -1)
            (void)!open("/dev/null", fd == 0 ? O_WRONLY : O_RDONLY);
}

int main(int argc, char **argv)
{
    hold_standard_streams();
    signal(SIGPIPE, SIG_IGN); // as errors of write, which are told and cleaned up
    signal(SIGXFSZ, SIG_IGN);
    int operands = 0;
    struct error err;
    struct request request;
    switch (options_parse(&program, argc, argv, &operands, &err)) {
    case OPTIONS_DONE:
        return EXIT_FINE;
    case OPTIONS_WRONG:
        return fail(&err, EXIT_INPUT);
    case OPTIONS_RUN:
        break;
    }
    if (!parse_request(&request, operands, argv, &err))
        return fail(&err, EXIT_INPUT);
    int code = run(&request);
    if (code == EXIT_FINE && given.summary && (fflush(stdout) != 0 || ferror(stdout))) {
        error_set(&err, "standard output: cannot write");
        return fail(&err, EXIT_PICTURE);
    }
    return code;
}
