// context.h - an OpenGL 4.5 context, mostly without window or display, and what its driver can do.
#pragma once
#include "base/error.h"

#include <stddef.h>

// Takes what the driver says of errors, undefined behaviour and lost speed, one line each, on the
// thread that is in the context.
struct gl_log {
    void (*say)(void *context, const char *line);
    void *context;
};

struct gl_facts {
    char vendor[128], renderer[128], version[128];
    char found[64]; // which display of EGL it came from: "device 0", "surfaceless", ... or "window"
    bool software;  // llvmpipe and its like: no graphics processor
    bool tells_loss;       // gl_context_failed notices that the driver was reset
    bool int64, atomic64;  // 64-bit integers in shaders, and atomics on them in buffers
    int subgroup;          // invocations that share ballots and sums, 0: no subgroups
    size_t storage_size;   // of one shader storage buffer
    int storage_blocks;    // buffers that a compute shader can use
    int storage_bindings;  // places for them
    int storage_alignment; // of a range of a buffer
    int group_count[3];    // work groups of a dispatch
    int group_size[3];     // invocations of a work group along each axis
    int group_invocations; // ... and of all
    size_t shared_size;    // bytes that a work group shares
};

// Hardware first; an error says why each way was no good. With a log the context is one for
// debugging: the driver checks more. `log` is copied and may be NULL. Nothing stays current.
struct gl_context *gl_context_new(const struct gl_log *log, struct error *err);
// The same with a context of the program's, for drivers that give none without a window: `open`
// makes it current on this thread, and it stays the program's, to be kept for as long as this one.
// *err says why there is none.
struct gl_context *gl_context_adopt(bool (*open)(void *context, struct error *err), void *context,
                                    const struct gl_log *log, struct error *err);
void gl_context_delete(struct gl_context *c); // NULL is fine

const struct gl_facts *gl_context_facts(const struct gl_context *c);

// True if the driver has all that the gl device needs beyond OpenGL 4.5.
bool gl_facts_suffice(const struct gl_facts *facts, struct error *err);

// False, with a reason, when EGL lists its devices and knows of no graphics processor; true when
// nobody knows. Takes no longer than loading EGL.
bool gl_hardware_there(struct error *err);

// Makes the context current on this thread; leaving puts back what was current before, be it of EGL
// or GLX. One thread at a time, and not twice.
bool gl_context_enter(struct gl_context *c, struct error *err);
void gl_context_leave(struct gl_context *c);

// True if the driver has lost the context, ran out of memory or was used wrongly since the last
// call. A context that is lost stays so. Inside of the context only.
bool gl_context_failed(struct gl_context *c, struct error *err);
