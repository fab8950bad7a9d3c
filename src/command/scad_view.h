// scad_view.h - the camera that a .scad file sets with $vpt, $vpr, $vpd and $vpf.
#pragma once
#include "command/request.h"
#include "scad/openscad.h"

struct scad_view {
    bool set; // by the file
    struct camera camera;
};

// For -D: makes openscad say where the camera is.
#define SCAD_VIEW_DEFINITION "hcsg_view=echo(\"hcsg_view\",$vpt,$vpr,$vpd,$vpf)"

// Whether the main file or a definition sets it; comments count.
bool scad_view_is_named(const struct request *r);
// Whether openscad found it set.
bool scad_view_was_set(const struct scad_result *scad);
// Takes what was said about it out of the log: with the definition a place for each frame. False if
// the log has lost some.
bool scad_view_take(struct scad_view *out, uint32_t frames, const struct request *r,
                    struct scad_result *scad);
