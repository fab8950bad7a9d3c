// dxf_join.c - lines of a drawing joined to closed paths.
#include "base/mem.h"
#include "io/dxf_lines.h"

#include <stdlib.h>
#include <string.h>

// Which lines meet at a point: meeting[first[p]] to meeting[first[p + 1]], as they are drawn.
struct joints {
    const struct dxf_line *lines;
    uint32_t *first, *meeting;
    uint32_t *next; // of each point, the first of its lines that may be unused
    uint32_t *left; // of each point, how many ends of unused lines are there
    bool *used;     // of each line
};

static void joints_make(struct joints *j, const struct dxf_lines *l)
{
    size_t points = l->point_count, lines = l->line_count;
    j->lines = l->lines;
    j->first = mem_zalloc((points + 1) * sizeof *j->first);
    j->meeting = mem_alloc(lines * 2 * sizeof *j->meeting);
    j->next = mem_alloc(points * sizeof *j->next);
    j->left = mem_alloc(points * sizeof *j->left);
    j->used = mem_zalloc(lines);

    for (uint32_t i = 0; i < lines; i++)
        for (int k = 0; k < 2; k++)
            j->first[l->lines[i].end[k] + 1]++;
    memcpy(j->left, j->first + 1, points * sizeof *j->left);
    for (uint32_t p = 0; p < points; p++)
        j->first[p + 1] += j->first[p];
    memcpy(j->next, j->first, points * sizeof *j->next);
    for (uint32_t i = 0; i < lines; i++)
        for (int k = 0; k < 2; k++)
            j->meeting[j->next[l->lines[i].end[k]]++] = i;
    memcpy(j->next, j->first, points * sizeof *j->next);
}

static void joints_free(struct joints *j)
{
    free(j->first);
    free(j->meeting);
    free(j->next);
    free(j->left);
    free(j->used);
}

// The end of an unused line where no other one is, or -1.
static int free_end(const struct joints *j, uint32_t line)
{
    const uint32_t *end = j->lines[line].end;
    uint32_t own = end[0] == end[1] ? 2 : 1;
    return j->left[end[0]] == own ? 0 : j->left[end[1]] == own ? 1 : -1;
}

static void use(struct joints *j, uint32_t line)
{
    j->used[line] = true;
    j->left[j->lines[line].end[0]]--;
    j->left[j->lines[line].end[1]]--;
}

// From one end of a line over everything that follows it. Gives the last point, not yet added.
static uint32_t follow(struct joints *j, const struct vec2 *points, uint32_t line, int end,
                       struct outline *out)
{
    uint32_t at = j->lines[line].end[!end];
    outline_add(out, points[j->lines[line].end[end]]);
    use(j, line);
    while (j->left[at]) {
        while (j->used[j->meeting[j->next[at]]])
            j->next[at]++;
        outline_add(out, points[at]);
        line = j->meeting[j->next[at]];
        const uint32_t *ends = j->lines[line].end;
        at = ends[0] == at ? ends[1] : ends[0];
        use(j, line);
    }
    return at;
}

void dxf_lines_join(const struct dxf_lines *l, struct outline *out)
{
    struct joints j;
    joints_make(&j, l);
    for (uint32_t i = 0; i < l->line_count; i++) {
        int end = j.used[i] ? -1 : free_end(&j, i);
        if (end < 0)
            continue;
        outline_add(out, l->points[follow(&j, l->points, i, end, out)]);
        outline_close(out);
    }
    // The last point of a loop is the first one again. At odd junctions it is another one, and
    // OpenSCAD leaves it out all the same.
    for (uint32_t i = 0; i < l->line_count; i++) {
        if (j.used[i])
            continue;
        follow(&j, l->points, i, 0, out);
        outline_close(out);
    }
    joints_free(&j);
}
