// summary.c - numbers about a model and its picture.
#include "command/summary.h"

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

void summary_print(FILE *out, const struct summary *s)
{
    const struct model *m = s->model;
    char camera[CAMERA_TEXT];
    uint32_t combinations = 0;
    for (uint32_t i = 0; i < m->body_count; i++)
        combinations += discovery_stats(m->bodies[i].table).combinations;
    camera_print(&s->drawn->camera, camera);
    fprintf(out, "Nodes:         %u\n", m->stats.nodes);
    fprintf(out, "Leaves:        %u\n", m->stats.leaves);
    fprintf(out, "Solids:        %u\n", m->stats.solids);
    fprintf(out, "Triangles:     %u\n", m->stats.triangles);
    fprintf(out, "Not drawn:     %u\n", m->stats.unsupported);
    fprintf(out, "Combinations:  %u\n", combinations);
    fprintf(out, "Open rays:     %llu\n", (unsigned long long)s->drawn->stats.open_rays);
    fprintf(out, "Warnings:      %u\n", s->messages->warnings);
    print_box(out, m->bounds);
    fprintf(out, "Camera:        --camera=%s\n", camera);
    fprintf(out, "Picture:       %d x %d\n", s->request->width, s->request->height);
    fprintf(out, "Time:          read %.1f ms, build %.1f ms, draw %.1f ms, write %.1f ms\n",
            s->times.read * 1e3, s->times.build * 1e3, s->times.draw * 1e3, s->times.write * 1e3);
}
