// summary.h - numbers about a model and its picture.
#pragma once
#include "command/output.h"

struct timing {
    double read, build, draw, write; // seconds
};

struct summary {
    const struct request *request;
    const struct model *model;
    const struct messages *messages;
    const struct drawn *drawn;
    struct timing times;
};

void summary_print(FILE *out, const struct summary *s);
