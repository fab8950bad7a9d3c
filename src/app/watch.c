// watch.c - tells when files were saved, in whatever way an editor does it.
#include "app/watch.h"

#include "base/clock.h"
#include "base/file.h"
#include "base/mem.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <uv.h>

// One write gives several events within microseconds. A file written in pieces is left alone while
// the pieces follow each other closely, but not for ever.
enum { QUIET_MS = 3, TURN_MS = 1, SETTLE_MOST_MS = 250, LOOK_MS = 1000 };

struct stamp { // all zero: no such file
    uint64_t device, inode, size;
    int64_t seconds, nanoseconds;
};

struct target {
    char *path;
    uint32_t folder;
    struct stamp stamp;
};

struct folder {
    uv_fs_event_t handle;
    char *path;
    struct stamp stamp; // of the folder that the handle looks at
    struct watch *watch;
};

struct watch {
    struct uv_loop_s *loop;
    void (*saved)(void *context, double noticed);
    void *context;
    struct target *targets;
    uint32_t target_count, target_capacity;
    struct folder **folders;
    uint32_t folder_count, folder_capacity;
    char **paths; // as watch_set got them
    uint32_t path_count;
    uv_timer_t settle, look;
    double noticed; // 0: nothing pending
    int open_timers;
};

static struct stamp stamp_of(const char *path)
{
    struct stat st;
    if (stat(path, &st) != 0)
        return (struct stamp){0};
    return (struct stamp){st.st_dev, st.st_ino, (uint64_t)st.st_size, st.st_mtim.tv_sec,
                          st.st_mtim.tv_nsec};
}

static bool same_stamp(const struct stamp *a, const struct stamp *b)
{
    return a->device == b->device && a->inode == b->inode && a->size == b->size &&
           a->seconds == b->seconds && a->nanoseconds == b->nanoseconds;
}

static bool same_folder(const struct stamp *a, const struct stamp *b)
{
    return a->device == b->device && a->inode == b->inode;
}

static void on_settled(uv_timer_t *timer)
{
    struct watch *w = timer->data;
    double noticed = w->noticed;
    w->noticed = 0;
    for (uint32_t i = 0; i < w->target_count; i++)
        w->targets[i].stamp = stamp_of(w->targets[i].path);
    w->saved(w->context, noticed);
}

// A loop that is late calls timers before it reads events: those that came meanwhile are still to
// be heard of, and begin the wait anew.
static void on_quiet(uv_timer_t *timer)
{
    uv_timer_start(timer, on_settled, TURN_MS, 0);
}

static void notice(struct watch *w)
{
    double now = clock_seconds();
    if (w->noticed == 0)
        w->noticed = now;
    uv_update_time(w->loop);
    if (now - w->noticed < SETTLE_MOST_MS * 1e-3)
        uv_timer_start(&w->settle, on_quiet, QUIET_MS, 0);
    else
        uv_timer_start(&w->settle, on_settled, 0, 0);
}

static const char *base_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

static void on_event(uv_fs_event_t *handle, const char *name, int events, int status)
{
    (void)events;
    struct folder *f = handle->data;
    struct watch *w = f->watch;
    if (status < 0)
        return;
    for (uint32_t i = 0; i < w->target_count; i++)
        if (w->folders[w->targets[i].folder] == f &&
            (!name || strcmp(name, base_name(w->targets[i].path)) == 0)) {
            notice(w);
            return;
        }
}

static void arm(struct folder *f)
{
    uv_fs_event_stop(&f->handle);
    f->stamp = stamp_of(f->path);
    if (uv_fs_event_start(&f->handle, on_event, f->path, 0) != 0)
        f->stamp = (struct stamp){0}; // tried again at the next look
}

static void on_look(uv_timer_t *timer)
{
    struct watch *w = timer->data;
    for (uint32_t i = 0; i < w->folder_count; i++) {
        struct stamp now = stamp_of(w->folders[i]->path);
        if (!same_folder(&now, &w->folders[i]->stamp))
            arm(w->folders[i]);
    }
    for (uint32_t i = 0; i < w->target_count && w->noticed == 0; i++) {
        struct stamp now = stamp_of(w->targets[i].path);
        if (!same_stamp(&now, &w->targets[i].stamp))
            notice(w);
    }
}

struct watch *watch_new(struct uv_loop_s *loop, void (*saved)(void *context, double noticed),
                        void *context)
{
    struct watch *w = mem_zalloc(sizeof *w);
    w->loop = loop;
    w->saved = saved;
    w->context = context;
    w->settle.data = w->look.data = w;
    w->open_timers = 2;
    uv_timer_init(loop, &w->settle);
    uv_timer_init(loop, &w->look);
    uv_timer_start(&w->look, on_look, LOOK_MS, LOOK_MS);
    return w;
}

