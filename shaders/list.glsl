// list.glsl - puts the crossings of a ray in order.
#ifdef LINKED
// They are, until keys change.
void sort()
{
    uint i = begin;
    links[pixel] = 0;
    while (i != 0) {
        uint other = links[i];
        insert(pixel, i);
        i = other;
    }
    begin = links[pixel];
}
#else
// Of Shell's sort: those that Ciura found, from 701 on times 2.25.
const uint gaps[] = uint[](17961u, 7983u, 3548u, 1577u, 701u, 301u, 132u, 57u, 23u, 10u, 4u, 1u);

void sort()
{
    for (int k = 0; k < gaps.length(); k++) {
        uint gap = gaps[k];
        for (uint i = gap; i < size; i++) {
            fragment f = at(i);
            uint to = i;
            for (; to >= gap && goes_first(f, at(to - gap)); to -= gap)
                fragments[first + to] = at(to - gap);
            fragments[first + to] = f;
        }
    }
}
#endif

#include "winding.glsl"

// Do they enter and leave one leaf at one depth? Those in order leave first.
bool is_nothing(fragment a, fragment b)
{
    return b.key == a.key && (b.leaf | FRAGMENT_LEAVES) == a.leaf && b.leaf != a.leaf;
}

// Takes out leaves that are entered and left at one depth: what is cut to nothing by the region of
// the leaf or by the near plane, and meshes that touch themselves.
#ifdef LINKED
void drop_nothings()
{
    uint last = pixel, before = pixel; // what is kept last; in front of crossings like it
    uint like = 0, kept = 0;
    for (uint i = begin; i != 0;) {
        fragment f = at(i);
        uint other = links[i];
        if (f.key == BEYOND)
            break;
        if (like > 0 && is_nothing(at(last), f)) {
            last = before;
            for (uint k = like -= 1; k > 0; k--)
                last = links[last];
            kept--;
        } else {
            bool again = like > 0 && at(last).key == f.key && at(last).leaf == f.leaf;
            before = again ? before : last;
            like = again ? like + 1 : 1;
            links[last] = i;
            last = i;
            kept++;
        }
        i = other;
    }
    links[last] = 0;
    begin = links[pixel];
#ifdef SPANS
    links[pixel_count() + pixel] = atomicAdd(links[2 * pixel_count()], kept / 2 + 1);
#endif
}
#else
void drop_nothings()
{
    uint kept = 0;
    for (uint i = 0; i < size; i++) {
        fragment f = at(i);
        if (kept > 0 && is_nothing(at(kept - 1), f))
            kept--;
        else
            fragments[first + kept++] = f;
    }
    for (uint i = kept; i < size; i++)
        fragments[first + i].key = BEYOND;
}
#endif

// Finds the crossings of the pixel, which are as they came if nothing has been walked yet.
void find_list(bool raw)
{
#ifdef LINKED
    first = -first_cursor();
    begin = links[pixel];
    size = 0;
#else
    first = offsets[pixel];
    begin = 0;
    size = offsets[pixel + 1] - first;
    if (raw)
        sort();
#endif
    if (raw) {
        if (frame.windings != 0 && settle_windings())
            sort();
        drop_nothings();
    }
#ifndef LINKED
    while (size > 0 && at(size - 1).key == BEYOND)
        size--;
#endif
}

// Where spans of the pixel stand: a ray of n crossings has n / 2 + 1 at most.
uint first_span()
{
#ifdef LINKED
    return links[pixel_count() + pixel];
#else
    return first / 2 + pixel;
#endif
}
