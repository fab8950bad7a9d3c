// summary_parts.c - the parts that a summary can have, by OpenSCAD's names.
#include "command/summary_parts.h"

#include "base/mem.h"

#include <string.h>

bool summary_parse(uint32_t *parts, const char *names, struct error *err)
{
    static const struct {
        const char *name;
        uint32_t parts;
    } all[] = {
        {"", SUMMARY_QUICK},           {"all", SUMMARY_ALL},       {"cache", SUMMARY_CACHE},
        {"time", SUMMARY_TIME},        {"camera", SUMMARY_CAMERA}, {"geometry", SUMMARY_GEOMETRY},
        {"bounding-box", SUMMARY_BOX}, {"area", SUMMARY_AREA},     {"volume", SUMMARY_VOLUME}};
    for (size_t length; names; names = names[length] ? names + length + 1 : NULL) {
        size_t i = 0;
        length = strcspn(names, ",");
        while (i < array_count(all) &&
               (strlen(all[i].name) != length || memcmp(all[i].name, names, length) != 0))
            i++;
        if (i == array_count(all)) {
            error_set(err, "--summary: expected some of %s, got '%.*s'", SUMMARY_NAMES, (int)length,
                      names);
            return false;
        }
        *parts |= all[i].parts;
    }
    return true;
}