static void on_folder_closed(uv_handle_t *handle)
{
    struct folder *f = handle->data;
    free(f->path);
    free(f);
}

static void close_folder(struct folder *f)
{
    f->watch = NULL;
    uv_close((uv_handle_t *)&f->handle, on_folder_closed);
}

// The folder at this path among those kept from before or made now; takes the path over.
static uint32_t find_folder(struct watch *w, struct folder **old, uint32_t old_count, char *path)
{
    for (uint32_t i = 0; i < w->folder_count; i++)
        if (strcmp(w->folders[i]->path, path) == 0) {
            free(path);
            return i;
        }
    struct folder *f = NULL;
    for (uint32_t i = 0; i < old_count && !f; i++)
        if (old[i] && strcmp(old[i]->path, path) == 0) {
            f = old[i];
            old[i] = NULL;
            free(path);
        }
    if (!f) {
        f = mem_zalloc(sizeof *f);
        f->path = path;
        f->watch = w;
        f->handle.data = f;
        uv_fs_event_init(w->loop, &f->handle);
        arm(f);
    }
    array_reserve(&w->folders, &w->folder_capacity, w->folder_count + 1);
    w->folders[w->folder_count] = f;
    return w->folder_count++;
}

// File systems tell the time in steps of a few milliseconds.
static bool changed_since(const char *path, double since)
{
    static const double step = 0.02;
    struct stat st;
    struct timespec now;
    if (stat(path, &st) != 0 || clock_gettime(CLOCK_REALTIME, &now) != 0)
        return false;
    double age = (double)(now.tv_sec - st.st_ctim.tv_sec) +
                 1e-9 * (double)(now.tv_nsec - st.st_ctim.tv_nsec);
    return age < clock_seconds() - since + step;
}

// What was watched before the new files are.
struct former {
    struct folder **folders;
    struct target *targets;
    uint32_t folder_count, target_count;
    double since;
};

static void add_target(struct watch *w, struct former *old, const char *path)
{
    array_reserve(&w->targets, &w->target_capacity, (size_t)w->target_count + 1);
    uint32_t folder = find_folder(w, old->folders, old->folder_count, file_folder(path));
    struct target t = {mem_strdup(path), folder, stamp_of(path)};
    uint32_t i = 0;
    while (i < old->target_count && strcmp(old->targets[i].path, path) != 0)
        i++;
    if (i < old->target_count)
        t.stamp = old->targets[i].stamp;
    else if (changed_since(path, old->since))
        notice(w);
    w->targets[w->target_count++] = t;
}

static void free_targets(struct target *targets, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        free(targets[i].path);
    free(targets);
}

static void forget_paths(struct watch *w)
{
    for (uint32_t i = 0; i < w->path_count; i++)
        free(w->paths[i]);
    free(w->paths);
    w->paths = NULL;
    w->path_count = 0;
}

static bool same_paths(const struct watch *w, char *const *paths, uint32_t count)
{
    if (count != w->path_count)
        return false;
    for (uint32_t i = 0; i < count; i++)
        if (strcmp(paths[i], w->paths[i]) != 0)
            return false;
    return true;
}

void watch_set(struct watch *w, char *const *paths, uint32_t count, double since)
{
    if (same_paths(w, paths, count))
        return;
    struct former old = {w->folders, w->targets, w->folder_count, w->target_count, since};
    forget_paths(w);
    w->folders = NULL;
    w->targets = NULL;
    w->folder_count = w->folder_capacity = w->target_count = w->target_capacity = 0;
    w->paths = mem_alloc(count * sizeof *w->paths + 1);
    w->path_count = count;
    for (uint32_t i = 0; i < count; i++) {
        w->paths[i] = mem_strdup(paths[i]);
        add_target(w, &old, paths[i]);
        char *real = realpath(paths[i], NULL); // a link: the file behind it changes elsewhere
        struct stat st;
        if (real && lstat(paths[i], &st) == 0 && S_ISLNK(st.st_mode))
            add_target(w, &old, real);
        free(real);
    }
    for (uint32_t i = 0; i < old.folder_count; i++)
        if (old.folders[i])
            close_folder(old.folders[i]);
    free(old.folders);
    free_targets(old.targets, old.target_count);
}

static void on_timer_closed(uv_handle_t *handle)
{
    struct watch *w = handle->data;
    if (--w->open_timers == 0)
        free(w);
}

void watch_delete(struct watch *w)
{
    if (!w)
        return;
    for (uint32_t i = 0; i < w->folder_count; i++)
        close_folder(w->folders[i]);
    forget_paths(w);
    free_targets(w->targets, w->target_count);
    free(w->folders);
    uv_close((uv_handle_t *)&w->settle, on_timer_closed);
    uv_close((uv_handle_t *)&w->look, on_timer_closed);
}
