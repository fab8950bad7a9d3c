// viewer_state.h - what the window knows, for viewer.c and commands.c alone.
#pragma once
#include "app/drawing.h"
#include "app/gui.h"
#include "app/input.h"
#include "app/loader.h"
#include "app/pace.h"
#include "app/panels.h"
#include "app/viewer.h"
#include "app/window.h"

#include <string.h>

struct viewer {
    const struct viewer_options *options;
    struct window *window;
    struct input input;
    struct loader *loader;
    struct drawing *drawing;
    struct loaded *loaded; // the newest
    struct shot shown;
    bool framed;               // the camera stands
    bool drawn;                // a shot of the newest job was shown
    int divisor;               // of the newest job
    double refine_at;          // when a coarse job may be followed by a full one
    double drawing_since;      // of the newest job, until its shot comes or it is given up; 0: none
    double shown_at, interval; // of the newest shot, and from shot to shot while something moves
    double ticked;             // when it was told how long something lasts
    struct pace pace;
    uint32_t reported; // number of the last load whose way was printed
    struct report report;
    char note[1100]; // what the newest command has to say, "" for nothing
    bool failed, ended, save;
    enum load_phase phase;
    double phase_since;
    struct panels panels;
    struct parameters parameters; // of the file, as the panel has them
    const struct scheme *scheme;
    struct drawing_view view;
    enum model_mode mode;
};

static inline const char *viewer_file_name(const struct viewer *v)
{
    const char *slash = strrchr(v->options->path, '/');
    return slash ? slash + 1 : v->options->path;
}

static inline void viewer_repaint(struct viewer *v)
{
    v->input.repaints = GUI_SETTLES;
}

// Asks for a picture of what there is now; `refined`: as fine as the window, however long it takes.
void viewer_ask(struct viewer *v, bool refined);

void commands_obey(struct viewer *v); // all that input has
void commands_save_picture(struct viewer *v);
