// keys.h - the one table of what the mouse and the keys do: input obeys it, the cheat sheet shows
// it.
#pragma once
#include <stdint.h>

enum action {
    ACTION_NONE, // of rows that tell about the mouse
    ACTION_TOP,  // these in the order of the views in input.c
    ACTION_BOTTOM,
    ACTION_LEFT,
    ACTION_RIGHT,
    ACTION_FRONT,
    ACTION_BACK,
    ACTION_DIAGONAL,
    ACTION_VIEW_ALL,
    ACTION_RESET,
    ACTION_CENTRE,
    ACTION_ORTHOGRAPHIC,
    ACTION_ZOOM_IN,
    ACTION_ZOOM_OUT,
    ACTION_TURN_LEFT,
    ACTION_TURN_RIGHT,
    ACTION_TURN_UP,
    ACTION_TURN_DOWN,
    ACTION_LAST_OF_CAMERA = ACTION_TURN_DOWN, // the others are the viewer's
    ACTION_EDGES,
    ACTION_AXES,
    ACTION_CROSSHAIRS,
    ACTION_SCALES,
    ACTION_SCHEME,
    ACTION_RELOAD,  // as a preview
    ACTION_RENDER,  // as geometry
    ACTION_GIVE_UP, // what goes on
    ACTION_SAVE,
    ACTION_COPY_CAMERA,
    ACTION_PASTE_CAMERA,
    ACTION_HELP,
    ACTION_CONSOLE,
    ACTION_STATUS,
    ACTION_CUSTOMIZER,
    ACTION_FULL_SCREEN,
    ACTION_QUIT,
};

struct key_row {
    const char *group; // heading above the row; NULL: that of the row before
    const char *keys;  // as they are printed, ", " between
    const char *what;
    enum action action;
};
extern const struct key_row key_rows[];
extern const uint32_t key_row_count;

// What a key or a character means, by its name in the table. Modified letters are capitals.
enum action keys_find(const char *name);
