// report.c - what a person needs to find a bug.
#include "report.h"

#include "base/mem.h"

#include <stdlib.h>

static void print_device(FILE *out, const struct comparison *c, const struct picture *p, int i)
{
    double reference = c->rays->reference;
    if (p->image.leaf[i] == SURFACE_NONE)
        fprintf(out, "  device surface: none\n");
    else
        fprintf(out, "  device surface: %.6f leaf %u face %d\n", p->image.depth[i] + reference,
                p->image.leaf[i], (int)p->image.face[i]);
    fprintf(out, "  device spans (%u):", p->spans[i].count);
    for (uint32_t k = 0; k < p->spans[i].count; k++) {
        const struct span *s = &p->spans[i].items[k];
        fprintf(out, " [%.6f leaf %d face %d .. %.6f leaf %d face %d]", s->enter + reference,
                (int)s->enter_leaf, (int)s->enter_face, s->leave + reference, (int)s->leave_leaf,
                (int)s->leave_face);
    }
    fprintf(out, "\n");
}

void report_pixel(FILE *out, const struct comparison *c, const struct picture *p, int x, int y)
{
    print_device(out, c, p, y * c->rays->width + x);
    fprintf(out, "  oracle spans (%u):", c->answer.count);
    for (uint32_t k = 0; k < c->answer.count; k++)
        fprintf(out, " [%.6f .. %.6f]", c->answer.spans[k].enter.low, c->answer.spans[k].leave.low);
    fprintf(out, "\n  near %g far %g, ray (%.9g %.9g %.9g) + t (%.9g %.9g %.9g)\n", c->rays->near,
            c->rays->far, c->ray.origin.x, c->ray.origin.y, c->ray.origin.z, c->ray.direction.x,
            c->ray.direction.y, c->ray.direction.z);
    for (uint32_t i = 0; i < c->ray.crossing_count && i < 100; i++) {
        const struct oracle_crossing *k = &c->ray.crossings[i];
        fprintf(out, "    %.9f %s leaf %u face %u, |n.d| %.6g\n", k->depth,
                k->delta > 0 ? "into" : "out of", k->leaf, k->face, k->cosine);
    }
}

static enum verdict judge(const struct random_scene *scene, const struct render_settings *settings,
                          int x, int y, FILE *out)
{
    struct subject subject;
    struct picture picture;
    struct oracle oracle;
    subject_make(&subject, scene);
    picture_render(&picture, &subject.body, &scene->rays, settings);
    struct oracle_leaf *leaves = subject_leaves(&subject.body);
    oracle_init(&oracle, leaves, scene->leaf_count, scene->tokens, scene->token_count);
    struct comparison c = {
        .oracle = &oracle, .rays = &scene->rays, .epsilon = settings->epsilon, .tolerance = 2e-3};
    enum verdict verdict = compare_pixel(&c, &picture, x, y);
    if (out) {
        compare_pixel(&c, &picture, x, y); // once more: judging cast other rays
        fprintf(out, "  reason: %s\n", c.reason ? c.reason : "none");
        report_pixel(out, &c, &picture, x, y);
    }
    compare_free(&c);
    oracle_free(&oracle);
    free(leaves);
    picture_free(&picture);
    subject_free(&subject);
    return verdict;
}

static void print_scene(FILE *out, const struct random_scene *s)
{
    for (uint32_t i = 0; i < s->token_count; i++) {
        struct expr_token t = s->tokens[i];
        if (t.op != EXPR_LEAF) {
            fprintf(out, "  %c%u",
                    t.op == EXPR_UNION          ? '+'
                    : t.op == EXPR_INTERSECTION ? '*'
                                                : '-',
                    t.arg);
            continue;
        }
        const struct random_leaf *leaf = &s->leaves[t.arg];
        const struct random_mesh *mesh = &s->meshes[leaf->mesh];
        const double(*m)[4] = leaf->to_world.m;
        fprintf(out, "\n  leaf %u: %s fn=%d %s\n", t.arg, shape_names[mesh->shape], mesh->fn,
                mesh->convex ? "convex" : "mesh");
        for (int r = 0; r < 3; r++)
            fprintf(out, "    %.17g %.17g %.17g %.17g\n", m[r][0], m[r][1], m[r][2], m[r][3]);
    }
    fprintf(out, "\n");
}

void report_smallest(FILE *out, struct random_scene *scene, const struct render_settings *settings,
                     int x, int y)
{
    enum verdict whole = judge(scene, settings, x, y, out);
    if (whole < VERDICT_UNEXPLAINED)
        return;
    for (uint32_t i = 0; i < scene->token_count; i++) {
        struct expr_token kept = scene->tokens[i];
        if (kept.op != EXPR_LEAF)
            continue;
        scene->tokens[i] = (struct expr_token){EXPR_UNION, 0};
        if (judge(scene, settings, x, y, NULL) != whole)
            scene->tokens[i] = kept;
    }
    fprintf(out, "smallest:\n");
    print_scene(out, scene);
    judge(scene, settings, x, y, out);
}
