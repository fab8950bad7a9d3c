// opencsg_c.h - OpenCSG's C++ interface, for C.
#pragma once
#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum opencsg_algorithm { OPENCSG_AUTOMATIC, OPENCSG_SCS, OPENCSG_GOLDFEATHER };

// Needs a current GL context with GLEW initialised. Frame buffer objects hold what it draws
// besides.
void opencsg_choose(enum opencsg_algorithm algorithm);

struct opencsg_product; // its primitives

// `draw` draws a leaf, whenever opencsg_render asks for it.
struct opencsg_product *opencsg_product_new(const uint32_t *leaves, uint32_t intersected,
                                            uint32_t count, uint32_t convexity,
                                            void (*draw)(void *context, uint32_t leaf),
                                            void *context);
void opencsg_product_delete(struct opencsg_product *p); // accepts NULL
// Box of primitive i in normalised device coordinates: least x, y, z, most x, y, z.
void opencsg_product_box(struct opencsg_product *p, uint32_t i, const float box[6]);
// Writes the depth of the product's first surface.
void opencsg_render(const struct opencsg_product *p);

#ifdef __cplusplus
}
#endif
