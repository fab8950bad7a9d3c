// timer.h - how long named passes take on the graphics processor, measured without waiting for it.
#pragma once
#include <stdbool.h>
#include <stdint.h>

// What is known of the passes with one name.
struct gl_pass {
    const char *name; // borrowed
    uint64_t count;
    double seconds; // of all
    double least, most, last;
};

enum { GL_TIMERS_IN_FLIGHT = 128, GL_TIMERS_DEPTH = 8 };

// {0} is valid. For one context, and inside of it.
struct gl_timers {
    struct gl_pass *passes; // in the order of their first results
    uint32_t count, capacity;
    struct gl_timing {
        const char *name;
        unsigned queries[2];          // the time at begin and end
    } ring[GL_TIMERS_IN_FLIGHT],      // passes that have ended
        open[GL_TIMERS_DEPTH];        // and those that have not
    uint32_t ended, collected, depth; // passes in all; number n is ring[n % GL_TIMERS_IN_FLIGHT]
};

// Names live as long as the timers. Passes may stand in passes; debuggers show them by name too.
void gl_timer_begin(struct gl_timers *t, const char *name);
void gl_timer_end(struct gl_timers *t);

// Takes the results that are there into `passes`; with `wait`, all of them.
void gl_timers_collect(struct gl_timers *t, bool wait);
void gl_timers_restart(struct gl_timers *t); // forgets the results so far
void gl_timers_free(struct gl_timers *t);    // leaves {0}
