// learner.h - discovery over several frames, as section 4.1 of the HCSG paper has it.
//
// What is unknown shows as empty. One ray of each square of REDUCE_SIDE pixels a side puts the
// first combination that it misses on record with what follows, and these come back with the frame.
// While the lists of the next frame are made, a second thread evaluates them and renews the
// secondary values of all classes.
#pragma once
#include "render/device.h"

#include <pthread.h>

struct gl_learner { // {0} is valid
    uint32_t *records;
    uint32_t words, capacity;
    uint64_t random; // for values_renew
    const struct body *body;
    pthread_t thread; // while it runs
    bool running;
    uint32_t found; // by it
    double seconds;
};

// A frame begins: from here on values and table belong to the other thread.
void gl_learner_start(struct gl_learner *l, const struct body *body);
// Waits until it has done its work. Nothing to do when it does not run.
void gl_learner_finish(struct gl_learner *l, struct render_stats *stats);
// Keeps records of unknown combinations (combination.glsl) for the next frame: room for `words`
// words.
uint32_t *gl_learner_room(struct gl_learner *l, size_t words);
void gl_learner_free(struct gl_learner *l); // leaves {0}
