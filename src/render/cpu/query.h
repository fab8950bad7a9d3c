// query.h - first surfaces by interval queries: where is a shape next entered, where next left?
//
// For the first surface nothing has to be listed. A ray stands at a key and asks the expression for
// the next key at which it is inside: a leaf answers with its entry, a union with the least of its
// children's answers, an intersection moves the ray on until all of its operands agree, a
// subtrahend moves it to where the subtracted shape is left. Each step skips everything between, a
// block of rays at a time. Answers equal those of the list walk in walk.h, which serves deep
// expressions.
#pragma once
#include "render/cpu/tile.h"

// Keys and owners of the rays of a block. Key FLT_MAX: nothing ahead. Owner: index of the tile leaf
// * 2, plus 1 when it is left there; -1: still where the ray began.
struct rays_at {
    v8f key[BLOCK];
    v8i owner[BLOCK];
};

#define query_new    ISA_PASTE(query_new, ISA)
#define query_bytes  ISA_PASTE(query_bytes, ISA)
#define query_delete ISA_PASTE(query_delete, ISA)
#define query_enter  ISA_PASTE(query_enter, ISA)
#define query_block  ISA_PASTE(query_block, ISA)

struct query;
struct query *query_new(struct tile *t);
size_t query_bytes(const struct query *q);
void query_delete(struct query *q);

// After tile_enter: prunes the expression of each part to the leaves that are in the tile.
void query_enter(struct query *q);
// After tile_block: the first surface of every ray of the block.
void query_block(struct query *q, struct rays_at *out);
