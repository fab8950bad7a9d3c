// learner.c - discovery over several frames.
#include "render/gl/learner.h"

#include "base/clock.h"
#include "base/mem.h"
#include "render/gl/discover.h"

#include <stdlib.h>

static void *work(void *argument)
{
    struct gl_learner *l = argument;
    double begun = clock_seconds();
    l->found = gl_discover(l->body, l->records, l->words);
    l->words = 0;
    values_renew(l->body->sharing.classes, l->body->sharing.class_count, &l->random);
    discovery_renew(l->body->table);
    l->seconds = clock_seconds() - begun;
    return NULL;
}

void gl_learner_start(struct gl_learner *l, const struct body *body)
{
    l->body = body;
    l->running = pthread_create(&l->thread, NULL, work, l) == 0;
    if (!l->running)
        work(l);
}

void gl_learner_finish(struct gl_learner *l, struct render_stats *stats)
{
    if (l->running)
        pthread_join(l->thread, NULL);
    l->running = false;
    if (!l->body)
        return;
    struct render_pass pass = {"discover", l->seconds, 1};
    render_stats_pass(stats, &pass);
    stats->misses += l->found;
    l->body = NULL;
}

uint32_t *gl_learner_room(struct gl_learner *l, size_t words)
{
    array_reserve(&l->records, &l->capacity, l->words + words + 1);
    l->words += (uint32_t)words;
    return l->records + l->words - words;
}

void gl_learner_free(struct gl_learner *l)
{
    if (l->running)
        pthread_join(l->thread, NULL);
    free(l->records);
    *l = (struct gl_learner){0};
}
