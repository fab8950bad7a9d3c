// panel_help.c - the cheat sheet: the table of keys.
#include "app/panel_help.h"

#include "app/keys.h"

#include <math.h>
#include <stdint.h>

// The next heading after a row.
static uint32_t next_group(uint32_t row)
{
    do
        row++;
    while (row < key_row_count && !key_rows[row].group);
    return row;
}

static void draw_rows(uint32_t from, uint32_t to)
{
    float indent = 0;
    for (uint32_t i = from; i < to; i++)
        indent = fmaxf(indent, gui_text_width(key_rows[i].keys) + 2 * gui_em());
    for (uint32_t i = from; i < to; i++) {
        if (key_rows[i].group) {
            if (i > from)
                gui_gap();
            gui_text(GUI_DIM, key_rows[i].group);
        }
        gui_text(GUI_KEY, key_rows[i].keys);
        gui_beside(indent);
        gui_text(GUI_PLAIN, key_rows[i].what);
    }
}

void panel_help_draw(const struct gui_box *box, bool *open)
{
    uint32_t half = 0;
    while (half < key_row_count / 2)
        half = next_group(half);
    if (gui_window("Mouse and keys", GUI_FLOAT, box, open)) {
        gui_group_begin();
        draw_rows(0, half);
        gui_group_end();
        gui_beside(0);
        gui_text(GUI_PLAIN, "    ");
        gui_beside(0);
        gui_group_begin();
        draw_rows(half, key_row_count);
        gui_group_end();
    }
    gui_window_end();
}
