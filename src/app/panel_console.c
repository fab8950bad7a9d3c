// panel_console.c - what openscad and the loading of the model have said.
#include "app/panel_console.h"

#include <math.h>
#include <stdio.h>

// A click copies the place, for the editor; of a line without one all of it.
static void draw_line(const struct report_line *line)
{
    static const enum gui_tone tones[] = {[REPORT_ECHO] = GUI_PLAIN,
                                          [REPORT_TRACE] = GUI_DIM,
                                          [REPORT_WARNING] = GUI_WARNING,
                                          [REPORT_ERROR] = GUI_ERROR};
    char place[1200];
    int length = line->place_length ? (int)line->place_length : -1;
    if (gui_row(tones[line->kind], line->text)) {
        snprintf(place, sizeof place, "%.*s", length, line->text);
        gui_copy(place);
    }
    if (line->place_length) {
        snprintf(place, sizeof place, "click to copy %.*s", length, line->text);
        gui_hint(place);
    }
}

void panel_console_draw(const struct panel_facts *facts, const struct gui_box *box, bool *open)
{
    const struct report *r = facts->report;
    // As high as its lines, but a third of the picture at most.
    float rows = (float)(r->count < 4 ? 4 : r->count);
    float height = fminf((rows + 2.2f) * 1.3f * gui_em(), fmaxf(box->height / 3, 8 * gui_em()));
    height = fminf(height, box->height);
    const struct gui_box place = {box->x, box->y + box->height - height, box->width, height};
    char title[200];
    snprintf(title, sizeof title, "Messages   %u error%s, %u warning%s###console",
             r->kinds[REPORT_ERROR], r->kinds[REPORT_ERROR] == 1 ? "" : "s",
             r->kinds[REPORT_WARNING], r->kinds[REPORT_WARNING] == 1 ? "" : "s");
    if (gui_window(title, GUI_DOCK, &place, open)) {
        // What stopped it first.
        for (int errors = 1; errors >= 0; errors--)
            for (uint32_t i = 0; i < r->count; i++)
                if ((r->lines[i].kind == REPORT_ERROR) == errors) {
                    gui_scope_begin(i);
                    draw_line(&r->lines[i]);
                    gui_scope_end();
                }
        if (!r->count)
            gui_text(GUI_DIM, "nothing was said");
        for (int k = 0; k < REPORT_KINDS; k++)
            if (r->kinds[k] > REPORT_KEPT) {
                char more[64];
                snprintf(more, sizeof more, "... and %u more", r->kinds[k] - REPORT_KEPT);
                gui_text(GUI_DIM, more);
            }
    }
    gui_window_end();
}
