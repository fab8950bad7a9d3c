// stats.c - the times of frames and loads, for --stats.
#include "app/stats.h"

#include <stdio.h>

static void print_passes(const struct render_stats *stats)
{
    for (int i = 0; i < RENDER_PASSES && stats->passes[i].name; i++)
        printf("%s %s %.2f", i ? "," : "passes, ms:", stats->passes[i].name,
               1e3 * stats->passes[i].seconds);
    if (stats->passes[0].name)
        printf("\n");
}

static void print_memory(const struct render_stats *stats)
{
    const double mb = 1 << 20;
    printf("memory, MB: frame %.1f", (double)stats->peak_bytes / mb);
    if (stats->model_bytes)
        printf(", model %.1f", (double)stats->model_bytes / mb);
    printf("\n");
}

void stats_print(const struct shot *s, double shown, bool first)
{
    const struct load_times *t = &s->job.loaded->times;
    printf("frame %dx%d 1/%d: %.1f ms, asked to shown %.1f ms, setup %.2f ms", s->job.width,
           s->job.height, s->job.divisor, 1e3 * (s->done - s->begun), 1e3 * (shown - s->job.asked),
           1e3 * s->stats.seconds_setup);
    if (s->stats.fragments) // the rays that need a walk
        printf(", walked %llu surfaces, %llu combinations new",
               (unsigned long long)s->stats.fragments, (unsigned long long)s->stats.misses);
    printf("\n");
    if (s->stats.waits.count)
        printf("waits for the graphics processor: %llu, %.2f ms, longest %.2f ms\n",
               (unsigned long long)s->stats.waits.count, 1e3 * s->stats.waits.seconds,
               1e3 * s->stats.waits.longest);
    print_passes(&s->stats);
    print_memory(&s->stats);
    if (first)
        printf("load %u: %.1f ms to shown (wait %.1f, parse %.1f, model %.1f, draw %.1f, "
               "show %.1f), %u leaves\n",
               s->job.loaded->number, 1e3 * (shown - t->noticed), 1e3 * (t->started - t->noticed),
               1e3 * (t->parsed - t->started), 1e3 * (t->built - t->parsed),
               1e3 * (s->done - t->built), 1e3 * (shown - s->done),
               s->job.loaded->model.stats.leaves);
    fflush(stdout);
}
