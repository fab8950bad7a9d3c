// answer.h - what openscad leaves behind: its messages and its list of files.
#pragma once
#include "scad/openscad.h"

// The newest part of a child's messages. {0} is valid.
struct scad_log {
    char *text; // terminated once there is any
    size_t size;
};
void scad_log_add(struct scad_log *log, const char *data, size_t size);

// Whether openscad reported an error, which does not show in its exit code.
bool scad_log_has_error(const char *log);

// Reads the rule that `openscad -d` wrote, NULL when it never ran; `path` comes first. Files that
// the messages name are taken in as well: without a rule (after a syntax error) they are all that
// is known.
void scad_read_files(const char *rule_path, const char *path, struct scad_result *out);
// Says in one line why openscad failed, with the place in front when the messages name one.
void scad_error(const struct scad_result *r, struct error *err);
