// dxf_lines.c - lines of a drawing with their ends on a grid.
#include "io/dxf_lines.h"

#include "base/hash.h"
#include "base/mem.h"

#include <stdlib.h>

enum { GRID = 1024 }; // cells per unit

struct cell {
    int64_t x, y;
};

static struct cell cell_of(struct vec2 p)
{
    return (struct cell){(int64_t)round(p.x * GRID), (int64_t)round(p.y * GRID)};
}

void dxf_lines_free(struct dxf_lines *l)
{
    free(l->points);
    free(l->slots);
    free(l->lines);
    *l = (struct dxf_lines){0};
}

// The slot of a cell, or the free one where it would go.
static uint32_t *find_slot(const struct dxf_lines *l, struct cell c)
{
    uint32_t mask = l->slot_count - 1;
    uint32_t at = (uint32_t)hash_mix(hash_mix((uint64_t)c.x) + (uint64_t)c.y) & mask;
    for (; l->slots[at]; at = (at + 1) & mask) {
        struct cell there = cell_of(l->points[l->slots[at] - 1]);
        if (there.x == c.x && there.y == c.y)
            break;
    }
    return &l->slots[at];
}

static void grow_slots(struct dxf_lines *l)
{
    if (l->slot_count && l->point_count < l->slot_count / 2)
        return;
    free(l->slots);
    l->slot_count = l->slot_count ? l->slot_count * 2 : 64;
    l->slots = mem_zalloc(l->slot_count * sizeof *l->slots);
    for (uint32_t i = 0; i < l->point_count; i++)
        *find_slot(l, cell_of(l->points[i])) = i + 1;
}

uint32_t dxf_lines_point(struct dxf_lines *l, struct vec2 p)
{
    grow_slots(l);
    struct cell c = cell_of(p);
    uint32_t *slot = find_slot(l, c);
    if (*slot)
        return *slot - 1;

    // With each find OpenSCAD goes on looking around the cell it found, not around that of p.
    uint32_t found = 0;
    int64_t least = INT64_MAX;
    struct cell around = c;
    for (int64_t x = around.x - 1; x <= around.x + 1; x++)
        for (int64_t y = around.y - 1; y <= around.y + 1; y++) {
            uint32_t there = *find_slot(l, (struct cell){x, y});
            int64_t distance = llabs(around.x - x) + llabs(around.y - y);
            if (!there || distance >= least)
                continue;
            least = distance;
            found = there;
            around = (struct cell){x, y};
        }
    if (found)
        return found - 1;
    array_reserve(&l->points, &l->point_room, (size_t)l->point_count + 1);
    l->points[l->point_count++] = (struct vec2){(double)c.x / GRID, (double)c.y / GRID};
    return (*slot = l->point_count) - 1;
}

void dxf_lines_add(struct dxf_lines *l, uint32_t a, uint32_t b)
{
    array_reserve(&l->lines, &l->line_room, (size_t)l->line_count + 1);
    l->lines[l->line_count++] = (struct dxf_line){{a, b}};
}
