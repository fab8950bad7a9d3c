// report.c - what a person needs to find a bug.
#include "report.h"

#include "base/mem.h"

#include <stdlib.h>

void report_device(FILE *out, const struct rays *rays, const struct picture *p, int x, int y)
{
    double reference = rays->reference;
    int i = y * rays->width + x;
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

static void print_crossings(FILE *out, const struct rays *rays, const struct oracle_ray *ray)
{
    fprintf(out, "  near %g far %g, ray (%.9g %.9g %.9g) + t (%.9g %.9g %.9g)\n", rays->near,
            rays->far, ray->origin.x, ray->origin.y, ray->origin.z, ray->direction.x,
            ray->direction.y, ray->direction.z);
    for (uint32_t i = 0; i < ray->crossing_count && i < 100; i++) {
        const struct oracle_crossing *k = &ray->crossings[i];
        fprintf(out, "    %.9f %s leaf %u face %u, |n.d| %.6g\n", k->depth,
                k->delta > 0 ? "into" : "out of", k->leaf, k->face, k->cosine);
    }
}

void report_pixel(FILE *out, const struct comparison *c, const struct picture *p, int x, int y)
{
    report_device(out, c->rays, p, x, y);
    fprintf(out, "  oracle spans (%u):", c->answer.count);
    for (uint32_t k = 0; k < c->answer.count; k++)
        fprintf(out, " [%.6f .. %.6f]", c->answer.spans[k].enter.low, c->answer.spans[k].leave.low);
    fprintf(out, "\n");
    print_crossings(out, c->rays, &c->ray);
}

void report_crossings(FILE *out, const struct body *body, const struct rays *rays, int x, int y)
{
    size_t token_count;
    struct expr_token *tokens = subject_tokens(&body->expr, &token_count);
    struct oracle_leaf *leaves = subject_leaves(body);
    struct oracle_ray ray = {0};
    struct oracle oracle;
    oracle_init(&oracle, leaves, body->leaf_count, tokens, token_count);
    oracle_cast(&oracle, rays, x, y, &ray);
    print_crossings(out, rays, &ray);
    oracle_ray_free(&ray);
    oracle_free(&oracle);
    free(leaves);
    free(tokens);
}

struct judgement {
    enum verdict verdict;
    enum fit reason;
};

static struct judgement judge(struct device *device, const struct random_scene *scene,
                              const struct render_settings *settings, int x, int y, FILE *out)
{
    struct subject subject;
    struct picture picture;
    struct oracle oracle;
    subject_make(&subject, scene);
    picture_render(&picture, device, &subject.body, &scene->rays, settings);
    struct oracle_leaf *leaves = subject_leaves(&subject.body);
    oracle_init(&oracle, leaves, scene->leaf_count, scene->tokens, scene->token_count);
    struct comparison c = {
        .oracle = &oracle, .rays = &scene->rays, .epsilon = settings->epsilon, .tolerance = 2e-3};
    struct judgement result = {.verdict = compare_pixel(&c, &picture, x, y)};
    result.reason = c.reason;
    if (out) {
        compare_pixel(&c, &picture, x, y); // once more: judging cast other rays
        fprintf(out, "  reason: %s\n", fit_text[c.reason]);
        report_pixel(out, &c, &picture, x, y);
    }
    compare_free(&c);
    oracle_free(&oracle);
    free(leaves);
    picture_free(&picture);
    subject_free(&subject);
    return result;
}

// The expression with the empty operands left out.
static void print_expression(FILE *out, const struct random_scene *s)
{
    char **stack = mem_zalloc((s->token_count + 1) * sizeof *stack);
    uint32_t top = 0;
    for (uint32_t i = 0; i < s->token_count; i++) {
        struct expr_token t = s->tokens[i];
        char *text = NULL, *joined;
        if (t.op == EXPR_LEAF && asprintf(&text, "%u", t.arg) < 0)
            abort();
        bool empty = t.op == EXPR_DIFFERENCE && t.arg && !stack[top - t.arg];
        for (uint32_t k = top - (t.op == EXPR_LEAF ? 0 : t.arg); k < top; k++) {
            empty |= t.op == EXPR_INTERSECTION && !stack[k];
            if (stack[k] && text) {
                const char *sign = t.op == EXPR_UNION ? "+" : t.op == EXPR_DIFFERENCE ? "-" : "*";
                if (asprintf(&joined, "(%s %s %s)", text, sign, stack[k]) < 0)
                    abort();
                free(text);
                free(stack[k]);
                text = joined;
            } else if (stack[k]) {
                text = stack[k];
            }
        }
        top -= t.op == EXPR_LEAF ? 0 : t.arg;
        if (empty)
            free(text);
        stack[top++] = empty ? NULL : text;
    }
    fprintf(out, "  %s\n", top && stack[0] ? stack[0] : "empty");
    if (top)
        free(stack[0]);
    free(stack);
}

static void print_scene(FILE *out, const struct random_scene *s)
{
    for (uint32_t i = 0; i < s->token_count; i++) {
        struct expr_token t = s->tokens[i];
        if (t.op != EXPR_LEAF)
            continue;
        const struct random_leaf *leaf = &s->leaves[t.arg];
        const struct random_mesh *mesh = &s->meshes[leaf->mesh];
        const double(*m)[4] = leaf->to_world.m;
        fprintf(out, "  leaf %u: %s fn=%d %s\n", t.arg, shape_names[mesh->shape], mesh->fn,
                mesh->convex ? "convex" : "mesh");
        for (int r = 0; r < 3; r++)
            fprintf(out, "    %.17g %.17g %.17g %.17g\n", m[r][0], m[r][1], m[r][2], m[r][3]);
    }
    print_expression(out, s);
}

void report_smallest(FILE *out, struct device *device, struct random_scene *scene,
                     const struct render_settings *settings, int x, int y)
{
    struct judgement whole = judge(device, scene, settings, x, y, out);
    if (whole.verdict == VERDICT_AGREES)
        return;
    for (uint32_t i = 0; i < scene->token_count; i++) {
        struct expr_token kept = scene->tokens[i];
        if (kept.op != EXPR_LEAF)
            continue;
        scene->tokens[i] = (struct expr_token){EXPR_UNION, 0};
        struct judgement now = judge(device, scene, settings, x, y, NULL);
        if (now.verdict != whole.verdict || now.reason != whole.reason)
            scene->tokens[i] = kept;
    }
    fprintf(out, "smallest:\n");
    print_scene(out, scene);
    judge(device, scene, settings, x, y, out);
}
