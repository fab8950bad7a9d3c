// panels.h - what stands around the picture and over it: where each panel is, and which are open.
#pragma once
#include "app/panel_customizer.h"
#include "app/report.h"
#include "app/window.h"

#include <stdint.h>

enum panel { PANEL_STATUS, PANEL_CONSOLE, PANEL_HELP, PANEL_CUSTOMIZER, PANELS };

// What there is to tell, gathered by the viewer for one frame; all borrowed.
struct panel_facts {
    const char *doing; // what goes on for so long that it is told, or NULL
    double doing_for;  // seconds
    const char *path;  // of the file
    const char *note;  // what the newest command has to say, or ""
    const struct report *report;
    bool failed;                  // the report says why the picture is an old one
    double openscad, load, frame; // seconds they took; 0: nothing to tell
    double rate;                  // frames per second while something moves; 0: not known
    int divisor;                  // of the picture, 0 without one
    uint64_t combinations;
};

struct panels {
    bool open[PANELS];
    struct panel_customizer customizer;
    bool console_by_itself; // an error has opened it: what mends the error closes it
};

// Where the picture stands beside what is open.
struct view_area panels_area(const struct panels *p);
// Between gui_begin and gui_end. May close panels, and change values of parameters: then true.
bool panels_draw(struct panels *p, const struct panel_facts *facts, struct parameters *parameters);
// After a load.
void panels_take_report(struct panels *p, const struct panel_facts *facts);
