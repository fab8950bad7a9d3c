// curves.h - how times follow one thing: the side of the picture, the number of primary values.
#pragma once
#include "measure.h"

#include <stdio.h>

struct curves_options {
    struct measure_options ours;
    const char *opencsg; // its program, NULL: not to be measured
};

// Figure 6 of the HCSG paper, and more: rows "scene curve_WAY_SIDE_ms median min n" for sides of
// 256 to 8192 pixels. WAY is "transparent" or "opaque", then cpu, gl1 to gl5, which are numbers of
// slabs, or glarray; or opaque_opencsg. A way ends with the side at which a frame takes longer than
// the limit, or where it fails, which is said. False when there is no device.
bool curves_by_side(FILE *tsv, const struct scene *scene, const char *csg,
                    const struct curves_options *options, struct error *err);

// Rows "scene values_HOW_count", "..._crossings", "..._combinations" and "scene values_HOW_WAY_ms
// median min n" of transparent frames: HOW is shared or unshared, WAY cpu, cpuarray, gl or glarray.
bool curves_by_values(FILE *tsv, const char *scene, const char *csg,
                      const struct measure_options *options, struct error *err);
