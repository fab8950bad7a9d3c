// dxf_lines.h - lines of a drawing with their ends on a grid, joined to closed paths.
#pragma once
#include "base/error.h"
#include "geom/outline.h"

enum { DXF_LINES_MAX = 1 << 24 };

struct dxf_line {
    uint32_t end[2]; // numbers of points
};

// {0} is valid and empty.
struct dxf_lines {
    struct vec2 *points;
    uint32_t point_count, point_room;
    uint32_t *slots; // hash table of the points by grid cell; 0 is free, else a number plus one
    uint32_t slot_count;
    struct dxf_line *lines;
    uint32_t line_count, line_room;
};

void dxf_lines_free(struct dxf_lines *l);

// The point that stands for p: its grid point, or one beside it that is in use already. p must lie
// within DXF_REACH of the origin.
#define DXF_REACH 0x1p46
uint32_t dxf_lines_point(struct dxf_lines *l, struct vec2 p);
void dxf_lines_add(struct dxf_lines *l, uint32_t a, uint32_t b);

// Joins the lines end to end in OpenSCAD's order: chains with a free end first, then loops. Every
// path is closed.
void dxf_lines_join(const struct dxf_lines *l, struct outline *out);
