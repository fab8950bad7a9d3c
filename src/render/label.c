// label.c - the name of a view, written into a corner of its picture.
#include "render/label.h"

#include <string.h>

enum { ROWS = 9, COLUMNS = 5, ADVANCE = COLUMNS + 1, MARGIN = 4 };
enum { SIDE = 250 }; // pixels of a picture for each pixel of a letter's dots

// The lowest two rows are below the line.
static const char *const letters['t' - 'a' + 1][ROWS] = {
    ['a' - 'a'] = {".....", ".....", ".###.", "....#", ".####", "#...#", ".####", ".....", "....."},
    ['b' - 'a'] = {"#....", "#....", "####.", "#...#", "#...#", "#...#", "####.", ".....", "....."},
    ['c' - 'a'] = {".....", ".....", ".###.", "#....", "#....", "#....", ".###.", ".....", "....."},
    ['d' - 'a'] = {"....#", "....#", ".####", "#...#", "#...#", "#...#", ".####", ".....", "....."},
    ['e' - 'a'] = {".....", ".....", ".###.", "#...#", "#####", "#....", ".###.", ".....", "....."},
    ['f' - 'a'] = {"..##.", ".#...", "####.", ".#...", ".#...", ".#...", ".#...", ".....", "....."},
    ['g' - 'a'] = {".....", ".....", ".####", "#...#", "#...#", "#...#", ".####", "....#", ".###."},
    ['h' - 'a'] = {"#....", "#....", "####.", "#...#", "#...#", "#...#", "#...#", ".....", "....."},
    ['i' - 'a'] = {"..#..", ".....", ".##..", "..#..", "..#..", "..#..", ".###.", ".....", "....."},
    ['k' - 'a'] = {"#....", "#....", "#..#.", "#.#..", "##...", "#.#..", "#..#.", ".....", "....."},
    ['l' - 'a'] = {".##..", "..#..", "..#..", "..#..", "..#..", "..#..", ".###.", ".....", "....."},
    ['m' - 'a'] = {".....", ".....", "##.#.", "#.#.#", "#.#.#", "#.#.#", "#.#.#", ".....", "....."},
    ['n' - 'a'] = {".....", ".....", "####.", "#...#", "#...#", "#...#", "#...#", ".....", "....."},
    ['o' - 'a'] = {".....", ".....", ".###.", "#...#", "#...#", "#...#", ".###.", ".....", "....."},
    ['p' - 'a'] = {".....", ".....", "####.", "#...#", "#...#", "#...#", "####.", "#....", "#...."},
    ['r' - 'a'] = {".....", ".....", "#.##.", "##...", "#....", "#....", "#....", ".....", "....."},
    ['s' - 'a'] = {".....", ".....", ".####", "#....", ".###.", "....#", "####.", ".....", "....."},
    ['t' - 'a'] = {".#...", ".#...", "####.", ".#...", ".#...", ".#...", "..##.", ".....", "....."},
};

static void fill(const struct label_place *p, int x0, int y0, int size, struct rgb colour)
{
    const uint8_t bytes[4] = {colour.r, colour.g, colour.b, 255};
    for (int y = y0; y < y0 + size; y++)
        for (int x = x0; x < x0 + size; x++)
            memcpy(p->pixels + (size_t)y * p->stride + (size_t)(x * p->channels), bytes,
                   (size_t)p->channels);
}

void label_draw(const struct label_place *p, const char *name, struct rgb colour)
{
    int shorter = p->width < p->height ? p->width : p->height;
    int dot = shorter / SIDE > 1 ? shorter / SIDE : 1;
    int length = (int)strlen(name) * ADVANCE;
    if ((length + 2 * MARGIN) * dot > p->width || (ROWS + 2 * MARGIN) * dot > p->height)
        return;
    for (int i = 0; name[i]; i++) {
        if (name[i] < 'a' || name[i] > 't' || !letters[name[i] - 'a'][0])
            continue;
        for (int k = 0; k < ROWS * COLUMNS; k++)
            if (letters[name[i] - 'a'][k / COLUMNS][k % COLUMNS] == '#')
                fill(p, (MARGIN + i * ADVANCE + k % COLUMNS) * dot, (MARGIN + k / COLUMNS) * dot,
                     dot, colour);
    }
}
