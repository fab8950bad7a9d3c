// build.c - makes models on a thread of the event loop's pool, one at a time.
#include "app/build.h"

#include "base/clock.h"
#include "base/file.h"
#include "base/mem.h"
#include "csg/csg.h"

#include <stdlib.h>
#include <uv.h>

#define TEXT_LIMIT ((size_t)1 << 32)

struct build {
    struct uv_loop_s *loop;
    double epsilon;
    const char *const *import_folders;
    uint32_t import_folder_count;
    void (*done)(void *context, struct build_task *task);
    void *context;
    uv_work_t work;
    struct solid_store *store;  // the worker's while there is one
    struct build_task now;      // the worker's
    struct build_task next;     // without a name: none
    struct loaded *retired;     // not freed yet
    struct loaded *before;      // whose place the next model takes; held
    atomic_bool cancelled;      // `now` is
    bool busy, replaced, ended; // replaced: `now` took the place of another
};

void build_task_free(struct build_task *t)
{
    free(t->name);
    free(t->text);
    csg_free(&t->tree);
    source_release(t->source);
    report_free(&t->report);
    messages_free(&t->messages);
    *t = (struct build_task){0};
}

void loaded_free(struct loaded *s)
{
    for (struct loaded *next; s; s = next) {
        next = s->next;
        model_free(&s->model);
        source_release(s->source);
        free(s);
    }
}

// OpenSCAD's bounds also count what intersections cut away.
static struct box visible_box(const struct model *m)
{
    struct box visible = BOX_EMPTY;
    for (uint32_t i = 0; i < m->body_count; i++) {
        const struct body *b = &m->bodies[i];
        for (uint32_t l = 0; l < b->leaf_count; l++) {
            struct box box = box_intersection(b->leaves[l].box, b->roi[l]);
            if (!b->leaves[l].subtracted && !box_is_empty(box))
                visible = box_union(visible, box);
        }
    }
    return visible;
}

static void make(struct build *b, struct source *source, const struct csg_tree *tree)
{
    struct loaded *s = mem_zalloc(sizeof *s);
    struct model_options options = MODEL_DEFAULTS;
    options.mode = b->now.mode;
    options.epsilon = b->epsilon;
    options.import_folders = b->import_folders;
    options.import_folder_count = b->import_folder_count;
    options.cancelled = &b->cancelled;
    bool alike = b->before && b->before->model.mode == options.mode;
    options.before = alike ? &b->before->model : NULL;
    model_build(&s->model, tree, b->store, &options, &b->now.messages);
    if (atomic_load(&b->cancelled)) {
        loaded_free(s);
        return;
    }
    s->source = source_hold(source);
    s->version = b->now.version;
    s->visible = visible_box(&s->model);
    atomic_init(&s->references, 1);
    b->now.loaded = s;
    b->now.times.built = clock_seconds();
}

static struct source *read_source(struct build_task *t)
{
    struct error err;
    if (!t->text && !file_read(t->name, TEXT_LIMIT, &t->text, &t->size, &err)) {
        messages_add(&t->messages, MESSAGE_ERROR, (struct place){0}, "%s", err.text);
        return NULL;
    }
    char *text = t->text;
    t->text = NULL;
    return source_new(t->name, text, t->size, &t->messages);
}

static void on_work(uv_work_t *work)
{
    struct build *b = work->data;
    struct build_task *t = &b->now;
    t->times.started = clock_seconds();
    if (t->source) {
        t->times.parsed = t->times.started;
        make(b, t->source, &t->tree);
        return;
    }
    struct source *source = read_source(t);
    t->times.parsed = clock_seconds();
    if (source && !atomic_load(&b->cancelled))
        make(b, source, &source->tree);
    source_release(source);
}

static void end(struct build *b)
{
    if (b->before && atomic_fetch_sub(&b->before->references, 1) == 1)
        loaded_free(b->before); // there is no loader any more that could free it
    solid_store_delete(b->store);
    free(b);
}

static void begin(struct build *b);

static void on_worked(uv_work_t *work, int status)
{
    (void)status;
    struct build *b = work->data;
    struct build_task task = b->now;
    bool cancelled = atomic_load(&b->cancelled);
    b->now = (struct build_task){0};
    b->busy = false;
    loaded_free(b->retired);
    b->retired = NULL;
    if (cancelled) {
        loaded_free(task.loaded);
    } else {
        b->replaced = false;
        b->done(b->context, &task);
    }
    build_task_free(&task);
    if (b->ended) {
        end(b);
    } else if (!b->busy && b->next.name) {
        begin(b);
    }
}

static void begin(struct build *b)
{
    b->now = b->next;
    b->next = (struct build_task){0};
    b->busy = true;
    atomic_store(&b->cancelled, false);
    uv_queue_work(b->loop, &b->work, on_work, on_worked);
}

struct build *build_new(struct uv_loop_s *loop, const struct loader_options *options,
                        void (*done)(void *context, struct build_task *task), void *context)
{
    struct build *b = mem_zalloc(sizeof *b);
    b->loop = loop;
    b->epsilon = options->epsilon;
    b->import_folders = options->import_folders;
    b->import_folder_count = options->import_folder_count;
    b->done = done;
    b->context = context;
    b->work.data = b;
    b->store = solid_store_new();
    return b;
}

void build_ask(struct build *b, struct build_task *task)
{
    build_task_free(&b->next);
    b->next = *task;
    *task = (struct build_task){0};
    if (!b->busy) {
        b->replaced = false;
        begin(b);
    } else if (!b->replaced) {
        b->replaced = true; // what comes now
        atomic_store(&b->cancelled, true);
    }
}

void build_cancel(struct build *b)
{
    build_task_free(&b->next);
    if (b->busy)
        atomic_store(&b->cancelled, true);
}

void build_retire(struct build *b, struct loaded *list)
{
    if (!b->busy) {
        loaded_free(list);
        return;
    }
    while (list) {
        struct loaded *next = list->next;
        list->next = b->retired;
        b->retired = list;
        list = next;
    }
}

void build_replace(struct build *b, struct loaded *s)
{
    struct loaded *before = b->before;
    b->before = loaded_hold(s);
    loaded_release(before);
}

void build_delete(struct build *b)
{
    build_cancel(b);
    b->ended = true;
    if (!b->busy)
        end(b);
}
