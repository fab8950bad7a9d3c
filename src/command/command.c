// command.c - hcsg-render from its checked options to its exit code.
#include "command/command.h"

#include "base/clock.h"
#include "command/build.h"
#include "command/input.h"
#include "command/output.h"
#include "command/reference.h"
#include "command/summary.h"

#include <string.h>

int command_fail(const struct error *err, int code)
{
    fprintf(stderr, "hcsg-render: %s\n", err->text);
    return code;
}

// Seconds since *start, which moves to now.
static double lap(double *start)
{
    double before = *start;
    *start = clock_seconds();
    return *start - before;
}

// One output that cannot be written does not keep the others from it.
static int write_outputs(const struct request *r, const struct drawn *d, const struct view *view)
{
    int code = EXIT_FINE;
    struct error err;
    for (uint32_t i = 0; i < r->output_count; i++)
        if (r->outputs[i].per_view == (view != NULL) &&
            !output_write(&r->outputs[i], d, view, &err))
            code = command_fail(&err, EXIT_OUTPUT);
    return code;
}

// Draws and writes the views that have files of their own.
static int write_views(const struct request *r, const struct model *m)
{
    int code = EXIT_FINE;
    for (uint32_t i = 0; i < r->style.views.count; i++) {
        const struct view *view = &r->style.views.items[i];
        struct error err;
        struct drawn drawn;
        if (!request_draws(r, view) && !request_maps(r, view))
            continue;
        if (!drawn_make(&drawn, r, m, view, &err))
            return command_fail(&err, EXIT_INPUT);
        int one = write_outputs(r, &drawn, view);
        code = one ? one : code;
        drawn_free(&drawn);
    }
    return code;
}

static int print_summary(const struct summary *s)
{
    bool taken = false; // standard output, by an output
    for (uint32_t i = 0; i < s->request->output_count; i++)
        taken |= strcmp(s->request->outputs[i].path, "-") == 0;
    summary_print(taken ? stderr : stdout, s);
    if (fflush(stdout) == 0 && !ferror(stdout))
        return EXIT_FINE;
    struct error err;
    error_set(&err, "standard output: cannot write");
    return command_fail(&err, EXIT_OUTPUT);
}

static int produce(const struct request *r, const struct model *m, const struct messages *messages,
                   struct timing *times, double *lap_start)
{
    struct error err;
    struct drawn drawn = {0};
    if (!drawn_make(&drawn, r, m, NULL, &err))
        return command_fail(&err, EXIT_INPUT);
    times->draw = lap(lap_start);
    int code = write_outputs(r, &drawn, NULL), views = write_views(r, m);
    code = code ? code : views;
    times->write = lap(lap_start);
    if (code == EXIT_FINE && r->style.reference) {
        code = reference_check(r, &drawn, &err);
        if (code)
            command_fail(&err, code);
    }
    if ((code == EXIT_FINE || code == EXIT_CHECK) && r->summary) {
        int printed = print_summary(&(struct summary){r, m, messages, &drawn, *times});
        code = code ? code : printed;
    }
    drawn_free(&drawn);
    return code;
}

static void print_messages(const struct request *r, const struct messages *messages)
{
    if (r->quiet)
        messages_print_errors(messages, stderr);
    else
        messages_print(messages, stderr);
}

static bool stops_at_warnings(const struct request *r, const struct messages *messages)
{
    struct error err;
    if (!r->hard_warnings || messages->warnings + messages->errors == 0)
        return false;
    error_set(&err, "%s: nothing is written, there are warnings (--hardwarnings)", r->input);
    command_fail(&err, EXIT_INPUT);
    return true;
}

int command_run(const struct request *r)
{
    int code = EXIT_INPUT;
    struct messages messages = {0};
    struct input input = {0};
    struct model model = {0};
    struct timing times = {0};
    struct solid_store *store = solid_store_new();
    double start = clock_seconds();

    bool read = input_read(&input, r, &messages);
    times.read = lap(&start);
    if (read)
        build_model(&model, r, &input, store, &messages);
    times.build = lap(&start);
    print_messages(r, &messages);
    if (read && !stops_at_warnings(r, &messages))
        code = produce(r, &model, &messages, &times, &start);
    model_free(&model);
    solid_store_delete(store);
    input_free(&input);
    messages_free(&messages);
    return code;
}
