// panel_status.h - the status line: what goes on, and what the last load and frame took.
#pragma once
#include "app/gui.h"
#include "app/panels.h"

void panel_status_draw(const struct panel_facts *facts, const struct gui_box *box);
