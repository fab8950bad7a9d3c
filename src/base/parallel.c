// parallel.c - the one parallel loop, over OpenMP.
#include "base/parallel.h"

#include <omp.h>

enum { WORKERS_MOST = 256 };

uint32_t parallel_workers(uint32_t threads)
{
    int n = threads ? (int)threads : omp_get_num_procs();
    return n < 1 ? 1 : n > WORKERS_MOST ? WORKERS_MOST : (uint32_t)n;
}

void parallel_for(uint32_t count, uint32_t threads,
                  void (*body)(void *context, uint32_t item, uint32_t worker), void *context)
{
    uint32_t workers = parallel_workers(threads);
    if (workers > count)
        workers = count;
    if (workers <= 1) {
        for (uint32_t i = 0; i < count; i++)
            body(context, i, 0);
        return;
    }
#pragma omp parallel for schedule(dynamic, 1) num_threads((int)workers)
    for (uint32_t i = 0; i < count; i++)
        body(context, i, (uint32_t)omp_get_thread_num());
}
