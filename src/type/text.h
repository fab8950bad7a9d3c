// text.h - lines of text as flat shapes: fontconfig chooses, HarfBuzz shapes, FreeType draws.
#pragma once
#include "base/error.h"
#include "geom/outline.h"
#include "geom/primitives.h"

// Arguments of text(); NULL or "" is the default.
struct text_line {
    const char *text, *font, *direction, *language, *script, *halign, *valign;
    double size, spacing;
    struct detail detail;
};

// Clean. Says in `messages` what it does not know; `place` is of the node. Thread-safe.
bool text_outline(struct outline *out, const struct text_line *line, struct place place,
                  struct messages *messages);
