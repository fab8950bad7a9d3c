// write_stl.c - meshes as STL files.
#include "io/write_stl.h"

#include "io/text_file.h"

static struct vec3 normal(const struct vec3 *corners)
{
    return vec3_normalized(
        vec3_cross(vec3_sub(corners[1], corners[0]), vec3_sub(corners[2], corners[0])));
}

bool write_stl(const char *path, const struct mesh *m, struct error *err)
{
    struct text_file t = {0};
    text_file_add(&t, "solid hcsg\n");
    for (uint32_t i = 0; i < m->triangle_count; i++) {
        struct vec3 corners[3];
        for (int k = 0; k < 3; k++)
            corners[k] = m->vertices[m->triangles[i][k]];
        text_file_add(&t, "facet normal ");
        text_file_point(&t, normal(corners));
        text_file_add(&t, "\nouter loop\n");
        for (int k = 0; k < 3; k++) {
            text_file_add(&t, "vertex ");
            text_file_point(&t, corners[k]);
            text_file_add(&t, "\n");
        }
        text_file_add(&t, "endloop\nendfacet\n");
    }
    text_file_add(&t, "endsolid hcsg\n");
    return text_file_save(&t, path, err);
}
