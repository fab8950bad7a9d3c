// loader.h - follows the file and hands over the models made of it, on a thread of its own.
#pragma once
#include "app/report.h"
#include "customizer/parameters.h"
#include "edit/edit.h"
#include "model/model.h"

#include <stdatomic.h>

struct load_times { // clock_seconds
    double noticed; // the file event, or the start
    double started; // reading, after the event settled and openscad ended
    double parsed, built;
    double openscad; // how long it ran; 0: it was not needed
};

// One loaded model, shared by the threads that show it.
struct loaded {
    struct model model;
    struct box visible; // holds all that can show, closer than the model's bounds
    struct load_times times;
    uint32_t number;       // of the load, from 1
    struct source *source; // the file as it was read; held
    uint64_t version;      // edit_version of the edit that it shows, 0 for the file as it is
    atomic_uint references;
    struct loader *loader;
    struct loaded *next; // among those that nobody holds any more
};

struct loaded *loaded_hold(struct loaded *s);
void loaded_release(struct loaded *s); // NULL is fine

struct loader_options {
    const char *path;
    const char *openscad; // NULL: found by scad_start
    double epsilon;       // of struct model_options, as the next two
    const char *const *import_folders;
    uint32_t import_folder_count;
    bool watch;
    // Called from the loader's thread when there are news, and when the program was asked to end.
    void (*woken)(void *context);
    void *context;
};

enum load_phase { LOAD_NONE, LOAD_EXPORT, LOAD_BUILD };

struct loader_news {
    struct loaded *loaded; // newer than the last one taken, now held by the taker; or NULL
    struct report report;  // all there is to say about the file as it is now; owned by the taker
    // Of the .scad, with the values that hold, from before its export; new since the last one
    // taken, or NULL; to be freed with free after its content.
    struct parameters *parameters;
    bool failed;           // the report says why there is no newer model
    enum load_phase phase; // what goes on: openscad runs, or a model is made
    double since;          // clock_seconds
    bool ended;            // SIGINT or SIGTERM came
};

struct loader *loader_start(const struct loader_options *options, struct error *err);
// False when nothing is new since the last call.
bool loader_take(struct loader *l, struct loader_news *out);
void loader_reload(struct loader *l); // as if the file had been saved
// Shows an edit of the newest model's source, as soon as its model is made. Of edits that come
// faster than models some are left out, never the last. One of an older source is not shown any
// more: a newer file is on its way, or there.
void loader_edit(struct loader *l, const struct edit *e);
// The parameters have these values from now on. Exports that change nothing but values end before
// the next one begins, if they are short: a slider is followed.
void loader_define(struct loader *l, const struct parameters *p);
// Loads with another mode; MODEL_RENDER also makes openscad's $preview false.
void loader_set_mode(struct loader *l, enum model_mode mode);
void loader_cancel(struct loader *l); // gives up what goes on, until the file is saved again
// All models have to be released before.
void loader_stop(struct loader *l);
