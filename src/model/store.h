// store.h - solids by content: equal shapes exist once, and live on from reload to reload.
#pragma once
#include "geom/solid.h"
#include "model/model.h"

// The key is a hash of what the solid is made from. NULL when it is not there.
const struct solid *store_find(const struct solid_store *s, uint64_t key);
// Takes the mesh over (leaves *m empty). The key must not be there yet.
const struct solid *store_add(struct solid_store *s, uint64_t key, struct mesh *m, bool convex);

// A model holds each of its solids once per leaf. Solids that nothing holds live until store_sweep.
void store_hold(struct solid_store *s, const struct solid *solid);
void store_release(const struct solid *solid);
void store_sweep(struct solid_store *s);

// The store lives as long as its maker or one model uses it. A model that goes while others stay
// takes its unheld solids along; the last one leaves them for the model that comes next.
void store_join(struct solid_store *s);
void store_leave(struct solid_store *s);

// Counts the solids that were held for the first time since store_count_from.
void store_count_from(struct solid_store *s);
uint32_t store_counted(const struct solid_store *s);
