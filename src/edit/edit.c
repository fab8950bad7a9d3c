// edit.c - changes to the numbers and operations of a file, on top of its text.
#include "csg/locate.h"
#include "edit/change.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct edit *edit_new(struct source *s)
{
    struct edit *e = mem_zalloc(sizeof *e);
    e->source = source_hold(s);
    return e;
}

void edit_delete(struct edit *e)
{
    if (!e)
        return;
    source_release(e->source);
    free(e->changes);
    free(e->steps);
    free(e->marks);
    free(e);
}

struct source *edit_source(const struct edit *e)
{
    return e->source;
}

bool edit_is_changed(const struct edit *e)
{
    return e->change_count > 0;
}

uint64_t edit_version(const struct edit *e)
{
    return e->version;
}

// ---------------------------------------------------------------- changes

static int compare_places(struct change_place a, struct change_place b)
{
    if (a.node != b.node)
        return a.node < b.node ? -1 : 1;
    if (a.argument != b.argument)
        return a.argument < b.argument ? -1 : 1;
    return a.scalar < b.scalar ? -1 : a.scalar > b.scalar;
}

// The first change at a place or behind it.
static uint32_t find(const struct edit *e, struct change_place place)
{
    uint32_t low = 0, high = e->change_count;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (compare_places(e->changes[middle].place, place) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static bool is_at(const struct edit *e, uint32_t i, struct change_place place)
{
    return i < e->change_count && compare_places(e->changes[i].place, place) == 0;
}

static bool equal(const struct csg_value *a, const struct csg_value *b)
{
    if (a->kind != b->kind)
        return false;
    if (a->kind == CSG_NUMBER) // not by ==: -0 is written otherwise than 0
        return memcmp(&a->number, &b->number, sizeof a->number) == 0;
    return a->kind == CSG_BOOL ? a->boolean == b->boolean : strcmp(a->string, b->string) == 0;
}

// What the file says.
static bool original(const struct edit *e, struct change_place p, struct csg_value *out)
{
    const struct csg_node *n = p.node < e->source->node_count ? e->source->nodes[p.node] : NULL;
    if (n && p.argument == CHANGE_NAME) {
        *out = (struct csg_value){.kind = CSG_STRING, .string = n->name};
        return true;
    }
    if (!n || p.argument >= n->argument_count)
        return false;
    struct csg_value hold;
    const struct csg_value *v = csg_scalar(&n->arguments[p.argument].value, p.scalar, &hold);
    if (v)
        *out = *v;
    return v != NULL;
}

static bool present(const struct edit *e, struct change_place p, struct csg_value *out)
{
    uint32_t i = find(e, p);
    if (!is_at(e, i, p))
        return original(e, p, out);
    *out = e->changes[i].value;
    return true;
}

static void put(struct edit *e, struct change_place place, struct csg_value value)
{
    uint32_t i = find(e, place);
    struct csg_value file;
    bool there = is_at(e, i, place), wanted = original(e, place, &file) && !equal(&file, &value);
    struct change *at = e->changes + i;
    e->version++;
    if (there && !wanted) {
        e->change_count--;
        memmove(at, at + 1, (e->change_count - i) * sizeof *at);
    } else if (!there && wanted) {
        array_reserve(&e->changes, &e->change_room, (size_t)e->change_count + 1);
        at = e->changes + i;
        memmove(at + 1, at, (e->change_count - i) * sizeof *at);
        e->change_count++;
    }
    if (wanted)
        *at = (struct change){place, value};
}

// ---------------------------------------------------------------- steps

static void set(struct edit *e, struct change_place place, struct csg_value before,
                struct csg_value after)
{
    if (equal(&before, &after))
        return;
    struct step *last = e->done ? &e->steps[e->done - 1] : NULL;
    put(e, place, after);
    if (last && e->open && compare_places(last->place, place) == 0) {
        last->after = after;
    } else {
        array_reserve(&e->steps, &e->step_room, (size_t)e->done + 1);
        e->steps[e->done++] = (struct step){place, before, after};
    }
    e->step_count = e->done;
    e->open = true;
}

void edit_end_step(struct edit *e)
{
    e->open = false;
}

bool edit_undo(struct edit *e)
{
    if (!e->done)
        return false;
    const struct step *s = &e->steps[--e->done];
    put(e, s->place, s->before);
    e->open = false;
    return true;
}

bool edit_redo(struct edit *e)
{
    if (e->done == e->step_count)
        return false;
    const struct step *s = &e->steps[e->done++];
    put(e, s->place, s->after);
    e->open = false;
    return true;
}

// ---------------------------------------------------------------- what callers change

bool edit_scalar(const struct edit *e, uint32_t node, uint32_t argument, uint32_t scalar,
                 struct csg_value *out)
{
    return argument != CHANGE_NAME &&
           present(e, (struct change_place){node, argument, scalar}, out);
}

static bool set_scalar(struct edit *e, struct change_place place, struct csg_value value,
                       const char *kind, struct error *err)
{
    struct csg_value before;
    bool there = place.argument != CHANGE_NAME && present(e, place, &before);
    if (there && before.kind == value.kind) {
        set(e, place, before, value);
        return true;
    }
    error_set(err, "there is no %s to be changed", kind);
    return false;
}

bool edit_set_number(struct edit *e, uint32_t node, uint32_t argument, uint32_t scalar,
                     double number, struct error *err)
{
    struct csg_value value = {.kind = CSG_NUMBER, .number = number};
    if (isfinite(number))
        return set_scalar(e, (struct change_place){node, argument, scalar}, value, "number", err);
    error_set(err, "a number has to be finite");
    return false;
}

bool edit_set_boolean(struct edit *e, uint32_t node, uint32_t argument, uint32_t scalar,
                      bool boolean, struct error *err)
{
    struct csg_value value = {.kind = CSG_BOOL, .boolean = boolean};
    return set_scalar(e, (struct change_place){node, argument, scalar}, value, "boolean", err);
}

const char *const *edit_operations(void)
{
    static const char *const names[] = {"union", "difference", "intersection", "hull", "minkowski",
                                        "group", NULL};
    return names;
}

static const char *operation(const char *name)
{
    const char *const *names = edit_operations();
    while (*names && strcmp(*names, name) != 0)
        names++;
    return *names;
}

bool edit_is_operation(const char *name)
{
    return operation(name) != NULL;
}

const char *edit_name(const struct edit *e, uint32_t node)
{
    struct csg_value v;
    return present(e, (struct change_place){node, CHANGE_NAME, 0}, &v) ? v.string : NULL;
}

bool edit_set_operation(struct edit *e, uint32_t node, const char *name, struct error *err)
{
    const char *before = edit_name(e, node), *after = operation(name);
    if (!before || !operation(before)) {
        error_set(err, "this is no operation");
        return false;
    }
    if (!after) {
        error_set(err, "'%.40s' is no operation", name);
        return false;
    }
    set(e, (struct change_place){node, CHANGE_NAME, 0},
        (struct csg_value){.kind = CSG_STRING, .string = before},
        (struct csg_value){.kind = CSG_STRING, .string = after});
    return true;
}

// ---------------------------------------------------------------- marks

static uint32_t find_mark(const struct edit *e, uint32_t node)
{
    uint32_t i = 0;
    while (i < e->mark_count && e->marks[i].node < node)
        i++;
    return i;
}

uint8_t edit_marks(const struct edit *e, uint32_t node)
{
    uint32_t i = find_mark(e, node);
    return i < e->mark_count && e->marks[i].node == node ? e->marks[i].modifiers
                                                         : e->source->nodes[node]->modifiers;
}

void edit_mark(struct edit *e, uint32_t node, uint8_t modifiers)
{
    uint32_t i = find_mark(e, node);
    bool there = i < e->mark_count && e->marks[i].node == node;
    for (uint32_t k = 0; k < e->mark_count && (modifiers & CSG_ROOT); k++)
        e->marks[k].modifiers &= (uint8_t)~CSG_ROOT;
    e->version++;
    if (!there) {
        array_reserve(&e->marks, &e->mark_room, (size_t)e->mark_count + 1);
        memmove(e->marks + i + 1, e->marks + i, (e->mark_count - i) * sizeof *e->marks);
        e->mark_count++;
    }
    e->marks[i] = (struct mark){node, modifiers};
}

void edit_unmark_all(struct edit *e)
{
    e->version += e->mark_count > 0;
    e->mark_count = 0;
}
