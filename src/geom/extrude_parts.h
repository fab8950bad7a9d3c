// extrude_parts.h - what the extrusions share: rings of the outline's points, and caps.
#pragma once
#include "geom/extrude.h"
#include "geom/mesh.h"

// A mesh of rings: ring r has the vertices from r * o->point_count on, one for each point.
struct rings {
    const struct outline *o;
    struct mesh_builder b;
    uint32_t (*cap)[3]; // triangles over the outline's points, made with the first cap
    uint32_t cap_count;
};

bool rings_are_finite(const struct outline *o); // has it numbers only?
// Would the solid of so many bands between rings, with two caps, not become too large?
bool rings_fit(const struct outline *o, double bands, struct error *err);
// Room for all of it at once.
void rings_reserve(struct rings *r, uint32_t bands);
// The inside of a ring as one face, which looks along the outline's z unless it is reversed.
void rings_cap(struct rings *r, uint32_t ring, bool reversed);
void rings_finish(struct rings *r, struct mesh *out); // gives the mesh over, welded

// The number of slices where none is given; may be beyond all numbers of an integer.
double linear_slices(const struct outline *o, const struct linear_extrusion *how);
// Cuts long edges, as newer programs do it before they twist and scale. False when more than `most`
// points would come out.
bool linear_cut_edges(struct outline *out, const struct outline *o,
                      const struct linear_extrusion *how, uint32_t slices, double most);
