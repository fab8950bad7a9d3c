// pass.h - what passes are made of: shaders taken for a band and slab, and what they need.
#pragma once
#include "render/gl/passes.h"

size_t gl_pass_pixels(const struct frame_data *f); // of the band

// Room for a number that grows from frame to frame: more than asked for, but no more than planned.
size_t gl_pass_reserve(size_t needed, size_t most);

// Bytes of the links of a band with so many crossings.
size_t gl_links_size(size_t pixels, size_t crossings);

bool gl_pass_read(struct gl_work *w, const struct gl_buffer *from, void *out, size_t size,
                  struct error *err);

// Takes a shader that is bound to what it needs, by so many groups, or as many as the counters say.
bool gl_pass_take(struct gl_work *w, const char *name, const char *defines, size_t groups,
                  struct error *err);
bool gl_pass_take_counted(struct gl_work *w, const char *name, const char *defines,
                          struct error *err);

void gl_pass_bind(const struct gl_work *w, const struct gl_scene *scene); // the frame, its leaves
// Where the crossings of a ray are found.
void gl_pass_bind_lists(const struct gl_work *w);
