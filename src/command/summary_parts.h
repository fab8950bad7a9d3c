// summary_parts.h - the parts that a summary can have, by OpenSCAD's names.
#pragma once
#include "base/error.h"

// Bits of a set.
enum {
    SUMMARY_CACHE = 1,
    SUMMARY_TIME = 2,
    SUMMARY_CAMERA = 4,
    SUMMARY_GEOMETRY = 8,
    SUMMARY_BOX = 16,
    SUMMARY_AREA = 32,
    SUMMARY_VOLUME = 64,
    SUMMARY_MASS = 128, // by --density alone
    SUMMARY_MEASURED = SUMMARY_AREA | SUMMARY_VOLUME | SUMMARY_MASS,
    SUMMARY_QUICK = 31,
    SUMMARY_ALL = SUMMARY_QUICK | SUMMARY_AREA | SUMMARY_VOLUME,
};
#define SUMMARY_NAMES "all|cache|time|camera|geometry|bounding-box|area|volume"

// Adds the parts named between commas, of "" those that need no measuring.
bool summary_parse(uint32_t *parts, const char *names, struct error *err);
