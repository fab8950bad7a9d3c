// build.h - makes models on a thread of the event loop's pool, one at a time.
#pragma once
#include "app/loader.h"

struct uv_loop_s;

struct build_task {
    char *name;            // of the file, also that the text stands for; owned
    char *text;            // as file_read gives it, NULL: read the file; owned
    size_t size;           // of the text
    struct source *source; // of an edit: what the tree borrows from, held; else NULL
    struct csg_tree tree;  // of an edit: owned
    uint64_t version;      // edit_version of it
    enum model_mode mode;
    struct report report;     // of what was done before
    struct messages messages; // of the making
    struct load_times times;  // `noticed` as asked
    struct loaded *loaded;    // what came of it, with one reference; NULL after a failure
};
void build_task_free(struct build_task *t); // leaves {0}; not the model

void loaded_free(struct loaded *list); // whoever holds them

struct build;
// `done` is called from the loop; `loaded` and what it takes from the task's messages are its own.
struct build *build_new(struct uv_loop_s *loop, const struct loader_options *options,
                        void (*done)(void *context, struct build_task *task), void *context);
// Takes the task over, in place of one that was asked for before and is not done. The one under way
// is given up, unless it took such a place itself: with saves faster than builds some have to be
// shown.
void build_ask(struct build *b, struct build_task *task);
// Nothing asked for so far is wanted any more.
void build_cancel(struct build *b);
// Frees models that nobody holds, when no build uses their solids.
void build_retire(struct build *b, struct loaded *list);
// Models begun from now on take the place of this one. Only from `done`.
void build_replace(struct build *b, struct loaded *s);
// Everything is gone once the loop has run.
void build_delete(struct build *b);
