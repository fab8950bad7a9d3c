// parameters.c - what the widgets of OpenSCAD's customizer are made from.
#include "customizer/parameters.h"

#include "base/locale.h"
#include "customizer/annotation.h"
#include "customizer/assignments.h"
#include "customizer/index.h"
#include "customizer/value.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// 1 for whole numbers, else one of the last decimal that any of them has.
static double step_of(const double *numbers, uint32_t count)
{
    double step = 1;
    for (uint32_t i = 0; i < count; i++) {
        struct words text = {0};
        words_number(&text, numbers[i], DIGITS_ALL);
        const char *point = strchr(text.data, '.'), *e = strchr(text.data, 'e');
        long decimals = point ? (long)strspn(point + 1, "0123456789") : 0;
        if (e)
            decimals -= strtol(e + 1, NULL, 10);
        if (decimals > 0)
            step = fmin(step, pow(10, -(double)decimals));
        free(text.data);
    }
    return step;
}

static void set_range(struct parameter *p, const struct literal *range)
{
    const struct literal *items = range->items;
    uint32_t last = range->count - 1;
    double begin = last ? items[0].number : 0, end = items[last].number;
    double step = last == 2 ? fabs(items[1].number) : 0;
    p->min = fmin(begin, end);
    p->max = fmax(begin, end);
    for (uint32_t i = 0; i < p->value.count; i++) {
        p->min = fmin(p->min, p->value.numbers[i]);
        p->max = fmax(p->max, p->value.numbers[i]);
    }
    if (step > 0)
        p->step = step;
    else
        p->step = fmin(p->step, step_of((const double[]){begin, end}, 2));
    p->ranged = p->min < p->max && isfinite(p->max - p->min);
}

static bool is_pair(const struct literal *item)
{
    return item->kind == LITERAL_VECTOR;
}

// Numbers as they would be typed.
static const char *plain_text(struct arena *arena, const struct literal *item)
{
    if (item->kind == LITERAL_STRING)
        return item->text;
    struct words text = {0};
    words_number(&text, item->number, DIGITS_ALL);
    const char *copy = arena_text(arena, text.data, text.size);
    free(text.data);
    return copy;
}

// False for what the parameter cannot be: a word for a number.
static bool make_choice(struct parameter_choice *out, const struct parameter *p,
                        const struct literal *item, struct arena *arena)
{
    const struct literal *value = is_pair(item) ? &item->items[0] : item;
    if (p->kind == PARAMETER_NUMBER && value->kind != LITERAL_NUMBER)
        return false;
    const char *text = plain_text(arena, value);
    *out = (struct parameter_choice){
        .text = text, .label = is_pair(item) ? plain_text(arena, &item->items[1]) : text};
    if (p->kind == PARAMETER_NUMBER)
        out->number = value->number;
    return true;
}

// A value of the source that is not among them comes first.
static void set_choices(struct parameter *p, const struct literal *list, struct arena *arena)
{
    struct parameter_choice *choices = arena_alloc(arena, (list->count + 1) * sizeof *choices);
    uint32_t count = 0;
    for (uint32_t i = 0; i < list->count; i++)
        count += make_choice(&choices[1 + count], p, &list->items[i], arena);
    if (count == 0)
        return;
    p->choices = choices + 1;
    p->choice_count = count;
    if (parameter_choice(p) < count)
        return;
    struct literal value = {LITERAL_STRING, .text = p->value.text};
    if (p->kind == PARAMETER_NUMBER)
        value = (struct literal){LITERAL_NUMBER, .number = p->value.numbers[0]};
    make_choice(&choices[0], p, &value, arena);
    choices[0].text = choices[0].label =
        arena_text(arena, choices[0].text, strlen(choices[0].text));
    p->choices = choices;
    p->choice_count++;
}

static void annotate(struct parameter *p, const struct literal *note, struct arena *arena)
{
    bool numeric = p->kind == PARAMETER_NUMBER || p->kind == PARAMETER_VECTOR;
    bool alone = note->kind == LITERAL_VECTOR && note->count == 1 &&
                 note->items[0].kind == LITERAL_NUMBER; // [100]
    const struct literal *number = alone ? note->items : note;
    if (numeric)
        p->step = step_of(p->value.numbers, p->value.count);
    if (numeric && (alone || note->kind == LITERAL_RANGE))
        set_range(p, note);
    else if (numeric && note->kind == LITERAL_NUMBER && note->number > 0)
        p->step = note->number;
    else if (p->kind == PARAMETER_STRING && number->kind == LITERAL_NUMBER) {
        if (number->number >= 1 && number->number < UINT32_MAX)
            p->length_most = (uint32_t)number->number;
    } else if ((p->kind == PARAMETER_NUMBER || p->kind == PARAMETER_STRING) &&
               note->kind == LITERAL_VECTOR)
        set_choices(p, note, arena);
}

