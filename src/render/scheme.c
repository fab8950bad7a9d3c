// scheme.c - OpenSCAD's colour schemes.
#include "render/scheme.h"

#include "base/mem.h"

#include <string.h>

#define C(hex)                                                                                     \
    {                                                                                              \
        (hex) >> 16 & 255, (hex) >> 8 & 255, (hex)&255                                             \
    }

// clang-format off
static const struct scheme schemes[] = {
    // name, background, its bottom, axes, crosshair,
    //   front, back, mesh front, mesh back, flat, edge front, edge back, edge flat
    {"Cornfield", C(0xffffe5), C(0xffffe5), C(0x000000), C(0x800000),
     C(0xf9d72c), C(0x9dcb51), C(0xf9d72c), C(0x9dcb51),
     C(0x00bf99), C(0xffec5e), C(0xabd856), C(0xff0000)},
    {"Metallic", C(0xaaaaff), C(0xaaaaff), C(0x222233), C(0x800000),
     C(0xddddff), C(0xdd22dd), C(0xddddff), C(0xdd22dd),
     C(0x00bf99), C(0xff0000), C(0xff0000), C(0xff0000)},
    {"Sunset", C(0xaa4444), C(0xaa4444), C(0x220d0d), C(0x800000),
     C(0xffaaaa), C(0x882233), C(0xffaaaa), C(0x882233),
     C(0x00bf99), C(0xff0000), C(0xff0000), C(0xff0000)},
    {"Starnight", C(0x000000), C(0x000000), C(0xe5e5e5), C(0xf0f0f0),
     C(0xffffe0), C(0x00ffff), C(0xffffe0), C(0x00ffff),
     C(0x9370db), C(0x0000ff), C(0x0000ff), C(0xff00ff)},
    {"BeforeDawn", C(0x333333), C(0x333333), C(0xc1c1c1), C(0xf0f0f0),
     C(0xcccccc), C(0x5563dd), C(0xcccccc), C(0x5563dd),
     C(0x00bf99), C(0xff0000), C(0xff0000), C(0xff0000)},
    {"Nature", C(0xfafafa), C(0xfafafa), C(0x323232), C(0x111111),
     C(0x16a085), C(0xdbf4da), C(0x16a085), C(0xdbf4da),
     C(0x00bf99), C(0xff0000), C(0xff0000), C(0xff0000)},
    {"Daylight Gem", C(0xf0f0f0), C(0xf0f0f0), C(0x373947), C(0x5a73ba),
     C(0x02daf7), C(0x014da1), C(0x02daf7), C(0x014da1),
     C(0x0498cf), C(0xb8f3f7), C(0x0fb7e8), C(0xb6f1eb)},
    {"Nocturnal Gem", C(0x0c0c0c), C(0x0c0c0c), C(0xa7a9b7), C(0x8aa3da),
     C(0x02daf7), C(0x014da1), C(0x02daf7), C(0x014da1),
     C(0x0498cf), C(0xb8f3f7), C(0x0fb7e8), C(0xb6f1eb)},
    {"DeepOcean", C(0x333333), C(0x333333), C(0xc1c1c1), C(0xf0f0f0),
     C(0xeeeeee), C(0x0babc8), C(0xeeeeee), C(0x0babc8),
     C(0x9370db), C(0x0000ff), C(0x0000ff), C(0xff00ff)},
    {"Solarized", C(0xfdf6e3), C(0xfdf6e3), C(0x191816), C(0x800000),
     C(0xb58800), C(0x882233), C(0xb58800), C(0x882233),
     C(0x6c71c4), C(0xb58800), C(0xb58800), C(0xb58800)},
    {"Tomorrow", C(0xf8f8f8), C(0xf8f8f8), C(0x181818), C(0x8959a8),
     C(0x4271ae), C(0xf5871f), C(0x3e999f), C(0xeab700),
     C(0x718c00), C(0x4d4d4c), C(0x4d4d4c), C(0xc82829)},
    {"Tomorrow Night", C(0x1d1f21), C(0x1d1f21), C(0xe8e8e8), C(0xb294bb),
     C(0x81a2be), C(0xde935f), C(0x8abeb7), C(0xf0c674),
     C(0xb5bd68), C(0xc5c8c6), C(0xc5c8c6), C(0xcc6666)},
    {"ClearSky", C(0x87ceeb), C(0xc9e9f6), C(0x000000), C(0x800000),
     C(0xf9d72c), C(0x9dcb51), C(0xffec5e), C(0x9dcb51),
     C(0x00bf99), C(0xffec5e), C(0xabd856), C(0xff0000)},
    {"Monotone", C(0xffffe5), C(0xffffe5), C(0x191916), C(0x800000),
     C(0xf9d72c), C(0xf9d72c), C(0xf9d72c), C(0xf9d72c),
     C(0x00bf99), C(0xff0000), C(0xff0000), C(0xff0000)},
};
// clang-format on

const struct scheme *scheme_list(uint32_t *count)
{
    *count = array_count(schemes);
    return schemes;
}

const struct scheme *scheme_find(const char *name, struct error *err)
{
    for (size_t i = 0; i < array_count(schemes); i++)
        if (strcmp(schemes[i].name, name) == 0)
            return &schemes[i];
    char list[512];
    size_t used = 0;
    for (size_t i = 0; i < array_count(schemes); i++)
        used += (size_t)snprintf(list + used, sizeof list - used, "%s%s", i ? ", " : "",
                                 schemes[i].name);
    error_set(err, "no colour scheme '%s'; there are: %s", name, list);
    return NULL;
}
