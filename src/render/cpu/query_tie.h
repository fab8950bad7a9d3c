// query_tie.h - crossings that rays meet at one place while queries move them: whose surface is it?
#pragma once
#include "render/cpu/query_tree.h"

#define query_is_thin    ISA_PASTE(query_is_thin, ISA)
#define query_note_pair  ISA_PASTE(query_note_pair, ISA)
#define query_note_crowd ISA_PASTE(query_note_crowd, ISA)
#define query_drop_ties  ISA_PASTE(query_drop_ties, ISA)
#define query_settle     ISA_PASTE(query_settle, ISA)

// Is the interval between two crossings, `a` in front of `b`, too thin to exist?
bool query_is_thin(struct query *q, int ray, struct crossed a, struct crossed b);

// Notes two crossings if they are at one place, neither where the ray began.
void query_note_pair(struct query *q, int ray, enum tie_kind kind, struct crossed a,
                     struct crossed b);
// Notes two crossings at one place, at which others may matter too.
void query_note_crowd(struct query *q, int ray, struct crossed a, struct crossed b);

// Forgets the pairs from number `first` on that are not where the rays came to. Crowds stay: a leaf
// too thin to exist is no answer, but counts for what touches it.
void query_drop_ties(struct query *q, uint32_t first, const struct rays_at *s);

// Finds the owners where crossings are at one place, of the rays of the block.
void query_settle(struct query *q, struct rays_at *out);
