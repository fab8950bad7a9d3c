// options.h - the command line of hcsg-render as it was given.
#pragma once
#include "base/options.h"

struct given {
    char **operands;
    int operand_count;
    struct option_list outputs;
    const char *export_format, *camera, *projection, *view, *scheme, *transparency, *device;
    int size[2];
    bool viewall, autocenter, hard_warnings, quiet;
    struct option_list render, preview, summary;
    const char *summary_file, *rule;
    double density;
    uint32_t frames;
    uint32_t term_limit;
    uint32_t threads, megabytes;
    double epsilon;
    struct option_list import_folders;
    // For openscad:
    const char *openscad, *parameter_file, *parameter_set, *make_command;
    struct option_list definitions;
    uint32_t samples;
    bool no_background;
    struct option_list fit; // without a value ""
    const char *views, *shading, *reference, *threshold;
};

enum options_result given_parse(struct given *out, int argc, char **argv, struct error *err);
