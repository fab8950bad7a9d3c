// openscad.c - the openscad program as a child process that exports a .scad file as .csg text.
#include "scad/openscad.h"

#include "base/file.h"
#include "base/mem.h"
#include "scad/answer.h"
#include "scad/frames.h"

#include <signal.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <uv.h>

#define TEXT_LIMIT ((size_t)1 << 32)

struct scad_job {
    uv_process_t process;
    uv_pipe_t messages;
    char *path, *program, *folder, *text_path, *rule_path;
    uint32_t frames;
    scad_done *done; // NULL once cancelled
    void *context;
    struct scad_log log;
    struct error failure; // why the child never ran
    int open_handles;
    int64_t status;
    int signal;
    char block[1 << 14];
};

void scad_result_free(struct scad_result *r)
{
    for (uint32_t i = 0; i < r->file_count; i++)
        free(r->files[i]);
    free(r->files);
    scad_frames_free(&r->frames);
    free(r->text);
    free(r->name);
    free(r->log);
    *r = (struct scad_result){0};
}

// As openscad names it. The caller frees it.
static char *frame_path(const struct scad_job *job, uint32_t frame)
{
    char name[32];
    snprintf(name, sizeof name, "export%05u.csg", frame);
    return file_join(job->folder, name);
}

static void job_delete(struct scad_job *job)
{
    if (job->folder) {
        for (uint32_t i = 0; i < job->frames; i++) {
            char *path = frame_path(job, i);
            unlink(path);
            free(path);
        }
        unlink(job->text_path);
        unlink(job->rule_path);
        rmdir(job->folder);
    }
    free(job->path);
    free(job->program);
    free(job->folder);
    free(job->text_path);
    free(job->rule_path);
    free(job->log.text);
    free(job);
}

static bool is_blank(const char *text, size_t size)
{
    for (size_t i = 0; i < size; i++)
        if (!strchr(" \t\r\n", text[i]))
            return false;
    return true;
}

// "dir/part.scad (exported)": lines in messages count in the export, imports are sought in dir.
static char *result_name(const char *path)
{
    size_t size = strlen(path) + sizeof " (exported)";
    char *name = mem_alloc(size);
    snprintf(name, size, "%s (exported)", path);
    return name;
}

// openscad ends with 0 and an empty tree after a failed assertion; an empty tree without an error
// is an empty design.
static bool take_text(struct scad_job *job, const char *path, const struct scad_result *said,
                      struct scad_text *out, struct error *err)
{
    if (!file_read(path, TEXT_LIMIT, &out->text, &out->size, NULL)) {
        error_set(err, "%s: %s ended well but wrote no file", job->path, job->program);
        return false;
    }
    if (is_blank(out->text, out->size) && scad_log_has_error(said->log)) {
        scad_error(said, err);
        free(out->text);
        return false;
    }
    return true;
}

static bool take_frame(struct scad_job *job, struct scad_result *out, struct error *err)
{
    uint32_t number = out->frames.count;
    char *path = frame_path(job, number);
    struct scad_text text = {0};
    bool ok = take_text(job, path, out, &text, err);
    if (!ok) {
        struct error why = *err;
        error_set(err, "%s (frame %05u)", why.text, number);
    } else {
        ok = scad_frames_add(&out->frames, &text, err);
        free(text.text);
    }
    unlink(path);
    free(path);
    return ok;
}

static bool take_frames(struct scad_job *job, struct scad_result *out, struct error *err)
{
    bool ok = scad_frames_begin(&out->frames, job->folder, err);
    while (ok && out->frames.count < job->frames)
        ok = take_frame(job, out, err);
    if (!ok)
        scad_frames_free(&out->frames);
    return ok;
}

