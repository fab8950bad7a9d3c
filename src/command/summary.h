// summary.h - numbers about a model and its picture.
#pragma once
#include "command/output.h"
#include "render/map_image.h"
#include "render/measure.h"

struct timing {
    double read, build, draw, write; // seconds
};

struct summary {
    const struct request *request;
    const struct model *model;
    const struct messages *messages;
    const struct drawn *drawn;
    struct timing times;
    // Of summary_measure:
    struct discovery_stats combinations; // that the picture needed, of all bodies
    struct depth_range depths;           // of an output with numbers per pixel
    struct box box;                      // of what is solid
    struct measure measure;              // of parts that are measured
};

// Finds out what the request names and nobody knows yet.
void summary_measure(struct summary *s);
// The parts that the request names, as lines and as JSON.
void summary_print(FILE *out, const struct summary *s);
bool summary_write(const char *path, const struct summary *s, struct error *err);

bool summary_is_flat(const struct model *m);
