// request.h - what the options mean, checked.
#pragma once
#include "command/format.h"
#include "command/options.h"
#include "command/style.h"
#include "command/summary_parts.h"
#include "command/view.h"
#include "render/camera.h"
#include "render/choose.h"
#include "render/scheme.h"

enum { PIXELS_MOST = 1 << 26 };

// In the path of an output: the name of the view, of which each gets a file of its own.
#define VIEW_MARK "%s"

struct output {
    const char *path; // "-": standard output
    bool per_view;
    const struct output_format *format;
};

// An option that means something to openscad alone.
struct passed {
    const char *option, *value; // value NULL: not given
};
enum { PASSED_MOST = OPTION_LIST_MOST + 3 };

struct request {       // borrows from the command line
    const char *input; // "-": standard input
    bool is_scad;
    // For openscad, and what is done for it with a .csg
    const char *openscad, *parameter_file, *parameter_set, *make_command; // NULL: not given
    struct option_list definitions;
    struct passed passed[PASSED_MOST];
    uint32_t passed_count;
    struct output outputs[2 * OPTION_LIST_MOST];
    uint32_t output_count;
    const char *parameter_outputs[2 * OPTION_LIST_MOST]; // files for OUTPUT_PARAMETERS
    uint32_t parameter_output_count;
    int width, height;
    struct camera camera;
    bool viewall, autocenter;
    bool camera_given, framing_given; // the camera, or one of these two
    struct view_options view;
    struct style style;
    const struct scheme *scheme; // of OpenSCAD's, or own_scheme
    struct scheme own_scheme;    // of a file
    enum model_mode mode;
    bool united;    // MODEL_RENDER: of struct model_options
    bool sorted;    // see-through surfaces by their depth, not in the order of the file
    double epsilon; // negative: the default for the model
    enum device_wish device;
    uint32_t threads;
    size_t memory;
    struct option_list import_folders;
    bool hard_warnings, quiet;
    uint32_t summary;         // SUMMARY_*
    const char *summary_file; // NULL: as text
    double density;           // g/cm^3; 0: not given
    const char *rule;         // for make; NULL: none
    uint32_t frames;          // 0: no animation
};

bool request_make(struct request *out, const struct given *given, struct error *err);
// Whether a picture has to be drawn, or numbers per pixel: of a view alone for the outputs that
// have a file per view, or with NULL for all others, numbers about the picture and its check.
bool request_draws(const struct request *r, const struct view *view);
bool request_maps(const struct request *r, const struct view *view);
