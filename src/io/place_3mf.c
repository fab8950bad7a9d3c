// place_3mf.c - the meshes of a 3MF package where its build puts them.
#include "base/sort.h"
#include "io/objects_3mf.h"

#include <stdlib.h>

// Objects made of objects twice, forty times over, are 2^40 meshes.
enum { STEPS_MOST = 1 << 20, TRIANGLES_MOST = 1 << 24 };

enum { MISSING = 0xffffffff };

struct frame {
    uint32_t object, next; // part
    struct affine place;
};

struct placing {
    const struct objects_3mf *objects;
    const char *path;
    struct sort_item *by_key;
    uint32_t *parts; // the objects that the parts are
    struct frame *frames;
    uint32_t frame_count, frame_room;
    struct mesh_set *out;
    struct error *err;
};

static void index_objects(struct placing *w)
{
    uint32_t n = w->objects->count;
    w->by_key = mem_alloc((size_t)n * sizeof *w->by_key);
    struct sort_item *spare = mem_alloc((size_t)n * sizeof *spare);
    for (uint32_t i = 0; i < n; i++)
        w->by_key[i] = (struct sort_item){w->objects->items[i].key, i};
    sort_items(w->by_key, spare, n);
    free(spare);
}

static uint32_t find_object(const struct placing *w, uint64_t key)
{
    uint32_t low = 0, high = w->objects->count;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (w->by_key[middle].key < key)
            low = middle + 1;
        else
            high = middle;
    }
    return low < w->objects->count && w->by_key[low].key == key ? w->by_key[low].index : MISSING;
}

static bool refuse_part(struct placing *w, const struct part_3mf *part)
{
    error_set(w->err, "%s: object %u is used but not there before", w->path, (uint32_t)part->key);
    return false;
}

// Objects use only those before them, so that none is part of itself.
static bool find_parts(struct placing *w)
{
    const struct objects_3mf *o = w->objects;
    w->parts = mem_alloc((size_t)o->part_count * sizeof *w->parts);
    for (uint32_t i = 0; i < o->count; i++)
        for (uint32_t k = 0; k < o->items[i].part_count; k++) {
            uint32_t part = o->items[i].first_part + k;
            w->parts[part] = find_object(w, o->parts[part].key);
            if (w->parts[part] >= i)
                return refuse_part(w, &o->parts[part]);
        }
    for (uint32_t i = 0; i < o->built_count; i++)
        if (find_object(w, o->built[i].key) == MISSING)
            return refuse_part(w, &o->built[i]);
    return true;
}

static uint64_t lesser(uint64_t a, uint64_t b)
{
    return a < b ? a : b;
}

// How much the build comes to, before any of it is made.
static bool is_affordable(struct placing *w)
{
    const struct objects_3mf *o = w->objects;
    uint64_t *steps = mem_alloc(((size_t)o->count + 1) * sizeof *steps);
    uint64_t *triangles = mem_alloc(((size_t)o->count + 1) * sizeof *triangles);
    for (uint32_t i = 0; i < o->count; i++) {
        const struct object_3mf *object = &o->items[i];
        steps[i] = 1;
        triangles[i] = object->mesh.triangle_count;
        for (uint32_t k = 0; k < object->part_count; k++) {
            uint32_t part = w->parts[object->first_part + k];
            steps[i] = lesser(steps[i] + steps[part], STEPS_MOST + 1);
            triangles[i] = lesser(triangles[i] + triangles[part], TRIANGLES_MOST + 1);
        }
    }
    uint64_t all_steps = 0, all_triangles = 0;
    for (uint32_t i = 0; i < o->built_count; i++) {
        uint32_t object = find_object(w, o->built[i].key);
        all_steps += steps[object];
        all_triangles += triangles[object];
    }
    free(steps);
    free(triangles);
    if (all_steps <= STEPS_MOST && all_triangles <= TRIANGLES_MOST)
        return true;
    error_set(w->err, "%s: the build is more than %d objects or %d triangles", w->path, STEPS_MOST,
              TRIANGLES_MOST);
    return false;
}

static bool place_mesh(struct placing *w, const struct mesh *m, const struct affine *place)
{
    struct mesh_builder b = {0};
    bool mirrored = affine_determinant(place) < 0;
    for (uint32_t i = 0; i < m->vertex_count; i++) {
        struct vec3 p = affine_point(place, m->vertices[i]);
        if (!isfinite(p.x) || !isfinite(p.y) || !isfinite(p.z)) {
            error_set(w->err, "%s: the build has coordinates that are not finite", w->path);
            mesh_free(&b.mesh);
            return false;
        }
        mesh_add_vertex(&b, p);
    }
    for (uint32_t i = 0; i < m->triangle_count; i++) {
        const uint32_t *t = m->triangles[i];
        mesh_add_triangle(&b, t[0], t[mirrored ? 2 : 1], t[mirrored ? 1 : 2], mesh_add_face(&b));
    }
    mesh_weld(&b.mesh);
    *mesh_set_add(w->out) = b.mesh;
    return true;
}

static void enter(struct placing *w, uint32_t object, const struct affine *place)
{
    array_reserve(&w->frames, &w->frame_room, (size_t)w->frame_count + 1);
    w->frames[w->frame_count++] = (struct frame){object, 0, *place};
}

static bool place_item(struct placing *w, const struct part_3mf *item)
{
    enter(w, find_object(w, item->key), &item->place);
    while (w->frame_count) {
        struct frame *f = &w->frames[w->frame_count - 1];
        const struct object_3mf *object = &w->objects->items[f->object];
        if (!f->next && object->mesh.triangle_count && !place_mesh(w, &object->mesh, &f->place))
            return false;
        if (f->next == object->part_count) {
            w->frame_count--;
            continue;
        }
        uint32_t part = object->first_part + f->next++;
        struct affine place = affine_mul(&f->place, &w->objects->parts[part].place);
        enter(w, w->parts[part], &place);
    }
    return true;
}

bool objects_3mf_place(const struct objects_3mf *o, const char *path, struct mesh_set *out,
                       struct error *err)
{
    struct placing w = {.objects = o, .path = path, .out = out, .err = err};
    index_objects(&w);
    bool ok = find_parts(&w) && is_affordable(&w);
    for (uint32_t i = 0; i < o->built_count && ok; i++)
        ok = place_item(&w, &o->built[i]);
    free(w.by_key);
    free(w.parts);
    free(w.frames);
    return ok;
}
