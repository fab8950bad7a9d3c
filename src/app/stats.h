// stats.h - the times of frames and loads, for --stats.
#pragma once
#include "app/drawing.h"

// `shown`: when the shot stood in the window; `first`: of its load.
void stats_print(const struct shot *s, double shown, bool first);
