// drawn.h - a model in GL: leaves in vertex buffers, a picture to draw into, camera and light.
#pragma once
#include "model/model.h"
#include "render/rays.h"

struct drawn;

// Opens a hidden window for the sake of its context, and makes a picture of size x size.
bool drawn_new(struct drawn **out, const struct body *body, int size, struct error *err);
void drawn_delete(struct drawn *d); // accepts NULL

void drawn_begin(struct drawn *d, const struct rays *rays); // clears, sets camera and light
void drawn_depth(struct drawn *d, uint32_t leaf);           // geometry alone
enum drawn_sides { DRAWN_OUTSIDE, DRAWN_INSIDE };
void drawn_colour(struct drawn *d, uint32_t leaf, enum drawn_sides sides); // lit
void drawn_equal(bool only_equal); // depth test that drawn_colour draws with
void drawn_end(struct drawn *d);   // waits until all is drawn

// Box of the leaf in normalised device coordinates of the view: least x, y, z, most x, y, z.
void drawn_box(const struct drawn *d, uint32_t leaf, float box[6]);
// The picture, 8-bit RGB, rows from the top. The caller frees it.
uint8_t *drawn_picture(const struct drawn *d);
const char *drawn_renderer(void); // GL_RENDERER
