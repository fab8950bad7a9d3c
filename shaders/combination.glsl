// combination.glsl - is a set of solids around an interval solid? An unknown one is put on record, as
// a step from the one in front of the cluster.

// Parts of the cluster.
#define SUBSET_ALL    0
#define SUBSET_PREFIX 1 // the crossings up to c
#define SUBSET_REST   2 // all but those like c
#define SUBSET_ALONE  3 // those like c
#define SUBSET_ENTER  4 // those that enter
#define SUBSET_KEPT   5 // those that are not marked

bool is_border(uint i)
{
    return (at(i).triangle & FRAGMENT_BORDER) != 0;
}

uint like; // bits of fragment.leaf that crossings like another one have in common with it

// A mark on a crossing of the cluster: that it turns the state, or that it is left out.
bool is_marked(uint i)
{
    return (at(i).triangle & FRAGMENT_MARK) != 0;
}

void mark(uint i, bool marked)
{
    uint t = fragments[first + i].triangle;
    fragments[first + i].triangle = marked ? t | FRAGMENT_MARK : t & ~FRAGMENT_MARK;
}

// A leaf that only crosses the border of its region is inside on both sides in truth.
bool in_subset(int subset, uint i, uint c)
{
    if (subset == SUBSET_ALL)
        return true;
    if (subset == SUBSET_ENTER || is_border(i))
        return (at(i).leaf & FRAGMENT_LEAVES) == 0;
    if (subset == SUBSET_KEPT)
        return !is_marked(i);
    if (subset == SUBSET_PREFIX)
        return !goes_first(at(c), at(i));
    return (((at(i).leaf ^ at(c).leaf) & like) == 0) == (subset == SUBSET_ALONE);
}

// Never 0.
uint mark_of(uvec2 key)
{
    return (key.x * 0x9e3779b1u ^ (key.y & SECONDARY) * 0x85ebca77u) | 1u;
}

// Is this the first thread to record the combination?
bool claim(uvec2 key)
{
    uint mark = mark_of(key);
    uint found = atomicCompSwap(claims[(key.x ^ key.x >> 16) & frame.claim_mask], 0, mark);
    return found != mark;
}

// A record: key in front, key, number of crossings between, for each the leaf as in a fragment.
void record(uvec2 key, int subset, uint c)
{
    key.y &= SECONDARY;
    if (count.misses > frame.miss_most || !claim(key)) // full; or it is there
        return;
    uint n = 0;
    for (uint i = from; i != to; i = next(i))
        n += uint(in_subset(subset, i, c));
    uint words = 5 + n, start = atomicAdd(count.misses, words);
    if (start + words > frame.miss_most || start + words < start)
        return;
    misses[start] = before.x;
    misses[start + 1] = before.y & SECONDARY;
    misses[start + 2] = key.x;
    misses[start + 3] = key.y;
    misses[start + 4] = n;
    start += 5;
    for (uint i = from; i != to; i = next(i))
        if (in_subset(subset, i, c))
            misses[start++] = at(i).leaf;
}

#ifdef ARRAY
// Crossings of the cluster come or, by -1, go.
void count_subset(int subset, uint c, int by)
{
    for (uint i = from; i != to; i = next(i))
        if (in_subset(subset, i, c))
            count_leaf(at(i).leaf >> 1, uint((at(i).leaf & FRAGMENT_LEAVES) != 0 ? -by : by));
}

bool is_solid(uvec2 key, int subset, uint c)
{
    count_subset(subset, c, 1);
    bool state = evaluate();
    count_subset(subset, c, -1);
    return state;
}
#else
bool is_solid(uvec2 key, int subset, uint c)
{
    uint state = table_lookup(key);
    if (state == SET_UNKNOWN) {
#ifdef OVER_FRAMES
        missing = missing != 0 ? missing : mark_of(key);
#else
        unknown = true;
        record(key, subset, c);
#endif
    }
    return state == SET_SOLID;
}
#endif

uvec2 sum_of(int subset, uint c)
{
    uvec2 sum = before;
    for (uint i = from; i != to; i = next(i))
        if (in_subset(subset, i, c))
            sum = key_add(sum, step_of(at(i)));
    return sum;
}

bool solid_with(int subset, uint c)
{
    return is_solid(sum_of(subset, c), subset, c);
}
