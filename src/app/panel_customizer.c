// panel_customizer.c - the parameters of the .scad, to be changed.
#include "app/panel_customizer.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TEXT_ROOM = 4096 };

static bool draw_choices(struct parameter *p)
{
    uint32_t chosen = parameter_choice(p);
    bool changed = false;
    if (!gui_choices_begin("##choice",
                           chosen < p->choice_count ? p->choices[chosen].label : "(none of these)"))
        return false;
    for (uint32_t i = 0; i < p->choice_count; i++) {
        gui_scope_begin(i);
        if (gui_choice(p->choices[i].label, i == chosen)) {
            parameter_choose(p, i);
            changed = true;
        }
        gui_scope_end();
    }
    gui_choices_end();
    return changed;
}

static bool draw_numbers(struct parameter *p)
{
    bool changed = false;
    for (uint32_t i = 0; i < p->value.count; i++) {
        double number = p->value.numbers[i];
        gui_scope_begin(i);
        gui_fill_width(0);
        if (p->ranged
                ? gui_slider("##number", &number, p->min, p->max)
                : gui_number("##number", &number, p->kind == PARAMETER_NUMBER ? p->step : 0)) {
            number = parameter_snap(p, number);
            changed |= number != p->value.numbers[i];
            p->value.numbers[i] = number;
        }
        gui_scope_end();
    }
    return changed;
}

static size_t count_characters(const char *utf8)
{
    size_t count = 0;
    for (; *utf8; utf8++)
        count += (*utf8 & 0xc0) != 0x80;
    return count;
}

static bool draw_text(struct parameter *p)
{
    char *now = parameter_text(p), edited[TEXT_ROOM];
    bool fits = strlen(now) < sizeof edited, changed = false;
    if (fits) {
        strcpy(edited, now);
        gui_fill_width(0);
        if (gui_input("##text", "", edited, sizeof edited) &&
            (!p->length_most || count_characters(edited) <= p->length_most))
            changed = parameter_set(p, edited);
    } else {
        gui_text(GUI_DIM, "(too long to be changed here)");
    }
    free(now);
    return changed;
}

static bool draw_value(struct parameter *p)
{
    if (p->kind == PARAMETER_BOOL)
        return gui_check("##check", &p->value.boolean);
    if (p->choice_count) {
        gui_fill_width(0);
        return draw_choices(p);
    }
    if (p->kind == PARAMETER_NUMBER || p->kind == PARAMETER_VECTOR)
        return draw_numbers(p);
    return draw_text(p);
}

// The name, a button for the source's value where it is another, the description, the value.
static bool draw_parameter(struct parameter *p)
{
    bool changed = false;
    gui_gap();
    gui_text(parameter_is_changed(p) ? GUI_KEY : GUI_PLAIN, p->name);
    if (parameter_is_changed(p)) {
        gui_beside(0);
        if (gui_small_button("reset")) {
            parameter_reset(p);
            changed = true;
        }
    }
    if (*p->description)
        gui_wrapped(GUI_DIM, p->description);
    return draw_value(p) || changed;
}

static bool is_wanted(const struct parameter *p, const char *search)
{
    return !p->hidden && (!*search || strcasestr(p->name, search) ||
                          strcasestr(p->description, search) || strcasestr(p->group, search));
}

// Whether an earlier one of these opened the group.
static bool is_known(const struct parameters *p, uint32_t number, const char *search)
{
    for (uint32_t i = 0; i < number; i++)
        if (is_wanted(&p->items[i], search) &&
            strcmp(p->items[i].group, p->items[number].group) == 0)
            return true;
    return false;
}

static bool draw_group(struct parameters *p, uint32_t first, const char *search)
{
    const char *group = p->items[first].group;
    bool changed = false;
    if (!gui_section(group))
        return false;
    for (uint32_t i = first; i < p->count; i++)
        if (is_wanted(&p->items[i], search) && strcmp(p->items[i].group, group) == 0) {
            gui_scope_begin(i);
            changed |= draw_parameter(&p->items[i]);
            gui_scope_end();
        }
    return changed;
}

static void copy(char *text)
{
    gui_copy(text);
    free(text);
}

static bool draw_head(struct panel_customizer *c, struct parameters *p, const char *path)
{
    bool changed = false;
    if (gui_button("reset all"))
        for (uint32_t i = 0; i < p->count; i++) {
            changed |= parameter_is_changed(&p->items[i]);
            parameter_reset(&p->items[i]);
        }
    gui_beside(0);
    if (gui_button("copy -D"))
        copy(parameters_flags(p));
    gui_hint("what is changed, as options for openscad");
    gui_beside(0);
    if (gui_button("copy source"))
        copy(parameters_source_lines(p));
    gui_hint("what is changed, as lines for the .scad");
    if (p->count)
        changed |= panel_sets_draw(&c->sets, p, path);
    gui_fill_width(0);
    gui_input("##search", "search", c->search, sizeof c->search);
    return changed;
}

bool panel_customizer_draw(struct panel_customizer *c, struct parameters *p, const char *path,
                           const struct gui_box *box, bool *open)
{
    bool changed = false, any = false;
    if (gui_window("Customizer", GUI_DOCK, box, open)) {
        changed = draw_head(c, p, path);
        for (uint32_t i = 0; i < p->count; i++)
            if (is_wanted(&p->items[i], c->search) && !is_known(p, i, c->search)) {
                any = true;
                changed |= draw_group(p, i, c->search);
            }
        if (!any)
            gui_wrapped(GUI_DIM, *c->search ? "none is found" : "the file has no parameters");
    }
    gui_window_end();
    return changed;
}
