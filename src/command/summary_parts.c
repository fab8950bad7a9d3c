// summary_parts.c - the parts that a summary can have, by OpenSCAD's names.
#include "command/summary_parts.h"

#include "base/mem.h"
#include "command/flags.h"

bool summary_parse(uint32_t *parts, const char *names, struct error *err)
{
    static const struct flag_name all[] = {
        {"", SUMMARY_QUICK},           {"all", SUMMARY_ALL},       {"cache", SUMMARY_CACHE},
        {"time", SUMMARY_TIME},        {"camera", SUMMARY_CAMERA}, {"geometry", SUMMARY_GEOMETRY},
        {"bounding-box", SUMMARY_BOX}, {"area", SUMMARY_AREA},     {"volume", SUMMARY_VOLUME}};
    return flags_parse(parts, names, all, array_count(all), "summary", "some of " SUMMARY_NAMES,
                       err);
}
