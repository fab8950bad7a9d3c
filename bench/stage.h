// stage.h - a scene that is ready to be drawn, and frames of it.
#pragma once
#include "render/picture.h"
#include "sample.h"

struct stage { // {0} is valid
    struct model model;
    struct shader shader;
    struct picture picture;
    struct render_settings settings;
    uint32_t size;                  // side of the picture
    bool unshared;                  // each primitive has a value of its own
    size_t peak_bytes, model_bytes; // of the frames since these were last set to 0
};

// Reads and builds the scene several times, times in ms. Settings and
// size are for the caller to set, `unshared` before.
bool stage_load(struct stage *s, const char *csg, struct samples *parse, struct samples *build,
                struct error *err);
void stage_free(struct stage *s); // leaves {0}

// Draw, and return ms: a view of the turn to RGB, or all solid intervals along rays, which are
// counted.
double stage_draw(struct stage *s, struct device *device, uint32_t view,
                  struct render_stats *stats);
double stage_spans(struct stage *s, struct device *device, const struct rays *rays,
                   struct render_stats *stats, uint64_t *intervals);

void stage_forget(struct stage *s); // empties the tables of combinations
