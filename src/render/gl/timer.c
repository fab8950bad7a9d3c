// timer.c - how long named passes take on the graphics processor, measured without waiting for it.
#include "render/gl/timer.h"

#include "base/mem.h"

#include <assert.h>
#include <epoxy/gl.h>
#include <stdlib.h>
#include <string.h>

static void add(struct gl_timers *t, const char *name, double seconds)
{
    struct gl_pass *p = t->passes, *end = t->passes + t->count;
    while (p < end && strcmp(p->name, name))
        p++;
    if (p == end) {
        array_reserve(&t->passes, &t->capacity, t->count + 1);
        p = &t->passes[t->count++];
        *p = (struct gl_pass){.name = name, .least = seconds, .most = seconds};
    }
    p->count++;
    p->seconds += seconds;
    p->last = seconds;
    if (seconds < p->least)
        p->least = seconds;
    if (seconds > p->most)
        p->most = seconds;
}

// The oldest pass; false if its time is not known yet and not waited for.
static bool collect_one(struct gl_timers *t, bool wait)
{
    const struct gl_timing *oldest = &t->ring[t->collected % GL_TIMERS_IN_FLIGHT];
    if (!wait) {
        GLint there = 0;
        glGetQueryObjectiv(oldest->queries[1], GL_QUERY_RESULT_AVAILABLE, &there);
        if (!there)
            return false;
    }
    GLuint64 from = 0, to = 0;
    glGetQueryObjectui64v(oldest->queries[0], GL_QUERY_RESULT, &from);
    glGetQueryObjectui64v(oldest->queries[1], GL_QUERY_RESULT, &to);
    add(t, oldest->name, to > from ? (double)(to - from) * 1e-9 : 0);
    t->collected++;
    return true;
}

void gl_timer_begin(struct gl_timers *t, const char *name)
{
    assert(t->depth < GL_TIMERS_DEPTH);
    struct gl_timing *now = &t->open[t->depth++];
    if (!now->queries[0])
        glCreateQueries(GL_TIMESTAMP, 2, now->queries);
    now->name = name;
    glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, -1, name);
    glQueryCounter(now->queries[0], GL_TIMESTAMP);
}

void gl_timer_end(struct gl_timers *t)
{
    assert(t->depth);
    if (t->ended - t->collected == GL_TIMERS_IN_FLIGHT)
        collect_one(t, true);
    struct gl_timing *now = &t->open[--t->depth];
    struct gl_timing *slot = &t->ring[t->ended++ % GL_TIMERS_IN_FLIGHT];
    glQueryCounter(now->queries[1], GL_TIMESTAMP);
    glPopDebugGroup();
    struct gl_timing unused = *slot; // its queries serve the next pass
    *slot = *now;
    *now = unused;
}

void gl_timers_collect(struct gl_timers *t, bool wait)
{
    while (t->collected != t->ended && collect_one(t, wait))
        ;
}

void gl_timers_restart(struct gl_timers *t)
{
    t->count = 0;
}

static void delete_queries(const struct gl_timing *timings, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        if (timings[i].queries[0])
            glDeleteQueries(2, timings[i].queries);
}

void gl_timers_free(struct gl_timers *t)
{
    delete_queries(t->ring, array_count(t->ring));
    delete_queries(t->open, array_count(t->open));
    free(t->passes);
    *t = (struct gl_timers){0};
}
