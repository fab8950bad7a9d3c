// shade.h - from surfaces to colours: materials, OpenSCAD's light, transparency.
#pragma once
#include "model/model.h"
#include "render/facing.h"
#include "render/normals.h"
#include "render/rays.h"
#include "render/scheme.h"

struct rgba {
    uint8_t r, g, b, a;
};

// How one leaf is coloured.
struct material {
    float r, g, b; // 0..1, may exceed it
    uint8_t alpha;
    bool unlit;
    bool alone;    // the leaf is neither cut nor intersected: its far side shows through it
    uint32_t part; // number of the member of the body's outermost union that the leaf stands in
};

struct body_shading {
    struct material *materials; // per leaf of the body
    bool opaque;                // all leaves that can show are
    uint32_t part_count;
};

// What colouring a model needs; made once for a model and a scheme, which are borrowed.
struct shader {
    const struct model *model;
    const struct scheme *scheme;
    struct body_shading *bodies; // per body of the model
    struct normals normals;
    struct facing facing; // THROWN_TOGETHER
    // The order in which see-through surfaces are drawn, borrowed; NULL: the far ones first.
    const struct layers *layers;
    // What edges to show, borrowed; NULL: none.
    const struct facets *edges;
};

void shader_init(struct shader *out, const struct model *m, const struct scheme *scheme);
void shader_free(struct shader *s); // leaves {0}

// The light moves with the viewer. Directions are unit vectors of the world.
struct light {
    struct vec3 direction, view_axis;
    struct viewpoint from;
};
struct light light_of(const struct rays *rays);

// The lit colour of a face of a leaf (SURFACE_CAP included).
struct rgba shade_face(const struct shader *s, uint32_t body, const struct light *light,
                       uint32_t leaf, uint32_t face);

// The same where an edge covers a share of the pixel: its colour is lighter, unlit and opaque.
struct rgba shade_edge(const struct shader *s, uint32_t body, const struct light *light,
                       uint32_t leaf, uint32_t face, double cover);

// Lit colours met lately. Neighbouring pixels mostly show the same few faces.
enum { SHADE_CACHE = 512 };
struct shade_cache {
    struct {
        uint32_t leaf, face;
        struct rgba colour;
    } entries[SHADE_CACHE];
};
void shade_cache_clear(struct shade_cache *c);

static inline struct rgba shade_cached(struct shade_cache *c, const struct shader *s, uint32_t body,
                                       const struct light *light, uint32_t leaf, uint32_t face)
{
    uint32_t i = (leaf * 31 + face) % SHADE_CACHE;
    if (c->entries[i].leaf != leaf || c->entries[i].face != face) {
        c->entries[i].leaf = leaf;
        c->entries[i].face = face;
        c->entries[i].colour = shade_face(s, body, light, leaf, face);
    }
    return c->entries[i].colour;
}
