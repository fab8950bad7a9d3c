// list.glsl - the crossings of a ray in order.

// Of a leaf that is left and entered at one depth, what leaves goes first.
bool goes_first(fragment a, fragment b)
{
    if (a.key != b.key)
        return a.key < b.key;
    uint p = a.leaf ^ FRAGMENT_LEAVES, q = b.leaf ^ FRAGMENT_LEAVES;
    return p != q ? p < q : a.triangle < b.triangle;
}

void sort()
{
    for (uint gap = size / 2; gap > 0; gap = gap == 2 ? 1 : uint(float(gap) / 2.2))
        for (uint i = gap; i < size; i++) {
            fragment f = at(i);
            uint to = i;
            for (; to >= gap && goes_first(f, at(to - gap)); to -= gap)
                fragments[first + to] = at(to - gap);
            fragments[first + to] = f;
        }
}

#include "winding.glsl"

// Takes out leaves that are entered and left at one depth: what is cut to nothing by the region of
// the leaf or by the near plane, and meshes that touch themselves.
void drop_nothings()
{
    uint kept = 0;
    for (uint i = 0; i < size; i++) {
        fragment f = at(i);
        if (kept > 0 && f.key == at(kept - 1).key &&
            (f.leaf | FRAGMENT_LEAVES) == at(kept - 1).leaf && f.leaf != at(kept - 1).leaf)
            kept--;
        else
            fragments[first + kept++] = f;
    }
    for (uint i = kept; i < size; i++)
        fragments[first + i].key = BEYOND;
}
