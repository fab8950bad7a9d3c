// store.h - solids and geometries by content: equal ones exist once, and live on from reload to
// reload. Looking up and adding are thread-safe.
#pragma once
#include "geom/solid.h"
#include "model/geometry.h"
#include "model/model.h"

// The key is a hash of what the solid is made from. NULL when it is not there.
const struct solid *store_find(struct solid_store *s, uint64_t key);
// Takes the mesh over (leaves *m empty). The key must not be there yet.
const struct solid *store_add(struct solid_store *s, uint64_t key, struct mesh *m, bool convex,
                              enum solid_cut cut);

// Is its mesh, as it was written, the border of a solid? Looked at once.
bool store_is_closed(struct solid_store *s, const struct solid *solid);

// The plate that shows a flat shape, z from -0.5 to 0.5; NULL for an empty one.
const struct solid *store_plate(struct solid_store *s, const struct outline *o);
// The solid of a mesh by its content, out of the store or put there. Takes the mesh over.
const struct solid *store_mesh(struct solid_store *s, struct mesh *m, bool convex);

// What a node in a line evaluates to, by the hash of all that stands in it: NULL when it is not
// there, or when a file it was made from or the line that its messages name has changed since.
const struct geometry *store_geometry(struct solid_store *s, uint64_t key, uint32_t line);
// Takes the geometry over (leaves *g none) and holds its solids; returns the one that stays: an
// equal one if another thread was first. It stays until store_forget.
const struct geometry *store_add_geometry(struct solid_store *s, uint64_t key, struct geometry *g);

// A model holds each of its solids once per leaf. Solids that nothing holds live until store_sweep.
void store_hold(struct solid_store *s, const struct solid *solid);
void store_release(const struct solid *solid);
void store_sweep(struct solid_store *s);
// Gives up the geometries that were not asked for since store_count_from.
void store_forget(struct solid_store *s);

// The store lives as long as its maker or one model uses it. A model that goes while others stay
// takes its unheld solids along; the last one leaves them for the model that comes next.
void store_join(struct solid_store *s);
void store_leave(struct solid_store *s);

// Counts the solids that were held for the first time since store_count_from.
void store_count_from(struct solid_store *s);
uint32_t store_counted(const struct solid_store *s);
