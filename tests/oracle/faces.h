// faces.h - the planes of the faces of a body's leaves, in the world.
#pragma once
#include "model/model.h"

struct faces {
    struct face_plane *planes; // of all leaves, one after the other
    size_t *first;             // per leaf: index of its first plane
};

struct face_plane {     // where normal . p = distance
    struct vec3 normal; // of any length; zero: the face has no area
    double distance;
};

void faces_init(struct faces *out, const struct body *body);
void faces_free(struct faces *f); // leaves {0}
