// options.h - the command line of hcsg-render as it was given.
#pragma once
#include "base/options.h"

struct given {
    char **operands;
    int operand_count;
    struct option_list outputs, old_outputs; // of -o, and of -s and -x
    const char *export_format, *camera, *projection, *view, *scheme, *transparency, *device;
    int size[2];
    bool viewall, autocenter, hard_warnings, quiet, info;
    struct option_list render, preview, summary;
    const char *summary_file, *rule;
    double density;
    uint32_t frames;
    uint32_t term_limit; // as `backend` only accepted
    const char *backend;
    uint32_t threads, megabytes;
    double epsilon;
    struct option_list import_folders;
    // For openscad:
    const char *openscad, *parameter_file, *parameter_set, *make_command;
    struct option_list definitions, features;
    const char *check_parameters, *check_ranges, *debug;
    uint32_t samples;
    bool no_background;
    struct option_list fit; // without a value ""
    const char *views, *shading, *reference, *threshold;
};

enum options_result given_parse(struct given *out, int argc, char **argv, struct error *err);
