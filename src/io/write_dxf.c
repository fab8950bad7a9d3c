// write_dxf.c - flat shapes as DXF files.
#include "io/write_dxf.h"

#include "io/text_file.h"

static void add_point(struct text_file *t, struct vec2 p, const char *x, const char *y)
{
    text_file_add(t, x);
    text_file_number(t, p.x);
    text_file_add(t, y);
    text_file_number(t, p.y);
}

bool write_dxf(const char *path, const struct outline *o, struct error *err)
{
    struct text_file t = {0};
    text_file_add(&t, "0\nSECTION\n2\nENTITIES\n");
    for (uint32_t i = 0, first = 0; i < o->path_count; first = o->ends[i++])
        for (uint32_t k = first; k < o->ends[i]; k++) {
            text_file_add(&t, "0\nLINE\n8\n0");
            add_point(&t, o->points[k], "\n10\n", "\n20\n");
            add_point(&t, o->points[k + 1 < o->ends[i] ? k + 1 : first], "\n11\n", "\n21\n");
            text_file_add(&t, "\n");
        }
    text_file_add(&t, "0\nENDSEC\n0\nEOF\n");
    return text_file_save(&t, path, err);
}
