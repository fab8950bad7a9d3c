// opponent.c - OpenCSG on the same scene, in a child; and whole processes against openscad.
#include "opponent.h"

#include "base/mem.h"
#include "child.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { PROCESS_RUNS = 5 };
#define LOAD_ALLOWANCE 20 // seconds that a child may take beside its frames
#define PROCESS_LIMIT  60

// A command line under construction; texts are borrowed.
struct command {
    const char *words[40];
    uint32_t count;
};

static void command_add(struct command *c, const char *word)
{
    if (c->count + 1 < array_count(c->words))
        c->words[c->count++] = word;
}

// Programs that draw with OpenGL get a display where there is none.
static struct command command_with_display(void)
{
    struct command c = {0};
    if (!getenv("DISPLAY")) {
        command_add(&c, "xvfb-run");
        command_add(&c, "-a");
    }
    return c;
}

// Takes "key value" lines apart.
static void read_output(struct result *r, struct opencsg_result *to, char *text)
{
    bool first = true;
    double warm_up = 0;
    for (char *line = strtok(text, "\n"); line; line = strtok(NULL, "\n")) {
        double ms;
        if (sscanf(line, "frame %lf", &ms) == 1) {
            if (first)
                warm_up = ms;
            else
                samples_add(&to->frames, ms);
            first = false;
        }
        (void)!sscanf(line, "renderer %127[^\n]", r->renderer);
        (void)!sscanf(line, "products %u", &r->products);
        (void)!sscanf(line, "literals %u", &r->literals);
    }
    if (!first && !to->frames.count)
        samples_add(&to->frames, warm_up);
}

bool opponent_measure_setting(struct result *r, int setting, const char *csg,
                              const struct opponent_options *o, struct error *err)
{
    const struct setting *s = &opencsg_settings[setting];
    char size[16], limit[32], threads[16], picture[4096];
    // Mesa's software rasterizer takes as many threads as there are processors unless it is told.
    snprintf(threads, sizeof threads, "%u", o->threads);
    setenv("LP_NUM_THREADS", threads, 1);
    snprintf(size, sizeof size, "%u", o->size);
    snprintf(limit, sizeof limit, "%g", o->limit);
    struct command c = command_with_display();
    command_add(&c, o->program);
    command_add(&c, "--algorithm");
    command_add(&c, s->algorithm);
    command_add(&c, "--size");
    command_add(&c, size);
    command_add(&c, "--limit");
    command_add(&c, limit);
    if (s->boxes)
        command_add(&c, "--boxes");
    if (o->pictures && setting == 0) {
        snprintf(picture, sizeof picture, "%s/%s-opencsg.png", o->pictures, r->scene->name);
        command_add(&c, "--picture");
        command_add(&c, picture);
    }
    command_add(&c, csg);
    struct child child;
    if (!child_run(&child, c.words, 2 * o->limit + LOAD_ALLOWANCE, true, err))
        return false;
    struct opencsg_result *to = &r->opencsg[setting];
    bool ok = child.late || child.status == 0;
    if (ok) {
        read_output(r, to, child.output);
        to->late = child.late && !to->frames.count;
    } else {
        error_set(err, "%s: failed on %s", o->program, csg);
    }
    child_free(&child);
    return ok;
}

bool opponent_measure(struct result *out, const char *csg, const struct opponent_options *options,
                      struct error *err)
{
    bool ok = true;
    for (int i = 0; ok && i < OPENCSG_SETTINGS; i++)
        ok = opponent_measure_setting(out, i, csg, options, err);
    return ok;
}

static bool run_process(struct process_side *to, const struct command *c, bool *late,
                        struct error *err)
{
    struct child child;
    if (!child_run(&child, c->words, PROCESS_LIMIT, false, err))
        return false;
    *late = child.late;
    bool ok = child.late || child.status == 0;
    if (ok) {
        samples_add(&to->times, child.seconds * 1e3);
        to->peak_bytes = child.peak_bytes > to->peak_bytes ? child.peak_bytes : to->peak_bytes;
    } else {
        error_set(err, "%s: failed on %s", c->words[0], c->words[1]);
    }
    child_free(&child);
    return ok;
}

// `display` is DISPLAY's value for openscad.
static bool run_both(struct process_result *out, const struct command *we,
                     const struct command *they, const char *display, struct error *err)
{
    bool stuck = false;
    for (int i = 0; i < PROCESS_RUNS && !out->late; i++) {
        unsetenv("DISPLAY");
        bool ok = run_process(&out->ours, we, &stuck, err);
        setenv("DISPLAY", display, 1);
        if (!ok || !run_process(&out->theirs, they, &out->late, err))
            return false;
        if (stuck) {
            error_set(err, "%s: takes more than %d s on %s", we->words[0], PROCESS_LIMIT,
                      out->file);
            return false;
        }
    }
    return true;
}

bool process_measure(struct process_result *out, const char *csg, const char *render,
                     struct error *err)
{
    char ours[64], theirs[64];
    snprintf(ours, sizeof ours, "/tmp/hcsg-bench-%ld-ours.png", (long)getpid());
    snprintf(theirs, sizeof theirs, "/tmp/hcsg-bench-%ld-theirs.png", (long)getpid());
    struct command we = {0}, they = {0};
    const char *const our_words[] = {render, csg, "-o", ours};
    const char *const their_words[] = {"openscad", csg, "-o", theirs};
    const char *const view[] = {"--imgsize=512,512", "--viewall", "--autocenter"};
    for (size_t i = 0; i < array_count(our_words); i++) {
        command_add(&we, our_words[i]);
        command_add(&they, their_words[i]);
    }
    for (size_t i = 0; i < array_count(view); i++) {
        command_add(&we, view[i]);
        command_add(&they, view[i]);
    }
    *out = (struct process_result){.file = csg};
    const char *display = getenv("DISPLAY");
    if (!display) {
        error_set(err, "openscad needs a display; see xvfb-run");
        return false;
    }
    char *kept = mem_strdup(display);
    bool ok = run_both(out, &we, &they, kept, err);
    free(kept);
    unlink(ours);
    unlink(theirs);
    if (!ok)
        process_free(out);
    return ok;
}

void process_free(struct process_result *p)
{
    samples_free(&p->ours.times);
    samples_free(&p->theirs.times);
    *p = (struct process_result){0};
}