static bool take_result(struct scad_job *job, struct scad_result *out, struct error *err)
{
    out->name = result_name(job->path);
    out->log = job->log.text ? job->log.text : mem_strdup("");
    job->log.text = NULL;
    scad_read_files(job->rule_path, job->path, out);
    if (job->failure.text[0]) {
        *err = job->failure;
        return false;
    }
    if (job->signal) {
        error_set(err, "%s: %s was ended by signal %d (%s)", job->path, job->program, job->signal,
                  strsignal(job->signal));
        return false;
    }
    if (job->status != 0) {
        scad_error(out, err);
        return false;
    }
    if (job->frames)
        return take_frames(job, out, err);
    struct scad_text text;
    if (!take_text(job, job->text_path, out, &text, err))
        return false;
    out->text = text.text;
    out->size = text.size;
    return true;
}

static void on_closed(uv_handle_t *handle)
{
    struct scad_job *job = handle->data;
    if (--job->open_handles)
        return;
    if (job->done) {
        struct scad_result result = {0};
        struct error err = {{0}};
        bool ok = take_result(job, &result, &err);
        job->done(job->context, &result, ok ? NULL : &err);
    }
    job_delete(job);
}

static void on_block(uv_handle_t *handle, size_t suggested, uv_buf_t *buffer)
{
    (void)suggested;
    struct scad_job *job = handle->data;
    *buffer = uv_buf_init(job->block, sizeof job->block);
}

static void on_read(uv_stream_t *stream, ssize_t count, const uv_buf_t *buffer)
{
    struct scad_job *job = stream->data;
    if (count > 0)
        scad_log_add(&job->log, buffer->base, (size_t)count);
    else if (count < 0 && !uv_is_closing((uv_handle_t *)stream))
        uv_close((uv_handle_t *)stream, on_closed);
}

static void on_child_exit(uv_process_t *process, int64_t status, int signal_number)
{
    struct scad_job *job = process->data;
    job->status = status;
    job->signal = signal_number;
    kill(-process->pid, SIGKILL); // what it left running would keep the pipe of messages open
    uv_close((uv_handle_t *)process, on_closed);
}

static bool make_folder(struct scad_job *job, struct error *err)
{
    const char *temporary = getenv("TMPDIR");
    char *folder = file_join(temporary && *temporary ? temporary : "/tmp", "hcsg-XXXXXX");
    if (!mkdtemp(folder)) {
        error_set(err, "%s: cannot make a temporary folder", folder);
        free(folder);
        return false;
    }
    job->folder = folder;
    job->text_path = file_join(folder, "export.csg");
    job->rule_path = file_join(folder, "export.d");
    return true;
}

// In a session of its own, so that a wrapper script dies with all that it started.
static int spawn(struct scad_job *job, uv_loop_t *loop, const struct scad_options *o)
{
    char *const export[] = {job->program, "-o", job->text_path, "-d", job->rule_path};
    size_t count = array_count(export);
    char frames[16];
    char **arguments = mem_zalloc((count + o->argument_count + 4) * sizeof *arguments);
    memcpy(arguments, export, sizeof export);
    if (o->frames) {
        snprintf(frames, sizeof frames, "%u", o->frames);
        arguments[count++] = "--animate";
        arguments[count++] = frames;
    }
    for (uint32_t i = 0; i < o->argument_count; i++)
        arguments[count++] = (char *)(uintptr_t)o->arguments[i]; // only read, as execvp does
    arguments[count] = job->path;
    uv_stdio_container_t stdio[3] = {
        {.flags = UV_IGNORE},
        {.flags = UV_IGNORE},
        {.flags = UV_CREATE_PIPE | UV_WRITABLE_PIPE, .data.stream = (uv_stream_t *)&job->messages},
    };
    uv_process_options_t options = {.exit_cb = on_child_exit,
                                    .file = job->program,
                                    .args = arguments,
                                    .flags = UV_PROCESS_DETACHED,
                                    .stdio_count = 3,
                                    .stdio = stdio};
    int failed = uv_spawn(loop, &job->process, &options);
    free(arguments);
    return failed;
}

