// view_main.c - hcsg-view: options, then one call.
#include "app/viewer.h"
#include "base/mem.h"
#include "base/options.h"
#include "render/scheme_choose.h"

#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

static struct {
    const char *camera, *projection, *scheme, *openscad, *device;
    int size[2];
    uint32_t threads, megabytes;
    double epsilon;
    struct option_list import_folders;
    bool stats, no_watch;
} given = {.epsilon = -1, .megabytes = 256, .device = "cpu"};

static const struct option options[] = {
    {"camera", 0, OPTION_TEXT, "NUMBERS", "x,y,z,rx,ry,rz,distance or eye and centre x,y,z,x,y,z",
     &given.camera, 0, 0},
    {"projection", 0, OPTION_TEXT, "KIND", "o(rtho) or p(erspective)", &given.projection, 0, 0},
    {"colorscheme", 0, OPTION_TEXT, "NAME",
     "one of OpenSCAD's, or a file FILE.json with one;\nif not given that of the last window, at "
     "first Cornfield",
     &given.scheme, 0, 0},
    {"size", 0, OPTION_SIZE, "W,H",
     "of the window in pixels; if not given that of the\nlast window, at first 1024,768",
     given.size, 64, 16384},
    {"device", 0, OPTION_TEXT, "auto|cpu|gl",
     "what draws: the processor (default), OpenGL, or OpenGL\nwhere there is a graphics processor "
     "for it",
     &given.device, 0, 0},
    {"threads", 0, OPTION_COUNT, "N", "for drawing, one per processor if not given", &given.threads,
     0, 256},
    {"memory", 0, OPTION_COUNT, "MB", "memory to draw with, beside model and picture (default 256)",
     &given.megabytes, 1, 1 << 20},
    {"eps", 0, OPTION_NUMBER, "MM", "layers thinner than this do not show", &given.epsilon, 0, 1e9},
    {"openscad", 0, OPTION_TEXT, "PROGRAM",
     "exports .scad files; if not given $OPENSCAD,\nor openscad on the PATH", &given.openscad, 0,
     0},
    {"import-dir", 0, OPTION_LIST, "DIR",
     "look there for imported files that are not beside\nFILE; may be given several times",
     &given.import_folders, 0, 0},
    {"no-watch", 0, OPTION_FLAG, NULL, "load the file once, do not follow it", &given.no_watch, 0,
     0},
    {"stats", 0, OPTION_FLAG, NULL, "print the times of frames and loads", &given.stats, 0, 0},
};

static struct scheme own_scheme; // of a file
static struct settings remembered;

// Said before a window opens; a file that breaks later, or does not exist yet, only leaves a
// message in the window.
static bool check_file(const char *path, struct error *err)
{
    struct stat st;
    bool exists = stat(path, &st) == 0;
    if (strcmp(path, "-") == 0)
        error_set(err, "standard input cannot be followed: name a file");
    else if (!exists && errno == ENOENT && !given.no_watch)
        return true;
    else if (!exists || access(path, R_OK) != 0)
        error_set(err, "%s: %s", path, strerror(errno));
    else if (S_ISDIR(st.st_mode))
        error_set(err, "%s: is a folder, not a file", path);
    else
        return true;
    return false;
}

static bool set_options(struct viewer_options *o, struct error *err)
{
    struct error odd;
    struct settings *s = &remembered;
    if (!settings_read(s, &odd))
        fprintf(stderr, "hcsg-view: %s\n", odd.text);
    if (!scheme_choose(s->scheme, &own_scheme, NULL)) // it may be gone
        snprintf(s->scheme, sizeof s->scheme, "%s", SETTINGS_DEFAULTS.scheme);
    *o = (struct viewer_options){
        .openscad = given.openscad,
        .camera = CAMERA_DEFAULTS,
        .fixed_camera = given.camera != NULL,
        .scheme = scheme_choose(given.scheme ? given.scheme : s->scheme, &own_scheme, err),
        .epsilon = given.epsilon,
        .import_folders = given.import_folders.items,
        .import_folder_count = given.import_folders.count,
        .threads = given.threads,
        .memory = (size_t)given.megabytes << 20,
        .width = given.size[0] ? given.size[0] : s->width,
        .height = given.size[1] ? given.size[1] : s->height,
        .settings = *s,
        .given_size = given.size[0],
        .given_projection = given.projection,
        .watch = !given.no_watch,
        .stats = given.stats};
    o->camera.orthographic = s->orthographic;
    return o->scheme && device_wish_parse(&o->device, given.device, err) &&
           (!given.camera || camera_parse(&o->camera, given.camera, err)) &&
           (!given.projection || camera_parse_projection(&o->camera, given.projection, err));
}

int main(int argc, char **argv)
{
    static const struct program program = {
        .name = "hcsg-view",
        .version = HCSG_VERSION,
        .summary = "shows an OpenSCAD model and follows its file",
        .operands = "FILE.csg|FILE.scad",
        .options = options,
        .option_count = array_count(options),
    };
    struct error err;
    struct viewer_options o;
    int files;
    bool shown = false;
    signal(SIGPIPE, SIG_IGN); // who reads --stats may go; the window stays
    switch (options_parse(&program, argc, argv, &files, &err)) {
    case OPTIONS_DONE:
        return 0;
    case OPTIONS_WRONG:
    case OPTIONS_UNTOLD:
        goto wrong;
    case OPTIONS_RUN:
        break;
    }
    if (files != 1) {
        error_set(&err, "expected one file; hcsg-view --help lists the options");
        goto wrong;
    }
    if (!set_options(&o, &err) || !check_file(argv[1], &err))
        goto wrong;
    o.path = argv[1];
    if (!viewer_run(&o, &shown, &err)) {
        fprintf(stderr, "hcsg-view: %s (hcsg-render draws without a window)\n", err.text);
        return 2;
    }
    return shown ? 0 : 1;
wrong:
    fprintf(stderr, "hcsg-view: %s\n", err.text);
    return 1;
}
