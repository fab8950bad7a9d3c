// curves.h - times of transparent frames by the side of the picture: Figure 6 of the HCSG paper.
#pragma once
#include "measure.h"

#include <stdio.h>

// Rows "scene curve_WAY_SIZE_ms median min n", where a way is cpu, gl1 to gl5, which are
// numbers of slabs, or glarray. A way ends with the size at which a frame takes longer than the
// limit. False when there is no device, or it fails.
bool curves_measure(FILE *tsv, const char *scene, const char *csg,
                    const struct measure_options *options, struct error *err);
