// report_paper.c - what the HCSG paper's program took, what is wanted here, and what gl takes.
#include "report.h"

#include "base/mem.h"

#include <string.h>

// ms of a frame, 1024 x 1024, three slabs, on a GeForce Titan Black of 2014: Tables 2 and 3, and
// for the instances its section 7. Wanted is a tenth; of the instances what stands there.
static const struct paper {
    const char *scene;
    double hash[2], array[2]; // transparent, opaque
    double wanted;            // 0: a tenth of `hash`
} papers[] = {
    {"printer", {10.9, 9.1}, {12.6, 7.5}, 0},
    {"spider", {13.9, 10.1}, {24.8, 15.0}, 0},
    {"gears", {18.4, 16.1}, {30.5, 21.8}, 0},
    {"cardans", {37.6, 26.3}, {523.2, 158.0}, 0},
    {"cheese31M", {131.5, 98.2}, {194.0, 196.6}, 0},
    {"spheres8M", {116.2, 103.1}, {400.3, 253.1}, 0},
    {"cubes", {89.4, 69.5}, {258.9, 137.9}, 0},
    {"minus493", {284, 263}, {0, 0}, 60},
    {"plus493", {284, 263}, {0, 0}, 60},
};

static const struct paper *paper_of(const struct result *r)
{
    for (size_t i = 0; i < array_count(papers); i++)
        if (strcmp(papers[i].scene, r->scene->name) == 0)
            return &papers[i];
    return NULL;
}

static void number(FILE *out, double ms)
{
    if (ms > 0)
        fprintf(out, " %.1f |", ms);
    else
        fprintf(out, " – |");
}

static void row(FILE *out, const struct result *r, const struct paper *p)
{
    const struct gl_kind *hash[2] = {&r->gl.spans, &r->gl.opaque};
    const struct gl_kind *array[2] = {&r->gl.array_spans, &r->gl.array_opaque};
    fprintf(out, "| %s |", p->scene);
    for (int i = 0; i < 2; i++) {
        number(out, p->array[i]);
        number(out, p->hash[i]);
        fprintf(out, " %.2f |", p->wanted > 0 ? p->wanted : p->hash[i] / 10);
        if (r->gl.measured) {
            number(out, samples_median(&array[i]->frames));
            fprintf(out, " **%.2f** |", samples_median(&hash[i]->frames));
        } else {
            fprintf(out, " not measured | |");
        }
    }
    fprintf(out, "\n");
}

void report_paper_table(FILE *out, const struct result *results, uint32_t count)
{
    bool begun = false;
    for (uint32_t i = 0; i < count; i++) {
        const struct paper *p = paper_of(&results[i]);
        if (p && !begun)
            fprintf(out, "\n### Beside the paper's figures, ms of a whole frame\n\n"
                         "| scene | transparent, paper: array | hash | wanted | gl: array | hash | "
                         "opaque, paper: array | hash | wanted | gl: array | hash |\n"
                         "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
        begun |= p != NULL;
        if (p)
            row(out, &results[i], p);
    }
}
