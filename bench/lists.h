// lists.h - what the two ways to list crossings take on the gl device.
#pragma once
#include "measure.h"

#include <stdio.h>

// Crossings counted, scanned, written and sorted, or inserted in order into linked lists: pairs of
// frames of one view, so that whatever slows the machine down slows both. Rows of a table in
// Markdown, ms: the least times of passes and of the processor, which counts where OpenGL runs on
// it, and medians of the pairs' ratios. False when there is no device, or it fails.
void lists_heading(FILE *out);
bool lists_measure(FILE *out, const char *scene, const char *csg,
                   const struct measure_options *options, struct error *err);
