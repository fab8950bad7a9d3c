// keys.c - the one table of what the mouse and the keys do: input obeys it, the cheat sheet shows
// it.
#include "app/keys.h"

#include "base/mem.h"

#include <string.h>

// OpenSCAD's, as far as it has one; letters beside those with Ctrl.
const struct key_row key_rows[] = {
    {"Mouse", "left drag", "turn", ACTION_NONE},
    {NULL, "Shift + left drag", "roll", ACTION_NONE},
    {NULL, "right drag", "move", ACTION_NONE},
    {NULL, "middle drag", "move along the line of sight", ACTION_NONE},
    {NULL, "Shift + right drag", "zoom", ACTION_NONE},
    {NULL, "wheel", "zoom to the pointer", ACTION_NONE},
    {"View", "4, Ctrl+4", "from the top", ACTION_TOP},
    {NULL, "5, Ctrl+5", "from the bottom", ACTION_BOTTOM},
    {NULL, "6, Ctrl+6", "from the left", ACTION_LEFT},
    {NULL, "7, Ctrl+7", "from the right", ACTION_RIGHT},
    {NULL, "8, Ctrl+8", "from the front", ACTION_FRONT},
    {NULL, "9, Ctrl+9", "from the back", ACTION_BACK},
    {NULL, "0, Ctrl+0", "diagonal", ACTION_DIAGONAL},
    {NULL, "v, Ctrl+Shift+V", "view all", ACTION_VIEW_ALL},
    {NULL, "r, Ctrl+Alt+0", "reset view", ACTION_RESET},
    {NULL, "Ctrl+Shift+0", "centre", ACTION_CENTRE},
    {NULL, "o", "orthographic on and off", ACTION_ORTHOGRAPHIC},
    {NULL, "+, Ctrl+]", "zoom in", ACTION_ZOOM_IN},
    {NULL, "-, Ctrl+[", "zoom out", ACTION_ZOOM_OUT},
    {NULL, "Left", "turn left", ACTION_TURN_LEFT},
    {NULL, "Right", "turn right", ACTION_TURN_RIGHT},
    {NULL, "Up", "turn up", ACTION_TURN_UP},
    {NULL, "Down", "turn down", ACTION_TURN_DOWN},
    {"Show", "e, Ctrl+1", "edges", ACTION_EDGES},
    {NULL, "a, Ctrl+2", "axes", ACTION_AXES},
    {NULL, "x, Ctrl+3", "crosshairs", ACTION_CROSSHAIRS},
    {NULL, "s", "scales on the axes", ACTION_SCALES},
    {NULL, "k", "next colour scheme", ACTION_SCHEME},
    {"File", "F5", "load again, as a preview", ACTION_RELOAD},
    {NULL, "F6", "load as --render does, $preview false", ACTION_RENDER},
    {NULL, "Escape", "give up what goes on", ACTION_GIVE_UP},
    {NULL, "p", "save the picture as PNG", ACTION_SAVE},
    {NULL, "c", "copy the camera as --camera", ACTION_COPY_CAMERA},
    {NULL, "Ctrl+V", "paste a camera", ACTION_PASTE_CAMERA},
    {"Window", "h, ?, F1", "this sheet", ACTION_HELP},
    {NULL, "m", "messages", ACTION_CONSOLE},
    {NULL, "u", "customizer", ACTION_CUSTOMIZER},
    {NULL, "i", "status line", ACTION_STATUS},
    {NULL, "f, F11", "full screen", ACTION_FULL_SCREEN},
    {NULL, "q, Ctrl+Q", "quit", ACTION_QUIT},
};
const uint32_t key_row_count = array_count(key_rows);

enum action keys_find(const char *name)
{
    size_t length = strlen(name);
    for (uint32_t i = 0; i < key_row_count; i++) {
        const char *keys = key_rows[i].keys;
        while (keys && key_rows[i].action != ACTION_NONE) {
            const char *next = strstr(keys, ", ");
            size_t n = next ? (size_t)(next - keys) : strlen(keys);
            if (n == length && memcmp(keys, name, n) == 0)
                return key_rows[i].action;
            keys = next ? next + 2 : NULL;
        }
    }
    return ACTION_NONE;
}
