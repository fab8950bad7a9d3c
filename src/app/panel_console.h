// panel_console.h - what openscad and the loading of the model have said.
#pragma once
#include "app/gui.h"
#include "app/panels.h"

void panel_console_draw(const struct panel_facts *facts, const struct gui_box *box, bool *open);
