// frames.h - the exported texts of an animation, kept in one file.
#pragma once
#include "scad/openscad.h"

// The file is made in `folder`, which may be removed.
bool scad_frames_begin(struct scad_frames *f, const char *folder, struct error *err);
bool scad_frames_add(struct scad_frames *f, const struct scad_text *text, struct error *err);
void scad_frames_free(struct scad_frames *f); // leaves {0}
