// summary.c - numbers about a model and its picture.
#include "command/summary.h"

#include "render/extent.h"

static void print_box(FILE *out, struct box b)
{
    if (box_is_empty(b)) {
        fprintf(out, "Bounding box:  empty\n");
        return;
    }
    struct vec3 size = vec3_sub(b.max, b.min);
    fprintf(out, "Bounding box:\n");
    fprintf(out, "   Min:  %.6g, %.6g, %.6g\n", b.min.x, b.min.y, b.min.z);
    fprintf(out, "   Max:  %.6g, %.6g, %.6g\n", b.max.x, b.max.y, b.max.z);
    fprintf(out, "   Size: %.6g, %.6g, %.6g\n", size.x, size.y, size.z);
}

static struct discovery_stats combinations(const struct model *m)
{
    struct discovery_stats all = {0};
    for (uint32_t i = 0; i < m->body_count; i++) {
        struct discovery_stats one = discovery_stats(m->bodies[i].table);
        all.combinations += one.combinations;
        all.bytes += one.bytes;
    }
    return all;
}

bool summary_is_flat(const struct model *m)
{
    bool flat = m->stats.leaves > 0;
    for (uint32_t i = 0; i < m->body_count; i++)
        for (uint32_t k = 0; k < m->bodies[i].leaf_count; k++)
            flat &= m->bodies[i].leaves[k].flat;
    return flat;
}

void summary_measure(struct summary *s)
{
    const struct drawn *d = s->drawn;
    s->combinations = combinations(s->model);
    s->depths = map_depth_range(&d->map, &d->rays);
    if (s->request->summary & SUMMARY_BOX)
        s->box = extent_find(d->device, s->model, &d->settings);
    if (s->request->summary & SUMMARY_MEASURED)
        measure_model(&s->measure, d->device, s->model, &d->settings, MEASURE_ACCURACY);
}

// As many digits as the bound leaves meaning to.
static void print_measured(FILE *out, const char *name, struct measured v, const char *unit)
{
    fprintf(out, "%-14s %.6g %s, +- %.1g\n", name, v.value, unit, v.bound);
}

static void print_measures(FILE *out, const struct summary *s)
{
    const struct measure *m = &s->measure;
    uint32_t parts = s->request->summary;
    if (parts & SUMMARY_AREA)
        print_measured(out, "Area:", m->area, "mm2");
    if (parts & SUMMARY_VOLUME) {
        print_measured(out, "Volume:", m->volume, "mm3");
        fprintf(out, "Centre:        %.6g, %.6g, %.6g\n", m->centre[0].value, m->centre[1].value,
                m->centre[2].value);
    }
    if (parts & SUMMARY_MASS)
        print_measured(out, "Mass:", measure_mass(m, s->request->density), "g");
    if (m->open_rays)
        fprintf(out, "Measured:      without a bound, the model has meshes that are not closed\n");
}

static void print_geometry(FILE *out, const struct summary *s)
{
    const struct model_stats *m = &s->model->stats;
    fprintf(out, "Nodes:         %u\n", m->nodes);
    fprintf(out, "Leaves:        %u\n", m->leaves);
    fprintf(out, "Solids:        %u\n", m->solids);
    fprintf(out, "Triangles:     %u\n", m->triangles);
    fprintf(out, "Not drawn:     %u\n", m->unsupported);
    fprintf(out, "Warnings:      %u\n", s->messages->warnings);
}

void summary_print(FILE *out, const struct summary *s)
{
    uint32_t parts = s->request->summary;
    const struct timing *t = &s->times;
    if (parts & SUMMARY_GEOMETRY)
        print_geometry(out, s);
    if (parts & SUMMARY_CACHE) {
        fprintf(out, "Combinations:  %u\n", s->combinations.combinations);
        fprintf(out, "Open rays:     %llu\n", (unsigned long long)s->drawn->stats.open_rays);
    }
    if (parts & SUMMARY_BOX)
        print_box(out, s->box);
    if (parts & SUMMARY_MEASURED)
        print_measures(out, s);
    if (parts & SUMMARY_CAMERA) {
        char camera[CAMERA_TEXT];
        camera_print(&s->drawn->camera, camera);
        fprintf(out, "Camera:        --camera=%s\n", camera);
        fprintf(out, "Picture:       %d x %d\n", s->request->width, s->request->height);
        if (depth_range_is_known(s->depths))
            fprintf(out, "Depth:         %.9g to %.9g\n", s->depths.nearest, s->depths.farthest);
    }
    if (parts & SUMMARY_TIME)
        fprintf(out, "Time:          read %.1f ms, build %.1f ms, draw %.1f ms, write %.1f ms\n",
                t->read * 1e3, t->build * 1e3, t->draw * 1e3, t->write * 1e3);
}
