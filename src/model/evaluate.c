// evaluate.c - evaluated nodes out of the store, or made side by side and put there.
#include "model/evaluate.h"

#include "base/parallel.h"
#include "model/evaluation.h"
#include "model/nodes.h"

#include <stdlib.h>

static const struct geometry *make(struct builder *b, const struct csg_node *n, struct detail d,
                                   const struct digest *digests, uint64_t key)
{
    struct geometry g = {0};
    if (evaluation_run(b, n, d, digests, &g))
        return store_add_geometry(b->store, key, &g);
    geometry_free(&g);
    return NULL;
}

const struct geometry *evaluate_node(struct builder *b, const struct csg_node *n, struct detail d)
{
    struct digest *digests = digest_tree(n);
    uint64_t key = evaluation_key(digests[0].hash, d);
    const struct geometry *g = store_geometry(b->store, key, n->line);
    if (!g && b->collecting) {
        array_reserve(&b->jobs, &b->job_room, (size_t)b->job_count + 1);
        b->jobs[b->job_count++] = (struct job){n, d, key};
    } else if (!g)
        g = make(b, n, d, digests, key);
    free(digests);
    if (g)
        evaluation_tell(b, g);
    return g;
}

bool evaluate_once(struct builder *b, const struct csg_node *n, struct geometry *out)
{
    struct digest *digests = digest_tree(n);
    *out = (struct geometry){0};
    bool done = evaluation_run(b, n, DETAIL_DEFAULT, digests, out);
    evaluation_tell(b, out);
    free(digests);
    return done;
}

bool evaluates_flat(const struct csg_node *root)
{
    struct csg_iterator it = {0};
    const struct csg_node *n;
    enum geometry_kind kind = GEOMETRY_NONE;
    csg_enter(&it, root->child);
    while (kind == GEOMETRY_NONE && (n = csg_next(&it))) {
        if (n->modifiers & (CSG_DISABLE | CSG_BACKGROUND))
            continue;
        const struct node_type *type = node_type_of(n->name);
        kind = type->kind == NODE_IMPORT ? import_type_of(n)->gives : type->gives;
        csg_enter(&it, n->child);
    }
    csg_iterator_free(&it);
    return kind == GEOMETRY_FLAT;
}

static void evaluate_job(void *context, uint32_t item, uint32_t worker)
{
    struct builder *b = context;
    const struct job *j = &b->jobs[item];
    (void)worker;
    if (builder_cancelled(b))
        return;
    struct digest *digests = digest_tree(j->node);
    make(b, j->node, j->detail, digests, j->key);
    free(digests);
}

static int by_key(const void *a, const void *b)
{
    uint64_t p = ((const struct job *)a)->key, q = ((const struct job *)b)->key;
    return p < q ? -1 : p > q;
}

void evaluate_collected(struct builder *b)
{
    uint32_t kept = 0;
    if (b->job_count)
        qsort(b->jobs, b->job_count, sizeof *b->jobs, by_key);
    for (uint32_t i = 0; i < b->job_count; i++)
        if (!i || b->jobs[i].key != b->jobs[kept - 1].key)
            b->jobs[kept++] = b->jobs[i];
    parallel_for(kept, 0, evaluate_job, b);
    free(b->jobs);
    b->jobs = NULL;
    b->job_count = b->job_room = 0;
}
