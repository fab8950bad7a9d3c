// panel_status.c - the status line: what goes on, and what the last load and frame took.
#include "app/panel_status.h"

#include <stdio.h>
#include <string.h>

// A time in three digits; "" for none.
static void put_time(char *text, size_t size, const char *name, double seconds)
{
    *text = 0;
    if (seconds >= 10)
        snprintf(text, size, "%s %.0f s", name, seconds);
    else if (seconds >= 1)
        snprintf(text, size, "%s %.2f s", name, seconds);
    else if (seconds > 0)
        snprintf(text, size, "%s %.*f ms", name, seconds < 0.01 ? 1 : 0, 1e3 * seconds);
}

static void put_numbers(char *text, size_t size, const struct panel_facts *f)
{
    char parts[5][64];
    put_time(parts[0], sizeof parts[0], "openscad", f->openscad);
    put_time(parts[1], sizeof parts[1], "load", f->load);
    put_time(parts[2], sizeof parts[2], "frame", f->frame);
    if (f->divisor > 1)
        snprintf(parts[2] + strlen(parts[2]), sizeof parts[2] - strlen(parts[2]), " (1/%d)",
                 f->divisor);
    *parts[3] = *parts[4] = 0;
    if (f->rate > 0)
        snprintf(parts[3], sizeof parts[3], "%.0f fps", f->rate);
    if (f->divisor)
        snprintf(parts[4], sizeof parts[4], "%llu combination%s",
                 (unsigned long long)f->combinations, f->combinations == 1 ? "" : "s");
    size_t used = 0;
    *text = 0;
    for (int i = 0; i < 5; i++)
        if (*parts[i])
            used += (size_t)snprintf(text + used, size - used, "%s%s", used ? "   " : "", parts[i]);
}

static enum gui_tone put_state(char *text, size_t size, const struct panel_facts *f)
{
    const struct report_line *error = report_first(f->report, REPORT_ERROR);
    uint32_t warnings = f->report->kinds[REPORT_WARNING];
    if (f->doing) {
        snprintf(text, size, "%s  %.1f s   (Escape gives up)", f->doing, f->doing_for);
        return GUI_PLAIN;
    }
    if (*f->note) {
        snprintf(text, size, "%s", f->note);
        return GUI_PLAIN;
    }
    if (f->failed && error) {
        snprintf(text, size, "%s", error->text);
        return GUI_ERROR;
    }
    *text = 0;
    if (error || warnings)
        snprintf(text, size, "%u warning%s   (m shows messages)",
                 warnings + f->report->kinds[REPORT_ERROR], warnings == 1 ? "" : "s");
    return GUI_WARNING;
}

void panel_status_draw(const struct panel_facts *facts, const struct gui_box *box)
{
    char state[1200], numbers[400];
    enum gui_tone tone = put_state(state, sizeof state, facts);
    put_numbers(numbers, sizeof numbers, facts);
    if (gui_window("status", GUI_STRIP, box, NULL)) {
        float place = box->width - gui_text_width(numbers) - gui_em() / 2;
        // The numbers give way to what is told.
        if (*state)
            gui_text(tone, state);
        if (!*state || gui_text_width(state) + 2 * gui_em() < place) {
            gui_beside(place);
            gui_text(GUI_DIM, numbers);
        }
    }
    gui_window_end();
}
