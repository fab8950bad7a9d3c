// parallel.h - the one parallel loop.
#pragma once
#include <stdint.h>

// Calls body(context, item, worker) once for each item in [0, count), items handed out in order to
// `threads` workers (numbered from 0). 1 thread runs in the caller; 0 means one per processor.
void parallel_for(uint32_t count, uint32_t threads,
                  void (*body)(void *context, uint32_t item, uint32_t worker), void *context);

// The number of workers that parallel_for uses for this request.
uint32_t parallel_workers(uint32_t threads);
