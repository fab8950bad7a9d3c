// cluster.c - which face shows where surfaces touch.
#include "render/cpu/cluster.h"

#include "base/mem.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

size_t cluster_room_bytes(const struct cluster_room *room)
{
    return (room->rest_capacity + room->ordered_capacity) * sizeof *room->rest +
           room->border_capacity + room->kept_capacity + room->turn_capacity * sizeof *room->turns;
}

void cluster_room_free(struct cluster_room *room)
{
    free(room->rest);
    free(room->ordered);
    free(room->border);
    free(room->kept);
    free(room->turns);
    *room = (struct cluster_room){0};
}

static bool enters(crossing c)
{
    return !(c & 1);
}

// The leaf of a crossing, in the tile.
static struct tile_leaf *leaf_of(const struct cluster *c, crossing i)
{
    return &c->behind->t->leaves[(uint32_t)i >> 1];
}

// At one key the leaves stand as in the file.
static bool stands_before(const struct cluster *c, crossing a, crossing b)
{
    uint32_t first = leaf_of(c, a)->leaf, second = leaf_of(c, b)->leaf;
    if (crossing_key(a) != crossing_key(b))
        return a < b;
    return first != second ? first < second : enters(a) && !enters(b);
}

// The crossings up to the end of the cluster, those of one key in the order of the file: lists are
// in the order in which the tile has its leaves, which depends on the view.
static const crossing *order_ties(const struct cluster *c)
{
    struct cluster_room *room = c->room;
    uint32_t i = c->from + 1;
    while (i < c->to && !stands_before(c, c->items[i], c->items[i - 1]))
        i++;
    if (i == c->to)
        return c->items;
    array_reserve(&room->ordered, &room->ordered_capacity, c->to);
    memcpy(room->ordered, c->items, c->to * sizeof *room->ordered);
    for (; i < c->to; i++) {
        crossing one = room->ordered[i];
        uint32_t k = i;
        for (; k > c->from && stands_before(c, one, room->ordered[k - 1]); k--)
            room->ordered[k] = room->ordered[k - 1];
        room->ordered[k] = one;
    }
    return room->ordered;
}

// Begins `rest` with the crossings in front of the cluster.
static uint32_t begin_rest(const struct cluster *c)
{
    struct cluster_room *room = c->room;
    array_reserve(&room->rest, &room->rest_capacity, c->to);
    memcpy(room->rest, c->items, c->from * sizeof *room->rest);
    combination_forget_list(c->behind);
    return c->from;
}

// Would the state behind the cluster be solid with only those of its crossings that are `kept`?
static bool solid_with_kept(const struct cluster *c)
{
    const bool *kept = c->room->kept;
    uint32_t n = begin_rest(c);
    for (uint32_t i = c->from; i < c->to; i++) {
        if (kept[i - c->from])
            c->room->rest[n++] = c->items[i];
        else
            combination_step(c->behind, c->items[i], true);
    }
    bool solid = combination_is_solid(c->behind, c->room->rest, n);
    combination_forget_list(c->behind);
    for (uint32_t i = c->from; i < c->to; i++)
        if (!kept[i - c->from])
            combination_step(c->behind, c->items[i], false);
    return solid;
}

// Is the place solid when the border of every leaf belongs to it?
static bool solid_closed(const struct cluster *c)
{
    for (uint32_t i = c->from; i < c->to; i++)
        c->room->kept[i - c->from] = enters(c->items[i]);
    return solid_with_kept(c);
}

// Does the leaf of crossing i cross the other way as often? It is too thin to show there.
static bool is_paired(const struct cluster *c, uint32_t i)
{
    uint32_t same = 0, other = 0;
    for (uint32_t k = c->from; k < c->to; k++) {
        same += (uint32_t)c->items[k] == (uint32_t)c->items[i];
        other += ((uint32_t)c->items[k] ^ (uint32_t)c->items[i]) == 1;
    }
    return other >= same;
}

