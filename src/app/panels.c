// panels.c - what stands around the picture and over it: where each panel is, and which are open.
#include "app/panels.h"

#include "app/gui.h"
#include "app/panel_console.h"
#include "app/panel_help.h"
#include "app/panel_status.h"

#include <math.h>

// The window without what is docked, in GLFW's units. The console comes and goes by itself: it lies
// over the picture, which does not jump.
static struct gui_box free_box(const struct panels *p)
{
    struct gui_box box = gui_window_size();
    if (p->open[PANEL_STATUS])
        box.height = fmaxf(box.height - gui_strip(), 1);
    if (p->open[PANEL_CUSTOMIZER])
        box.width -= fminf(22 * gui_em(), box.width / 2);
    return box;
}

struct view_area panels_area(const struct panels *p)
{
    struct gui_box box = free_box(p);
    float density = gui_density();
    return (struct view_area){(int)lroundf(box.x * density), (int)lroundf(box.y * density),
                              (int)lroundf(box.width * density),
                              (int)lroundf(box.height * density)};
}

bool panels_draw(struct panels *p, const struct panel_facts *facts, struct parameters *parameters)
{
    struct gui_box all = gui_window_size(), box = free_box(p);
    bool changed = false;
    if (p->open[PANEL_STATUS])
        panel_status_draw(facts, &(struct gui_box){0, box.height, all.width, gui_strip()});
    if (p->open[PANEL_CONSOLE])
        panel_console_draw(facts, &box, &p->open[PANEL_CONSOLE]);
    if (p->open[PANEL_HELP])
        panel_help_draw(&box, &p->open[PANEL_HELP]);
    if (p->open[PANEL_CUSTOMIZER])
        changed = panel_customizer_draw(
            &p->customizer, parameters, facts->path,
            &(struct gui_box){box.width, 0, all.width - box.width, box.height},
            &p->open[PANEL_CUSTOMIZER]);
    return changed;
}

void panels_take_report(struct panels *p, const struct panel_facts *facts)
{
    if (facts->failed && !p->open[PANEL_CONSOLE])
        p->open[PANEL_CONSOLE] = p->console_by_itself = true;
    if (!facts->failed && p->console_by_itself)
        p->open[PANEL_CONSOLE] = p->console_by_itself = false;
}
