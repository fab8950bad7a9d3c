// heights_text.c - grids of heights from lines of numbers.
#include "base/mem.h"
#include "io/heights.h"
#include "io/scan.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Sums of four heights stay finite, and nothing real is that high.
static const double highest = 1e300;

// The rows as they come, one after another.
struct rows {
    double *values;
    uint32_t *ends; // of each row, among the values
    uint32_t count, room, value_count, value_room;
};

// One line; false when reading ends at a word that is no number.
static bool read_row(struct scan *s, struct rows *r)
{
    double z;
    while (scan_in_line(s)) {
        if (!scan_number(s, &z) || !(fabs(z) <= highest))
            return false;
        array_reserve(&r->values, &r->value_room, (size_t)r->value_count + 1);
        r->values[r->value_count++] = z;
        if (r->value_count > HEIGHTS_MOST)
            return true; // refused by the caller
    }
    return true;
}

static void end_row(struct rows *r)
{
    array_reserve(&r->ends, &r->room, (size_t)r->count + 1);
    r->ends[r->count++] = r->value_count;
}

static bool read_rows(struct scan *s, struct rows *r, struct messages *messages, struct error *err)
{
    for (bool legal = true; legal && scan_to_word(s); scan_skip_line(s)) {
        if (*s->at == '#')
            continue;
        uint32_t before = r->value_count;
        legal = read_row(s, r);
        if (!legal)
            messages_add(messages, MESSAGE_WARNING, (struct place){s->path, s->line, 0},
                         "expected a number; the rest of the file is left out");
        if (r->value_count > before)
            end_row(r);
        if (!heights_allowed(s->path, 1, r->value_count, err))
            return false;
    }
    return true;
}

static uint32_t longest(const struct rows *r)
{
    uint32_t most = 0, begin = 0;
    for (uint32_t i = 0; i < r->count; begin = r->ends[i++])
        if (r->ends[i] - begin > most)
            most = r->ends[i] - begin;
    return most;
}

static void fill(const struct rows *r, struct heights *h)
{
    h->z = mem_zalloc((size_t)h->rows * h->columns * sizeof *h->z);
    h->lowest = INFINITY;
    uint32_t begin = 0;
    for (uint32_t i = 0; i < h->rows; begin = r->ends[i++])
        memcpy(h->z + (size_t)i * h->columns, r->values + begin,
               (r->ends[i] - begin) * sizeof *h->z);
    for (uint32_t i = 0; i < r->value_count; i++)
        h->lowest = fmin(h->lowest, r->values[i]);
}

bool heights_from_text(const char *path, const char *data, size_t size, struct heights *out,
                       struct messages *messages, struct error *err)
{
    struct rows r = {0};
    struct scan s;
    scan_open(&s, path, data, size);
    bool ok = read_rows(&s, &r, messages, err) && heights_allowed(path, r.count, longest(&r), err);
    scan_close(&s);
    if (ok) {
        *out = (struct heights){.rows = r.count, .columns = longest(&r)};
        fill(&r, out);
    }
    free(r.values);
    free(r.ends);
    return ok;
}
