// crossings.glsl - where the crossings of a ray stand, at cursors from `begin` to `size`.
//
// One behind the other, or built with LINKED in lists that are in order from the first insertion on
// (Lefebvre, Hornus, Lasram, Per-Pixel Lists for Single Pass A-Buffer, 2014). There a cursor is the
// index of a link: first come those of pixels to their first crossings, then where the spans of
// pixels are to stand, how many of these there are, and the links of crossings. 0 ends a list.

// Of a leaf that is left and entered at one depth, what leaves goes first.
bool goes_first(fragment a, fragment b)
{
    if (a.key != b.key)
        return a.key < b.key;
    uint p = a.leaf ^ FRAGMENT_LEAVES, q = b.leaf ^ FRAGMENT_LEAVES;
    return p != q ? p < q : (a.triangle & ~FRAGMENT_MARK) < (b.triangle & ~FRAGMENT_MARK);
}

#ifdef LINKED
uint pixel_count()
{
    return uint(frame.columns) * uint(frame.rows);
}

// Of the first crossing of all.
uint first_cursor()
{
    return 2 * pixel_count() + 1;
}

uint next(uint i)
{
    return links[i];
}

// Puts a crossing where it belongs in the list of a pixel, which others change at the same time:
// where a link has changed meanwhile, the search goes on.
void insert(uint pixel, uint i)
{
    fragment f = fragments[i - first_cursor()];
    uint last = pixel, other = links[last];
    for (;;) {
        while (other != 0 && goes_first(fragments[other - first_cursor()], f)) {
            last = other;
            other = links[last];
        }
        links[i] = other;
        memoryBarrierBuffer();
        uint found = atomicCompSwap(links[last], other, i);
        if (found == other)
            return;
        other = found;
    }
}
#else
uint next(uint i)
{
    return i + 1;
}
#endif
