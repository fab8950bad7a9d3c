// combination.h - the set of solids around the current interval of a ray: a sum that each crossing
// changes, and whether it is inside the model.
#pragma once
#include "hcsg/discovery.h"
#include "render/cpu/crossing_list.h"

#define combination_init     ISA_PASTE(combination_init, ISA)
#define combination_bytes    ISA_PASTE(combination_bytes, ISA)
#define combination_free     ISA_PASTE(combination_free, ISA)
#define combination_begin    ISA_PASTE(combination_begin, ISA)
#define combination_carry    ISA_PASTE(combination_carry, ISA)
#define combination_discover ISA_PASTE(combination_discover, ISA)
#define combination_evaluate ISA_PASTE(combination_evaluate, ISA)

struct combination {
    struct tile *t;
    uint64_t key; // the sum of the values of the classes

    // evaluation of keys that the table does not know
    struct member *members;
    uint32_t member_count, member_capacity;
    const crossing *replayed; // the list whose first crossings, after the base, made the members
    uint32_t replayed_count;
    struct member *base; // combination at the start of the list being walked
    uint32_t base_count, base_capacity;

    // the array method, in place of the key
    bool array;
    uint64_t counted_identity; // of the body
    struct expr counted;       // its expression over classes
    int32_t *inside;           // per class
    bool *solid;               // per node of `counted`
};

void combination_init(struct combination *s, struct tile_room room);
size_t combination_bytes(const struct combination *s, struct tile_room room);
void combination_free(struct combination *s);

// Makes it empty, for a ray of the tile.
void combination_begin(struct combination *s, struct tile *t);

// Makes the combination before items[taken] the base of the next list.
void combination_carry(struct combination *s, const crossing *items, uint32_t taken);

// Call it when crossings in a list that was asked about become others.
static inline void combination_forget_list(struct combination *s)
{
    s->replayed = NULL;
}

// Counts a crossing in, or (back) takes it out again.
static inline void combination_step(struct combination *s, crossing c, bool back)
{
    const struct body *b = s->t->frame->body;
    uint32_t id = (uint32_t)c, leaf = s->t->leaves[id >> 1].leaf;
    bool in = !(id & 1) != back;
    if (s->array) {
        s->inside[b->sharing.class_of_leaf[leaf]] += in ? 1 : -1;
        return;
    }
    uint64_t value = b->sharing.classes[b->sharing.class_of_leaf[leaf]].value;
    s->key += in ? value : (uint64_t)0 - value;
}

// For combination_is_solid: the slow ways.
bool combination_discover(struct combination *s, const crossing *items, uint32_t n);
bool combination_evaluate(struct combination *s);

// Is it inside the model? The base and the crossings items[0 .. n) are what it was made of.
static inline bool combination_is_solid(struct combination *s, const crossing *items, uint32_t n)
{
    if (s->array)
        return combination_evaluate(s);
    int state = discovery_lookup(s->t->frame->body->table, s->key);
    return state == SET_UNKNOWN ? combination_discover(s, items, n) : state == SET_SOLID;
}
