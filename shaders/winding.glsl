// winding.glsl - crossings of meshes that may be open, inside out or both, on one ray.
//
// As make_intervals in src/render/cpu/mesh.c: inside is where the winding number is not 0, and of
// what never closes only the faces are there. All crossings of the ray are needed, whatever the slab.

int turn_of(fragment f)
{
    return (f.leaf & FRAGMENT_LEAVES) != 0 ? -1 : 1;
}

// Where a face that is just thick enough to exist ends.
float sheet_end(fragment f)
{
    float growth = frame.orthographic != 0 ? 1 : 1 - f.key / float(frame.t0);
    float width = 2 * float(frame.epsilon) * growth * growth / max(f.steep, float(STEEP_LEAST));
    return f.key + max(width, abs(f.key) * 1.2e-7); // another number than the key
}

bool in_range(float key)
{
    return key > frame.start && key >= resume && key <= frame.slab_end;
}

// Puts a settled crossing where it counts in this slab.
void put_settled(uint i, fragment f)
{
    if (f.key <= frame.start) { // cut open there
        f.key = frame.start;
        f.steep = 1;
    }
    if (f.key < resume || f.key > frame.slab_end)
        f.key = BEYOND;
    fragments[first + i] = f;
}

// Leaves the crossings of a leaf from `from` to `to` that lead from or to the winding number 0; the
// others go BEYOND. From `open` on they are sheets, which end in the fragments from `spare` on.
void rebuild(uint from, uint to, uint open, inout uint spare)
{
    uint leaf = at(from).leaf >> 1, back = from;
    bool closed = true;
    float last = -BEYOND; // end of the sheet before
    int winding = 0;
    for (uint i = from; i != to; i = next(i)) {
        fragment f = at(i);
        closed = closed && i != open;
        if (f.leaf >> 1 != leaf)
            continue;
        bool outside = winding == 0;
        winding += turn_of(f);
        f.leaf = leaf << 1 | uint(closed && winding == 0);
        if (closed) {
            if (!outside && winding != 0)
                f.key = BEYOND;
            put_settled(i, f);
            continue;
        }
        fragment other = f;
        other.leaf |= FRAGMENT_LEAVES;
        other.key = sheet_end(f);
        bool joined = last >= f.key; // sheets that touch are one
        if (!joined && spare != size) {
            back = spare;
            spare = next(spare);
        } else {
            f.key = BEYOND;
        }
        put_settled(i, f);
        if (back != from)
            put_settled(back, other);
        last = other.key;
    }
}

// Settles the crossings of the leaf that begin at `from`. True: they have changed.
bool settle(uint from, uint to, inout uint spare)
{
    uint leaf = at(from).leaf >> 1, open = from; // behind what leads back to 0 for good
    int winding = 0;
    bool simple = true;
    for (uint i = from; i != to; i = next(i)) {
        fragment f = at(i);
        if (f.leaf >> 1 != leaf)
            continue;
        fragments[first + i].triangle = f.triangle & ~FRAGMENT_WINDING;
        winding += turn_of(f);
        simple = simple && (winding == 0 || winding == 1) && in_range(f.key);
        if (winding == 0)
            open = next(i);
    }
    if (winding != 0 && frame.slab_first != 0)
        atomicAdd(count.open, 1);
    if (simple && winding == 0)
        return false;
    rebuild(from, to, open, spare);
    return true;
}

// Of sorted crossings. True: they must be sorted again.
bool settle_windings()
{
    uint to = begin;
    bool changed = false;
    while (to != size && at(to).key != BEYOND)
        to = next(to);
    uint spare = to;
    for (uint i = begin; i != to; i = next(i))
        if ((at(i).triangle & FRAGMENT_WINDING) != 0)
            changed = settle(i, to, spare) || changed;
    return changed;
}
