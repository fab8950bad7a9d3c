// panel_sets.c - the file of parameter sets beside the .scad: choose one, save, delete.
#include "app/panel_sets.h"

#include "app/gui.h"
#include "base/file.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

void panel_sets_free(struct panel_sets *s)
{
    parameter_sets_free(&s->sets);
    free(s->path);
    *s = (struct panel_sets){0};
}

// Others write the file, too.
static void refresh(struct panel_sets *s, const char *scad)
{
    if (!s->path)
        s->path = parameter_sets_path(scad);
    uint64_t stamp = file_stamp(s->path);
    if (stamp == s->stamp)
        return;
    s->stamp = stamp;
    parameter_sets_free(&s->sets);
    if (access(s->path, F_OK) == 0)
        parameter_sets_read(&s->sets, s->path, &s->odd);
}

static bool draw_choice(struct panel_sets *s, struct parameters *p)
{
    bool changed = false;
    gui_fill_width(0);
    if (!gui_choices_begin("##sets",
                           s->sets.count ? "choose a parameter set" : "no parameter sets"))
        return false;
    for (uint32_t i = 0; i < s->sets.count; i++) {
        gui_scope_begin(i);
        if (gui_choice(s->sets.names[i], false)) {
            snprintf(s->name, sizeof s->name, "%s", s->sets.names[i]);
            changed = parameter_sets_apply(&s->sets, s->sets.names[i], p);
        }
        gui_scope_end();
    }
    gui_choices_end();
    return changed;
}

bool panel_sets_draw(struct panel_sets *s, struct parameters *p, const char *scad)
{
    refresh(s, scad);
    bool changed = draw_choice(s, p);
    gui_fill_width(9 * gui_em());
    gui_input("##name", "name of a set", s->name, sizeof s->name);
    gui_beside(0);
    bool saves = gui_button("save") && *s->name;
    gui_beside(0);
    bool deletes = gui_button("delete") && parameter_sets_has(&s->sets, s->name);
    if (saves || deletes)
        *s->odd.text = 0;
    if (saves)
        parameter_set_save(s->path, s->name, p, &s->odd);
    if (deletes)
        parameter_set_delete(s->path, s->name, &s->odd);
    if (*s->odd.text)
        gui_wrapped(GUI_ERROR, s->odd.text);
    return changed;
}
