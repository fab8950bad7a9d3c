// output.h - what is asked for, drawn and written.
#pragma once
#include "command/request.h"
#include "render/picture.h"

struct drawn { // {0} is valid
    struct picture picture;
    struct camera camera; // the one that drew it
    struct render_stats stats;
};

// Whether any output is a picture, or numbers about one are wanted.
bool request_draws(const struct request *r);
bool drawn_make(struct drawn *out, const struct request *r, const struct model *m,
                struct error *err);
void drawn_free(struct drawn *d); // leaves {0}

bool output_write(const struct output *o, const struct drawn *d, const struct model *m,
                  struct error *err);
