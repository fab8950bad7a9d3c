// rule.h - the rule for make: what the outputs are made from.
#pragma once
#include "command/input.h"
#include "io/text_file.h"
#include "model/model.h"

struct rule { // {0} is valid
    struct text_file targets, files;
};

// Adds the outputs of the request, and takes over what they were made from.
void rule_note(struct rule *rule, const struct request *r, const struct input *in,
               const struct model *m);
// In the form of OpenSCAD. Leaves {0}.
bool rule_save(struct rule *rule, const char *path, struct error *err);
void rule_free(struct rule *rule); // leaves {0}
