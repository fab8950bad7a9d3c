// options.c - the command line of hcsg-render as it was given.
#include "command/options.h"

#include "base/mem.h"
#include "command/summary_parts.h"
#include "render/shot.h"

#include <assert.h>
#include <string.h>

enum { SIDE_MOST = 32768, FRAMES_MOST = 99999, OPENSCAD_OPTIONS = 30 };

enum options_result given_parse(struct given *out, int argc, char **argv, struct error *err)
{
    *out = (struct given){.operands = argv + 1,
                          .size = {512, 512},
                          .scheme = "Cornfield",
                          .transparency = "file",
                          .device = "cpu",
                          .epsilon = -1,
                          .megabytes = 256,
                          .samples = 1};
    const struct option options[] = {
        {"output", 'o', OPTION_LIST, "FILE",
         "write that file, what it is follows from its extension;\n"
         "- is standard output; may be given several times",
         &out->outputs, 0, 0},
        {"export-format", 0, OPTION_TEXT, "png|depthmap|pfm|normals|ids|stl|off|dxf|param",
         "what to write, whatever the extension of FILE says: a picture,\n"
         "depths as grey (16 bits) or numbers, normals or leaves as colours,\n"
         "the vertices of a model that is one object without booleans, or the\n"
         "parameters of a .scad as JSON",
         &out->export_format, 0, 0},
        {"imgsize", 0, OPTION_SIZE, "W,H", "size of the picture in pixels (default 512,512)",
         out->size, 1, SIDE_MOST},
        {"camera", 0, OPTION_TEXT, "NUMBERS",
         "tx,ty,tz,rx,ry,rz,distance or eyex,eyey,eyez,centrex,centrey,centrez;\n"
         "without it the whole model is shown, as by --viewall --autocenter",
         &out->camera, 0, 0},
        {"viewall", 0, OPTION_FLAG, NULL, "choose the distance so that the whole model shows",
         &out->viewall, 0, 0},
        {"autocenter", 0, OPTION_FLAG, NULL, "look at the centre of the model", &out->autocenter, 0,
         0},
        {"projection", 0, OPTION_TEXT, "o|p", "ortho or perspective (default)", &out->projection, 0,
         0},
        {"view", 0, OPTION_TEXT, "NAMES",
         "also draw these: axes, scales (on axes), crosshairs, edges,\nwireframe (with --render)",
         &out->view, 0, 0},
        {"colorscheme", 0, OPTION_TEXT, "NAME",
         "Cornfield (default), another of OpenSCAD's or of yours (see the manual),\nor a file "
         "FILE.json with one",
         &out->scheme, 0, 0},
        {"preview", 0, OPTION_OPTIONAL, "throwntogether",
         "the preview (default), or each shape whole and back faces magenta", &out->preview, 0, 0},
        {"render", 0, OPTION_OPTIONAL, "cgal|force",
         "the geometry as one object, without colours, flat shapes flat;\n"
         "a .scad sees $preview = false",
         &out->render, 0, 0},
        {"csglimit", 0, OPTION_COUNT, "N", "accepted and not needed: there is no limit",
         &out->term_limit, 0, UINT32_MAX},
        {NULL, 'D', OPTION_LIST, "VAR=VALUE", "set a variable of a .scad", &out->definitions, 0, 0},
        {NULL, 'p', OPTION_TEXT, "FILE", "parameter sets of a .scad", &out->parameter_file, 0, 0},
        {NULL, 'P', OPTION_TEXT, "NAME", "the parameter set to use", &out->parameter_set, 0, 0},
        {NULL, 'm', OPTION_TEXT, "COMMAND", "run COMMAND 'file' for each file that is missing",
         &out->make_command, 0, 0},
        {NULL, 'd', OPTION_TEXT, "FILE", "write a rule for make there: what the outputs depend on",
         &out->rule, 0, 0},
        {"animate", 0, OPTION_COUNT, "N",
         "write N pictures of a .scad with $t from 0 to 1, numbered in front\n"
         "of the extension: x00000.png ...",
         &out->frames, 0, FRAMES_MOST},
        {"hardwarnings", 0, OPTION_FLAG, NULL, "write nothing when there is a warning",
         &out->hard_warnings, 0, 0},
        {"quiet", 'q', OPTION_FLAG, NULL, "say nothing but errors", &out->quiet, 0, 0},
        {"summary", 0, OPTION_OPTIONAL, SUMMARY_NAMES,
         "print these numbers about model and picture; without names\nall but area and volume",
         &out->summary, 0, 0},
        {"summary-file", 0, OPTION_TEXT, "FILE",
         "write them there as JSON instead; - is standard output", &out->summary_file, 0, 0},
        {"info", 0, OPTION_FLAG, NULL, "print what hcsg is made of and what draws here", &out->info,
         0, 0},
        {"enable", 0, OPTION_LIST, "FEATURE",
         "for openscad, which gets it with a .scad; one that does not know it\ngoes without",
         &out->features, 0, 0},
        {"check-parameters", 0, OPTION_TEXT, "true|false", "the same: check arguments of modules",
         &out->check_parameters, 0, 0},
        {"check-parameter-ranges", 0, OPTION_TEXT, "true|false", "the same: check their values",
         &out->check_ranges, 0, 0},
        {"debug", 0, OPTION_TEXT, "FILE",
         "the same: say more of what happens in a source file of openscad", &out->debug, 0, 0},
        {"backend", 0, OPTION_TEXT, "NAME",
         "accepted and not needed: nothing is evaluated to a mesh", &out->backend, 0, 0},
        {NULL, 's', OPTION_LIST, "FILE", "the same as -o, and deprecated, as -x", &out->old_outputs,
         0, 0},
        {NULL, 'x', OPTION_LIST, "FILE", "the same as -o", &out->old_outputs, 0, 0},
        // Beyond OpenSCAD's: these cannot be shortened
        {"openscad", 0, OPTION_TEXT, "PROGRAM",
         "exports .scad files; if not given $OPENSCAD, or openscad on the PATH", &out->openscad, 0,
         0},
        {"samples", 0, OPTION_COUNT, "N",
         "smooth edges: the average of N pictures, their rays spread over each\n"
         "pixel (1 to 64, default 1)",
         &out->samples, 1, SAMPLES_MOST},
        {"no-background", 0, OPTION_FLAG, NULL, "leave the background out: a PNG with alpha",
         &out->no_background, 0, 0},
        {"fit", 0, OPTION_OPTIONAL, "MARGIN",
         "fill the picture with what shows; MARGIN in pixels or percent of the\n"
         "shorter side stays free (default 5%)",
         &out->fit, 0, 0},
        {"views", 0, OPTION_TEXT, "NAMES",
         "iso,diagonal,top,bottom,left,right,front,back: several views in one\n"
         "picture, or each in a file: %s in FILE is its name",
         &out->views, 0, 0},
        {"shading", 0, OPTION_TEXT, "ao|outline",
         "darken corners (ambient occlusion), draw lines along edges; or both:\nao,outline",
         &out->shading, 0, 0},
        {"reference", 0, OPTION_TEXT, "PNG",
         "compare the picture with this one; exit code 3 if it differs", &out->reference, 0, 0},
        {"threshold", 0, OPTION_TEXT, "N,P%",
         "differences up to N of 255 do not count, nor do they in P percent of\n"
         "the pixels (default 0,0%)",
         &out->threshold, 0, 0},
        {"transparency", 0, OPTION_TEXT, "file|sorted",
         "draw see-through objects in the order of the file, as OpenSCAD does\n"
         "(default), or the far ones first, whatever their order",
         &out->transparency, 0, 0},
        {"device", 0, OPTION_TEXT, "auto|cpu|gl",
         "what draws: the processor (default), OpenGL, or OpenGL where\nthere is a graphics "
         "processor for it",
         &out->device, 0, 0},
        {"threads", 0, OPTION_COUNT, "N", "threads to draw with; 0: one per processor (default)",
         &out->threads, 0, 256},
        {"eps", 0, OPTION_NUMBER, "MM",
         "ignore solid and gaps thinner than this; 0: none\n"
         "(default 0.001; 1e-5 of an extent below 100, 2e-6 of one above 500)",
         &out->epsilon, 0, 1e9},
        {"memory", 0, OPTION_COUNT, "MB",
         "memory to draw with, beside model and picture (default 256)", &out->megabytes, 1,
         1 << 20},
        {"import-dir", 0, OPTION_LIST, "DIR",
         "look there for imported files that are not beside FILE;\nmay be given several times",
         &out->import_folders, 0, 0},
        {"density", 0, OPTION_NUMBER, "G", "print the mass too, of a material of G grams per cm3",
         &out->density, 1e-9, 1e9},
    };
    const struct program program = {
        .name = "hcsg-render",
        .version = HCSG_VERSION,
        .summary = "Draws an OpenSCAD model, a .csg or through openscad a .scad, as a PNG picture, "
                   "or writes the geometry of one object.",
        .operands = "FILE",
        .options = options,
        .option_count = array_count(options),
        .shortened_count = OPENSCAD_OPTIONS,
    };
    assert(strcmp(options[OPENSCAD_OPTIONS].name, "openscad") == 0);
    return options_parse(&program, argc, argv, &out->operand_count, err);
}
