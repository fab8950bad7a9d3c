// text.c - lines of text as flat shapes: fontconfig chooses, HarfBuzz shapes, FreeType draws.
#include "type/text.h"