// Notes which crossings are no surfaces but the border of a region.
static void find_borders(const struct cluster *c)
{
    struct cluster_room *room = c->room;
    float steep;
    array_reserve(&room->border, &room->border_capacity, c->to - c->from);
    for (uint32_t i = c->from; i < c->to; i++)
        room->border[i - c->from] =
            tile_face(c->behind->t, leaf_of(c, c->items[i]), c->ray, !enters(c->items[i]),
                      crossing_key(c->items[i]), &steep) == FACE_REGION;
}

// Takes the crossings one by one and lists those that turn the state, which is `solid` behind all
// of them. Returns how many; 0 when the last of them leaves it otherwise, as borders of regions
// may.
static uint32_t find_turns(const struct cluster *c, bool solid)
{
    struct cluster_room *room = c->room;
    bool now = !solid;
    uint32_t n = begin_rest(c), turns = 0;
    array_reserve(&room->turns, &room->turn_capacity, c->to - c->from);
    for (uint32_t i = c->from; i < c->to; i++) {
        if (room->border[i - c->from] && enters(c->items[i]))
            room->rest[n++] = c->items[i];
        else
            combination_step(c->behind, c->items[i], true);
    }
    for (uint32_t i = c->from; i < c->to; i++) {
        if (room->border[i - c->from])
            continue;
        combination_step(c->behind, c->items[i], false);
        room->rest[n++] = c->items[i];
        if (combination_is_solid(c->behind, room->rest, n) != now) {
            now = !now;
            room->turns[turns++] = i;
        }
    }
    combination_forget_list(c->behind);
    for (uint32_t i = c->from; i < c->to; i++)
        if (room->border[i - c->from] && !enters(c->items[i]))
            combination_step(c->behind, c->items[i], false);
    return now == solid ? turns : 0;
}

// Would it be solid without the crossings `like` this one, or (alone) with no other ones? A leaf
// that only crosses the border of its region is inside on both sides in truth.
static bool solid_if(const struct cluster *c, uint32_t one, uint32_t like, bool alone)
{
    for (uint32_t i = c->from; i < c->to; i++) {
        bool is = !(((uint32_t)c->items[i] ^ (uint32_t)c->items[one]) & like);
        c->room->kept[i - c->from] =
            c->room->border[i - c->from] ? enters(c->items[i]) : is == alone;
    }
    return solid_with_kept(c);
}

// Does crossing i matter: would the state be another one without its leaf, or is it the same with
// that alone? Of a leaf that is too thin to show only one side is meant.
static bool matters(const struct cluster *c, uint32_t i, bool solid)
{
    uint32_t like = is_paired(c, i) ? UINT32_MAX : UINT32_MAX - 1;
    return solid_if(c, i, like, false) != solid || solid_if(c, i, like, true) == solid;
}

// The crossing that makes the state `solid`: taken one by one they may turn it several times, for
// there are thin intervals between. The thinnest go first, since some are only where two leaves
// touch. One that does not matter gives way to one that does: in which order crossings at one place
// come says nothing. c->to when none turns it.
static uint32_t turning_point(const struct cluster *c, bool solid)
{
    uint32_t count = find_turns(c, solid), all = count;
    uint32_t *turn = c->room->turns;
    while (count > 1) {
        uint32_t least = 0;
        float gap = FLT_MAX;
        for (uint32_t k = 0; k + 1 < count; k++) {
            float d = crossing_key(c->items[turn[k + 1]]) - crossing_key(c->items[turn[k]]);
            if (d <= gap) {
                gap = d;
                least = k;
            }
        }
        count -= 2;
        memmove(turn + least, turn + least + 2, (count - least) * sizeof *turn);
    }
    if (!count)
        return c->to;
    uint32_t found = turn[0];
    if (all == 1 || matters(c, found, solid))
        return found;
    find_turns(c, solid);
    for (uint32_t k = 0; k < all; k += 2)
        if (matters(c, turn[k], solid))
            return turn[k];
    return found;
}

