// write_off.c - meshes as OFF files.
#include "io/write_off.h"

#include "io/text_file.h"

bool write_off(const char *path, const struct mesh *m, struct error *err)
{
    struct text_file t = {0};
    text_file_add(&t, "OFF\n");
    text_file_count(&t, m->vertex_count);
    text_file_add(&t, " ");
    text_file_count(&t, m->triangle_count);
    text_file_add(&t, " 0\n");
    for (uint32_t i = 0; i < m->vertex_count; i++) {
        text_file_point(&t, m->vertices[i]);
        text_file_add(&t, "\n");
    }
    for (uint32_t i = 0; i < m->triangle_count; i++) {
        text_file_add(&t, "3");
        for (int k = 0; k < 3; k++) {
            text_file_add(&t, " ");
            text_file_count(&t, m->triangles[i][k]);
        }
        text_file_add(&t, "\n");
    }
    return text_file_save(&t, path, err);
}
