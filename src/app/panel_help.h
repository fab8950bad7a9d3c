// panel_help.h - the cheat sheet: the table of keys.
#pragma once
#include "app/gui.h"

void panel_help_draw(const struct gui_box *box, bool *open);