static const char *trimmed(struct arena *arena, const char *text)
{
    text += strspn(text, " \t");
    size_t length = strlen(text);
    while (length && (text[length - 1] == ' ' || text[length - 1] == '\t'))
        length--;
    return arena_text(arena, text, length);
}

static void make_parameter(struct parameter *out, const struct assignment *a, struct arena *arena)
{
    *out = (struct parameter){
        .name = arena_text(arena, a->name, strlen(a->name)),
        .group = trimmed(arena, a->group ? a->group : ""),
        .description = trimmed(arena, a->description ? a->description : ""),
        .line = a->line,
        .kind = value_kind(&a->value),
        .step = 1,
    };
    if (!*out->group)
        out->group = "Parameters";
    out->hidden = strcmp(out->group, "Hidden") == 0;
    out->global = strcmp(out->group, "Global") == 0;
    value_from(&out->initial, out->kind, &a->value);
    value_from(&out->value, out->kind, &a->value);
    annotate(out, &a->annotation, arena);
}

void parameters_read(struct parameters *out, const char *text, size_t size)
{
    struct own_locale own = locale_enter();
    struct assignments all;
    assignments_read(&all, text, size);
    *out = (struct parameters){.items = mem_alloc((all.count + 1) * sizeof *out->items)};
    for (uint32_t i = 0; i < all.count; i++) {
        const struct assignment *a = &all.items[i];
        if (a->literal && a->line < all.end_line && a->value.kind != LITERAL_UNDEF)
            make_parameter(&out->items[out->count++], a, &all.arena);
    }
    out->arena = all.arena; // holds the texts of choices
    all.arena = (struct arena){0};
    assignments_free(&all);
    locale_leave(&own);
}

void parameters_free(struct parameters *p)
{
    for (uint32_t i = 0; i < p->count; i++) {
        free(p->items[i].initial.text);
        free(p->items[i].value.text);
    }
    free(p->items);
    arena_free(&p->arena);
    *p = (struct parameters){0};
}

struct parameter *parameters_find(const struct parameters *p, const char *name)
{
    for (uint32_t i = 0; i < p->count; i++)
        if (strcmp(p->items[i].name, name) == 0)
            return &p->items[i];
    return NULL;
}

bool parameter_is_changed(const struct parameter *p)
{
    return !value_equal(p->kind, &p->value, &p->initial);
}

void parameter_reset(struct parameter *p)
{
    value_copy(&p->value, &p->initial);
}

uint32_t parameter_choice(const struct parameter *p)
{
    uint32_t i = 0;
    for (; i < p->choice_count; i++)
        if (p->kind == PARAMETER_NUMBER ? p->choices[i].number == p->value.numbers[0]
                                        : strcmp(p->choices[i].text, p->value.text) == 0)
            break;
    return i;
}

void parameter_choose(struct parameter *p, uint32_t choice)
{
    if (p->kind == PARAMETER_NUMBER)
        p->value.numbers[0] = p->choices[choice].number;
    else
        parameter_set(p, p->choices[choice].text);
}

double parameter_snap(const struct parameter *p, double number)
{
    if (!p->ranged || isnan(number))
        return number;
    double range = (p->max - p->min) / p->step, last = floor(range + 1e-9);
    double steps = round((number - p->min) / p->step);
    if (steps <= 0)
        return p->min;
    if (steps < last)
        return p->min + steps * p->step;
    return fabs(last - range) < 1e-9 ? p->max : p->min + last * p->step;
}

void parameters_carry(struct parameters *now, const struct parameters *before)
{
    struct name_index names;
    index_make(&names, before);
    for (uint32_t i = 0; i < now->count; i++) {
        struct parameter *p = &now->items[i];
        uint32_t n = index_find(&names, p->name);
        if (n == before->count)
            continue;
        const struct parameter *old = &before->items[n];
        if (old->kind == p->kind && value_equal(p->kind, &p->initial, &old->initial))
            value_copy(&p->value, &old->value);
    }
    index_free(&names);
}
