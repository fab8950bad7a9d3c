// command.c - hcsg-render from its checked options to its exit code.
#include "command/command.h"

#include "base/clock.h"
#include "base/file.h"
#include "command/animation.h"
#include "command/build.h"
#include "command/input.h"
#include "command/output.h"
#include "command/parameters.h"
#include "command/reference.h"
#include "command/rule.h"
#include "command/summary.h"

#include <stdlib.h>
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

struct run {
    struct input input;
    struct solid_store *store; // frames have much in common
    struct device *device;
    struct rule rule;
    struct messages messages; // of the frame
    double began;
};

// Draws and writes the views that have files of their own.
static int write_views(struct run *run, const struct request *r, const struct model *m)
{
    int code = EXIT_FINE;
    for (uint32_t i = 0; i < r->style.views.count; i++) {
        const struct view *view = &r->style.views.items[i];
        struct error err;
        struct drawn drawn;
        if (!request_draws(r, view) && !request_maps(r, view))
            continue;
        if (!drawn_make(&drawn, run->device, r, m, view, &err))
            return command_fail(&err, EXIT_INPUT);
        int one = write_outputs(r, &drawn, view);
        code = one ? one : code;
        drawn_free(&drawn);
    }
    return code;
}

// As text beside what goes to standard output.
static int tell_summary(const struct summary *s)
{
    struct error err;
    bool taken = s->request->rule && strcmp(s->request->rule, "-") == 0;
    for (uint32_t i = 0; i < s->request->output_count; i++)
        taken |= strcmp(s->request->outputs[i].path, "-") == 0;
    if (s->request->summary_file)
        return summary_write(s->request->summary_file, s, &err) ? EXIT_FINE
                                                                : command_fail(&err, EXIT_OUTPUT);
    summary_print(taken ? stderr : stdout, s);
    if (fflush(stdout) == 0 && !ferror(stdout))
        return EXIT_FINE;
    error_set(&err, "standard output: cannot write");
    return command_fail(&err, EXIT_OUTPUT);
}

static int produce(struct run *run, const struct request *r, const struct model *m,
                   struct timing *times)
{
    struct error err;
    struct drawn drawn = {0};
    if (!drawn_make(&drawn, run->device, r, m, NULL, &err))
        return command_fail(&err, EXIT_INPUT);
    times->draw = lap(&run->began);
    int code = write_outputs(r, &drawn, NULL), views = write_views(run, r, m);
    code = code ? code : views;
    times->write = lap(&run->began);
    if (code == EXIT_FINE && r->style.reference) {
        code = reference_check(r, &drawn, &err);
        if (code)
            command_fail(&err, code);
    }
    if ((code == EXIT_FINE || code == EXIT_CHECK) && r->summary) {
        struct summary summary = {
            .request = r, .model = m, .messages = &run->messages, .drawn = &drawn, .times = *times};
        summary_measure(&summary);
        int told = tell_summary(&summary);
        code = code ? code : told;
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

static int run_frame(struct run *run, struct request *r, uint32_t number)
{
    int code = EXIT_INPUT;
    struct error err;
    struct model model = {0};
    struct timing times = {0};

    if (r->is_scad && run->input.views[number].set) {
        r->camera = run->input.views[number].camera;
        r->viewall = r->autocenter = false;
    }
    bool read = input_read(&run->input, r, number, &run->messages);
    times.read = lap(&run->began);
    if (read)
        build_model(&model, r, &run->input, run->store, &run->messages);
    times.build = lap(&run->began);
    print_messages(r, &run->messages);
    if (read && !stops_at_warnings(r, &run->messages))
        code = produce(run, r, &model, &times);
    if (device_failed(run->device, &err) && !r->quiet)
        fprintf(stderr, "warning: %s\n", err.text);
    if (code == EXIT_FINE && r->rule)
        rule_note(&run->rule, r, &run->input, &model);
    model_free(&model);
    messages_free(&run->messages);
    return code;
}

static int run_frames(struct run *run, const struct request *r)
{
    int code = EXIT_FINE;
    struct error err;
    for (uint32_t i = 0; code == EXIT_FINE && i < (r->frames ? r->frames : 1); i++) {
        struct request frame;
        animation_frame(&frame, r, i);
        code = run_frame(run, &frame, i);
        animation_frame_free(&frame);
    }
    if (code == EXIT_FINE && r->rule && !rule_save(&run->rule, r->rule, &err))
        code = command_fail(&err, EXIT_OUTPUT);
    return code;
}

static void say(void *context, const char *line)
{
    (void)context;
    fprintf(stderr, "warning: %s\n", line);
}

// What is known without openscad.
static int write_parameters(const struct request *r)
{
    int code = EXIT_FINE;
    struct error err;
    char *json = NULL;
    if (r->parameter_output_count && !parameters_list(r->input, &json, &err))
        return command_fail(&err, EXIT_INPUT);
    for (uint32_t i = 0; i < r->parameter_output_count; i++)
        if (!file_write(r->parameter_outputs[i], json, strlen(json), &err))
            code = command_fail(&err, EXIT_OUTPUT);
    free(json);
    return code;
}

int command_run(const struct request *r)
{
    int code = write_parameters(r);
    bool more = r->output_count || r->summary || r->style.reference || r->rule;
    struct error why;
    if (code || (r->parameter_output_count && !more))
        return code;
    code = EXIT_INPUT;
    static const struct device_host host = {.say = say};
    struct run run = {.device = device_choose(r->device, &host, &why), .began = clock_seconds()};
    if (!run.device)
        return command_fail(&why, EXIT_INPUT);
    run.store = solid_store_new();
    if (input_open(&run.input, r, &run.messages))
        code = run_frames(&run, r);
    else
        print_messages(r, &run.messages);
    input_free(&run.input);
    device_delete(run.device);
    solid_store_delete(run.store);
    rule_free(&run.rule);
    messages_free(&run.messages);
    return code;
}