static struct face_at face_of(const struct cluster *c, crossing i)
{
    return (struct face_at){leaf_of(c, i), !enters(i), crossing_key(i)};
}

// Whether crossing i shows rather than crossing `best`, where the place wants leaves of the given
// kind; 2 for any.
static bool goes_before(const struct cluster *c, crossing i, crossing best, int cut)
{
    const struct leaf *leaves = c->behind->t->frame->body->leaves;
    uint32_t a = leaf_of(c, i)->leaf, b = leaf_of(c, best)->leaf;
    bool wanted = leaves[a].subtracted == cut, has = leaves[b].subtracted == cut;
    return cut == 2 || wanted == has ? a > b : wanted;
}

static bool in_one_plane(const struct cluster *c, crossing a, crossing b)
{
    return crossing_key(a) == crossing_key(b) ||
           tile_coplanar(c->behind->t, c->ray, face_of(c, a), face_of(c, b));
}

// May crossing i show in place of the one that turns the state?
static bool competes(const struct cluster *c, uint32_t i, crossing turn)
{
    return !c->room->border[i - c->from] && !is_paired(c, i) && in_one_plane(c, c->items[i], turn);
}

// Of the crossings that compete, the next one in the file; c->to: `last` was the last one.
static uint32_t next_in_file(const struct cluster *c, uint32_t last, crossing turn)
{
    uint32_t next = c->to;
    for (uint32_t i = c->from; i < c->to; i++) {
        uint32_t leaf = leaf_of(c, c->items[i])->leaf;
        uint32_t after = last == c->to ? 0 : leaf_of(c, c->items[last])->leaf;
        bool behind = last == c->to || leaf > after || (leaf == after && i > last);
        if (behind && (next == c->to || leaf < leaf_of(c, c->items[next])->leaf) &&
            competes(c, i, turn))
            next = i;
    }
    return next;
}

// Where several crossings in one plane turn the state together, so that none of them matters: they
// are left out in the order of the file as long as the state stays as it is. What must remain owns
// the place as if it mattered.
static crossing owner_together(const struct cluster *c, crossing turn, bool solid, int cut)
{
    bool *kept = c->room->kept, found = false;
    crossing best = turn;
    for (uint32_t i = c->from; i < c->to; i++)
        kept[i - c->from] = !c->room->border[i - c->from] || enters(c->items[i]);
    for (uint32_t i = c->to; (i = next_in_file(c, i, turn)) != c->to;) {
        kept[i - c->from] = false;
        if (solid_with_kept(c) == solid)
            continue;
        kept[i - c->from] = true;
        if (!found || goes_before(c, c->items[i], best, cut))
            best = c->items[i];
        found = true;
    }
    return best;
}

// Of those in one plane with the one that turns the state, it is the latest of the file that
// matters, because the state would be another one without it, or with it alone. A leaf too thin to
// show and one that does not matter give way to any of these. Of geometry it is a cut face where
// the place is not solid with all borders.
static crossing owner_of(const struct cluster *c, bool solid)
{
    find_borders(c);
    array_reserve(&c->room->kept, &c->room->kept_capacity, c->to - c->from);
    uint32_t turning = turning_point(c, solid);
    if (turning == c->to)
        return c->items[c->from];
    crossing turn = c->items[turning], best = turn;
    bool weak = is_paired(c, turning) || !matters(c, turning, solid);
    int cut = c->behind->t->frame->body->borders ? !solid_closed(c) : 2;
    for (uint32_t i = c->from; i < c->to; i++) {
        crossing one = c->items[i];
        if (i == turning || (!weak && !goes_before(c, one, best, cut)) || !competes(c, i, turn) ||
            !matters(c, i, solid))
            continue;
        best = one;
        weak = false;
    }
    return weak ? owner_together(c, turn, solid, cut) : best;
}

crossing cluster_owner(const struct cluster *c, bool solid)
{
    if (c->to - c->from == 1)
        return c->items[c->from];
    struct cluster ordered = *c;
    ordered.items = order_ties(c);
    return owner_of(&ordered, solid);
}
