// format.c - what can be written, by the names that are also the extensions of such files.
#include "command/format.h"

#include "base/mem.h"

#include <strings.h>

static const struct output_format formats[] = {
    {"png", OUTPUT_PICTURE, 0},
    {"depthmap", OUTPUT_DEPTHMAP, 0},
    {"pfm", OUTPUT_DEPTHS, 0},
    {"normals", OUTPUT_NORMALS, 0},
    {"ids", OUTPUT_IDS, 0},
    {"stl", OUTPUT_GEOMETRY, EXPORT_STL},
    {"off", OUTPUT_GEOMETRY, EXPORT_OFF},
    {"dxf", OUTPUT_GEOMETRY, EXPORT_DXF},
    {"param", OUTPUT_PARAMETERS, 0},
};

const struct output_format *output_format_find(const char *name)
{
    for (size_t i = 0; i < array_count(formats); i++)
        if (strcasecmp(formats[i].name, name) == 0)
            return &formats[i];
    return NULL;
}

void output_format_names(char *text, size_t size)
{
    size_t used = 0, last = array_count(formats) - 1;
    for (size_t i = 0; i <= last && used < size; i++)
        used += (size_t)snprintf(text + used, size - used, "%s%s", formats[i].name,
                                 i == last       ? ""
                                 : i + 1 == last ? " or "
                                                 : ", ");
}
