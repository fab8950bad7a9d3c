// cluster.h - crossings of a ray at one place, where surfaces touch: which face shows there?
#pragma once
#include "render/cpu/combination.h"

#define cluster_owner      ISA_PASTE(cluster_owner, ISA)
#define cluster_room_bytes ISA_PASTE(cluster_room_bytes, ISA)
#define cluster_room_free  ISA_PASTE(cluster_room_free, ISA)

// Room to work in, kept from cluster to cluster.
struct cluster_room {
    crossing *rest;    // a list without some crossings
    crossing *ordered; // one in another order
    uint32_t rest_capacity, ordered_capacity;
    bool *border, *kept; // per crossing of the cluster
    uint32_t border_capacity, kept_capacity;
    uint32_t *turns; // crossings of the cluster that turn the state
    uint32_t turn_capacity;
};

size_t cluster_room_bytes(const struct cluster_room *room);
void cluster_room_free(struct cluster_room *room);

// Crossings items[from .. to) of the sorted list of a ray.
struct cluster {
    int ray;
    const crossing *items;
    uint32_t from, to;
    struct combination *behind;
    struct cluster_room *room;
};

// Of a cluster that makes the state `solid`, the crossing whose surface shows there.
crossing cluster_owner(const struct cluster *c, bool solid);