struct scad_job *scad_start(struct uv_loop_s *loop, const char *path,
                            const struct scad_options *options, scad_done *done, void *context)
{
    struct scad_job *job = mem_zalloc(sizeof *job);
    const char *program = options->program;
    if (!program)
        program = getenv("OPENSCAD");
    job->program = mem_strdup(program && *program ? program : "openscad");
    job->path = path[0] == '-' ? mem_alloc(strlen(path) + 3) : mem_strdup(path);
    if (path[0] == '-')
        sprintf(job->path, "./%s", path);
    job->frames = options->frames;
    job->done = done;
    job->context = context;
    job->process.data = job->messages.data = job;
    uv_pipe_init(loop, &job->messages, 0);
    job->open_handles = 1;
    if (make_folder(job, &job->failure)) {
        int failed = spawn(job, loop, options);
        job->open_handles = 2; // also a process that never ran is a handle to close
        if (failed) {
            error_set(&job->failure,
                      "%s: %s; .scad files need openscad: install it, or say where it is with "
                      "--openscad or $OPENSCAD",
                      job->program, uv_strerror(failed));
            uv_close((uv_handle_t *)&job->process, on_closed);
        }
    }
    if (job->failure.text[0])
        uv_close((uv_handle_t *)&job->messages, on_closed);
    else
        uv_read_start((uv_stream_t *)&job->messages, on_block, on_read);
    return job;
}

void scad_cancel(struct scad_job *job)
{
    job->done = NULL;
    if (!uv_is_closing((uv_handle_t *)&job->process) && job->process.pid > 0)
        kill(-job->process.pid, SIGKILL);
    if (!uv_is_closing((uv_handle_t *)&job->messages))
        uv_close((uv_handle_t *)&job->messages, on_closed);
}

enum { SIGNALS = 3 };

struct waiting {
    struct scad_result *out;
    struct error *err;
    bool ok;
    struct scad_job *job; // NULL once it is done or cancelled
    uv_signal_t signals[SIGNALS];
    int signal; // that came
};

static void stop_waiting(struct waiting *w)
{
    w->job = NULL;
    for (int i = 0; i < SIGNALS; i++)
        uv_close((uv_handle_t *)&w->signals[i], NULL);
}

static void on_done(void *context, struct scad_result *result, const struct error *err)
{
    struct waiting *w = context;
    *w->out = *result;
    w->ok = !err;
    if (err && w->err)
        *w->err = *err;
    stop_waiting(w);
}

static void on_signal(uv_signal_t *handle, int number)
{
    struct waiting *w = handle->data;
    if (!w->job)
        return;
    w->signal = number;
    scad_cancel(w->job);
    stop_waiting(w);
}

// The child is in a session of its own: what is typed at the terminal does not reach it.
static void listen_to_signals(struct waiting *w, uv_loop_t *loop)
{
    static const int numbers[SIGNALS] = {SIGINT, SIGTERM, SIGHUP};
    for (int i = 0; i < SIGNALS; i++) {
        struct sigaction action;
        w->signals[i].data = w;
        uv_signal_init(loop, &w->signals[i]);
        if (sigaction(numbers[i], NULL, &action) == 0 && action.sa_handler != SIG_IGN)
            uv_signal_start(&w->signals[i], on_signal, numbers[i]);
    }
}

bool scad_export(const char *path, const struct scad_options *options, struct scad_result *out,
                 struct error *err)
{
    uv_loop_t loop;
    struct waiting w = {.out = out, .err = err};
    if (uv_loop_init(&loop) != 0) {
        error_set(err, "%s: cannot start openscad: no event loop", path);
        return false;
    }
    listen_to_signals(&w, &loop);
    w.job = scad_start(&loop, path, options, on_done, &w);
    uv_run(&loop, UV_RUN_DEFAULT);
    uv_loop_close(&loop);
    if (w.signal) {
        raise(w.signal);
        error_set(err, "%s: ended by signal %d (%s)", path, w.signal, strsignal(w.signal));
    }
    return w.ok;
}
