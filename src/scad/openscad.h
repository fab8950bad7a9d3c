// openscad.h - the openscad program as a child process that exports a .scad file as .csg text.
#pragma once
#include "base/error.h"

#include <stddef.h>

struct uv_loop_s;

struct scad_text {
    char *text; // a .csg, followed by two zero bytes that are not counted
    size_t size;
};

// The texts of an animation, one behind the other in a file that has no name any more: memory does
// not grow with their number, and nothing is left behind however the program ends.
struct scad_frames {
    FILE *file;   // NULL: there are none
    size_t *ends; // of each text in the file
    uint32_t count;
};

struct scad_result { // {0} is a valid empty result
    char *text;      // as in scad_text; NULL after a failure and of animations
    size_t size;
    struct scad_frames frames; // of animations
    char *name;   // of the text in messages; imports in the text are relative to its folder
    char **files; // what the text depends on, the .scad itself first; missing files as well
    uint32_t file_count;
    char *log; // what openscad said, without its statistics
};

void scad_result_free(struct scad_result *r); // leaves {0}
// One text of an animation. The caller frees out->text.
bool scad_read_frame(const struct scad_frames *f, uint32_t frame, struct scad_text *out,
                     struct error *err);

struct scad_options {             // {0}: all defaults. Borrowed while the export lasts
    const char *program;          // NULL: $OPENSCAD, or else "openscad" on the PATH
    const char *const *arguments; // for the program, beside those that make it export
    uint32_t argument_count;
    uint32_t frames; // of an animation; 0: none
};

// Exports and waits for the end. SIGINT, SIGTERM and SIGHUP end openscad first, then take their
// course. After a failure *out holds files and log all the same.
bool scad_export(const char *path, const struct scad_options *options, struct scad_result *out,
                 struct error *err);

// The same without waiting. `done` is called once, from the loop; it takes the result over. `err`
// is NULL when the export went well.
struct scad_job;
typedef void scad_done(void *context, struct scad_result *result, const struct error *err);
struct scad_job *scad_start(struct uv_loop_s *loop, const char *path,
                            const struct scad_options *options, scad_done *done, void *context);
// Kills the child with all its children; `done` is not called any more. The job ends itself on the
// loop, which has to run until then.
void scad_cancel(struct scad_job *job);

// Whether openscad warned; *err becomes its first warning, with the place in front.
bool scad_warning(const struct scad_result *r, struct error *err);

enum scad_level { SCAD_ECHO, SCAD_TRACE, SCAD_WARNING, SCAD_ERROR };
struct scad_message {
    enum scad_level level;
    const char *text; // within the log, without its kind and place; not terminated
    size_t length;
    char *file; // that it names, NULL for none; the caller frees it
    uint32_t line;
};
// The next message of r->log; *rest is r->log at first. False at the end.
bool scad_next_message(const struct scad_result *r, const char **rest, struct scad_message *out);
