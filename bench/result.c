// result.c - what was measured on one scene.
#include "result.h"

const struct setting opencsg_settings[OPENCSG_SETTINGS] = {
    {"automatic", "automatic", false},
    {"automatic+boxes", "automatic", true},
    {"scs", "scs", false},
    {"goldfeather", "goldfeather", false},
};

void result_free(struct result *r)
{
    struct samples *all[] = {&r->parse,
                             &r->build,
                             &r->picture,
                             &r->setup,
                             &r->draw,
                             &r->spans,
                             &r->picture_extra,
                             &r->spans_extra,
                             &r->edits.tree,
                             &r->edits.model,
                             &r->edits.whole,
                             &r->edits.steady,
                             &r->edits.over_steady,
                             &r->gl.opaque.frames,
                             &r->gl.spans.frames,
                             &r->gl.array_opaque.frames,
                             &r->gl.array_spans.frames};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        samples_free(all[i]);
    for (int i = 0; i < WALKS; i++) {
        samples_free(&r->walk_picture[i]);
        samples_free(&r->walk_spans[i]);
    }
    for (int i = 0; i < OPENCSG_SETTINGS; i++)
        samples_free(&r->opencsg[i].frames);
    *r = (struct result){0};
}

int result_best_opencsg(const struct result *r)
{
    int best = -1;
    for (int i = 0; i < OPENCSG_SETTINGS; i++)
        if (r->opencsg[i].frames.count &&
            (best < 0 ||
             samples_median(&r->opencsg[i].frames) < samples_median(&r->opencsg[best].frames)))
            best = i;
    return best;
}
