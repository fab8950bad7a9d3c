// dxf_drawing.h - what is kept while a DXF drawing is read: the entity at hand, lines and blocks.
#pragma once
#include "base/mem.h"
#include "io/dxf_lines.h"
#include "io/read_dxf.h"

struct span { // of the file's text
    const char *text;
    size_t length;
};

// Everything the groups of one entity say. Names follow the group codes, as meanings differ.
struct entity {
    struct span kind;
    uint32_t line; // in the file
    struct span name, layer;
    double *x, *y; // codes 10 to 13 and 20 to 23, in their order
    uint32_t x_count, y_count, x_room, y_room;
    double c40, c41, c42, c50, c51;
    uint32_t flags; // code 70
};

// Lines of a block hang together by number, since a block may go on in a later BLOCK.
struct block_line {
    struct dxf_line line;
    uint32_t next;
};

struct block {
    struct span name;
    uint32_t first, last, count; // first and last only when count is not 0
};

enum section { SECTION_OTHER, SECTION_BLOCKS, SECTION_ENTITIES };

struct drawing {
    const struct dxf_options *options;
    struct place place; // the file
    struct messages *messages;
    enum section section;
    struct entity entity;
    struct dxf_lines lines;
    struct block *blocks;
    uint32_t block_count, block_room;
    uint32_t *slots; // hash table of the blocks by name, as that of the points
    uint32_t slot_count;
    uint32_t block; // the one being defined, or UINT32_MAX
    struct block_line *block_lines;
    uint32_t block_line_count, block_line_room;
    bool full;    // DXF_LINES_MAX is reached
    bool too_far; // a line left out lies beyond DXF_REACH
};

void drawing_free(struct drawing *d);
// The block of a name, made when there is none yet.
uint32_t drawing_block(struct drawing *d, struct span name);
bool span_is(struct span s, const char *text);

// Draws the entity. False when its kind is not known.
bool entity_draw(struct drawing *d);
