// array.h - the expression of a body for the array method, which the bench compares with.
#pragma once
#include "model/model.h"
#include "render/gl/buffer.h"

struct gl_array { // {0} is valid: nothing uploaded
    struct gl_buffer nodes;
    char defines[64]; // of the shader that evaluates it
};

// Inside of the context. False when there is no room.
bool gl_array_upload(struct gl_array *a, struct gl_memory *memory, const struct body *body,
                     struct error *err);
