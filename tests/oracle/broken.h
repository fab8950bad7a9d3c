// broken.h - random harm to the meshes of a scene: holes, turned triangles, meshes inside out,
// within each other and through each other.
#pragma once
#include "random_tree.h"

// The same for a seed everywhere. The oracle has no answer for what is left: ways to draw may be
// compared with each other.
void broken_scene(struct random_scene *s, uint64_t seed);
