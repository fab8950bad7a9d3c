// resolve.comp.glsl - the classification walk: a thread takes the crossings of a ray in order.
//
// Algorithms 1 and 3 of Zanni, Claux, Lefebvre 2018, with the filter and the rule of owners of
// src/render/cpu/walk.c: the same picture, crossing by crossing. Built with SPANS all solid
// intervals are written, else the first surface. A ray that meets an unknown combination puts it on
// record, goes on to record what follows, and is walked again when the table knows more. Built with
// ARRAY no combination is unknown (array.glsl).
#include "frame.glsl"
#include "exact.glsl"
#include "table.glsl"
#include "array.glsl"

layout(local_size_x = GROUP_SIZE) in;
#include "thread.glsl"

layout(std430, binding = BIND_VALUES) readonly restrict buffer value_buffer
{
    uvec4 values[]; // of leaves: value, class, flags
};
layout(std430, binding = BIND_PENDING) readonly restrict buffer pending_buffer
{
    uint pending[];
};
layout(std430, binding = BIND_MISSED) writeonly restrict buffer missed_buffer
{
    uint missed[];
};
layout(std430, binding = BIND_MISSES) writeonly restrict buffer miss_buffer
{
    uint misses[];
};
layout(std430, binding = BIND_CLAIMS) restrict buffer claim_buffer
{
    uint claims[];
};
layout(std430, binding = BIND_PLANES) readonly restrict buffer plane_buffer
{
    double planes[];
};
layout(std430, binding = BIND_FACES) readonly restrict buffer face_buffer
{
    uint faces[];
};
layout(std430, binding = BIND_OFFSETS) readonly restrict buffer offset_buffer
{
    uint offsets[];
};
layout(std430, binding = BIND_FRAGMENTS) restrict buffer fragment_buffer
{
    fragment fragments[];
};
layout(std430, binding = BIND_STATES) restrict buffer state_buffer
{
    pixel_state states[];
};
layout(std430, binding = BIND_COUNTERS) restrict buffer counter_buffer
{
    counters count;
};
#ifdef SPANS
layout(std430, binding = BIND_OUTPUT) writeonly restrict buffer output_buffer
{
    span_data spans[];
};
layout(std430, binding = BIND_SPANS) writeonly restrict buffer span_buffer
{
    uint span_counts[];
};
#else
layout(std430, binding = BIND_OUTPUT) writeonly restrict buffer output_buffer
{
    uint surfaces[]; // planes of depth, leaf and face
};
#endif

struct boundary {
    float key;
    uint leaf, face;
};

// The ray of this thread.
uint pixel;       // of the band
uint first, size; // its fragments
bool unknown;     // it met an unknown combination
uvec2 before;     // the key in front of the cluster [from, to)
uint from, to;
float resume; // what is nearer is done with

fragment at(uint i)
{
    return fragments[first + i];
}

uvec2 step_of(fragment f)
{
    uvec2 value = values[f.leaf >> 1].xy;
    return (f.leaf & FRAGMENT_LEAVES) != 0 ? key_negative(value) : value;
}

// ------------------------------------------------------------------------------------------ sorting

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

// ------------------------------------------------------------------------------------- combinations

// Parts of the cluster.
#define SUBSET_ALL    0
#define SUBSET_PREFIX 1 // the crossings up to c
#define SUBSET_REST   2 // all but c
#define SUBSET_ALONE  3 // c alone
#define SUBSET_ENTER  4 // those that enter

bool is_border(uint i)
{
    return (at(i).triangle & FRAGMENT_BORDER) != 0;
}

// A leaf that only crosses the border of its region is inside on both sides in truth.
bool in_subset(int subset, uint i, uint c)
{
    if (subset == SUBSET_ALL)
        return true;
    if (subset == SUBSET_ENTER || is_border(i))
        return (at(i).leaf & FRAGMENT_LEAVES) == 0;
    return subset == SUBSET_PREFIX ? i <= c : (i == c) == (subset == SUBSET_ALONE);
}

// Is this the first thread to record the combination?
bool claim(uvec2 key)
{
    uint mark = (key.x * 0x9e3779b1u ^ key.y * 0x85ebca77u) | 1u;
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
    for (uint i = from; i < to; i++)
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
    for (uint i = from; i < to; i++)
        if (in_subset(subset, i, c))
            misses[start++] = at(i).leaf;
}

#ifdef ARRAY
// Crossings of the cluster come or, by -1, go.
void count_subset(int subset, uint c, int by)
{
    for (uint i = from; i < to; i++)
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
        unknown = true;
        record(key, subset, c);
    }
    return state == SET_SOLID;
}
#endif

uvec2 sum_of(int subset, uint c)
{
    uvec2 sum = before;
    for (uint i = from; i < to; i++)
        if (in_subset(subset, i, c))
            sum = key_add(sum, step_of(at(i)));
    return sum;
}

bool solid_with(int subset, uint c)
{
    return is_solid(sum_of(subset, c), subset, c);
}

// ------------------------------------------------------------------------------------------ clusters

// Is the interval between two crossings thick enough to exist?
bool thick(fragment a, fragment b)
{
    if (a.key >= b.key)
        return false;
    double steep = double(max(max(a.steep, b.steep), float(STEEP_LEAST)));
    double gap = double(b.key) - double(a.key);
    if (frame.orthographic == 0) {
        double p = frame.t0 - double(a.key), q = frame.t0 - double(b.key);
        if (!(q > 0))
            return true;
        gap *= frame.t0 * frame.t0 / (p * q);
    }
    return gap * steep >= frame.epsilon;
}

// Does the leaf of crossing c also cross the other way in the cluster? It is too thin to show.
bool is_paired(uint c)
{
    uint other = at(c).leaf ^ FRAGMENT_LEAVES;
    for (uint i = from; i < to; i++)
        if (at(i).leaf == other)
            return true;
    return false;
}

vec3 normal_of(fragment f)
{
    if (f.key <= frame.start)
        return vec3(0);
    uint t = 4 * (f.triangle & FRAGMENT_TRIANGLE), l = f.leaf >> 1;
    dvec3 n = dvec3(planes[t], planes[t + 1], planes[t + 2]);
    vec3 w = vec3(leaves[l].to_local[0] * n.x + leaves[l].to_local[4] * n.y +
                      leaves[l].to_local[8] * n.z,
                  leaves[l].to_local[1] * n.x + leaves[l].to_local[5] * n.y +
                      leaves[l].to_local[9] * n.z,
                  leaves[l].to_local[2] * n.x + leaves[l].to_local[6] * n.y +
                      leaves[l].to_local[10] * n.z);
    return normalize(w);
}

bool coplanar(fragment a, fragment b)
{
    return length(cross(normal_of(a), normal_of(b))) < 1e-4;
}

void mark_turn(uint i, bool turns)
{
    uint t = fragments[first + i].triangle;
    fragments[first + i].triangle = turns ? t | FRAGMENT_TURN : t & ~FRAGMENT_TURN;
}

bool is_turn(uint i)
{
    return (fragments[first + i].triangle & FRAGMENT_TURN) != 0;
}

// Takes away the two neighbouring turns that are nearest to each other.
void drop_turns()
{
    uint last = to, best = to, best_next = to;
    float least = 3.4e38;
    for (uint i = from; i < to; i++) {
        if (!is_turn(i))
            continue;
        if (last != to && at(i).key - at(last).key <= least) {
            least = at(i).key - at(last).key;
            best = last;
            best_next = i;
        }
        last = i;
    }
    mark_turn(best, false);
    mark_turn(best_next, false);
}

// Marks the crossings that turn the state, which is `solid` behind the cluster, when they are taken
// one by one. Returns how many; 0 when the last of them leaves it otherwise.
uint find_turns(bool solid)
{
    uvec2 key = before;
    bool now = !solid;
    uint turns = 0;
    for (uint i = from; i < to; i++)
        if (is_border(i) && in_subset(SUBSET_PREFIX, i, 0))
            key = key_add(key, step_of(at(i)));
    for (uint i = from; i < to; i++) {
        mark_turn(i, false);
        if (is_border(i))
            continue;
        key = key_add(key, step_of(at(i)));
        bool turned = is_solid(key, SUBSET_PREFIX, i) != now;
        mark_turn(i, turned);
        now = now != turned;
        turns += uint(turned);
    }
    return now == solid ? turns : 0;
}

// Would the state be another one without crossing i, or is it the same with it alone?
bool matters(uint i, bool solid)
{
    return solid_with(SUBSET_REST, i) != solid || solid_with(SUBSET_ALONE, i) == solid;
}

// Of the crossings of the cluster that make the state `solid`, the one that does: taken one by one
// they may turn it several times, for there are thin intervals between. The thinnest go first, and
// one that does not matter gives way to one that does.
uint turning_point(bool solid)
{
    uint most = find_turns(solid), found = from;
    if (most == 0)
        return to;
    for (uint turns = most; turns > 1; turns -= 2)
        drop_turns();
    while (!is_turn(found))
        found++;
    if (most == 1 || matters(found, solid))
        return found;
    find_turns(solid);
    bool makes = true;
    for (uint i = from; i < to; i++) {
        if (!is_turn(i))
            continue;
        if (makes && matters(i, solid))
            return i;
        makes = !makes;
    }
    return found;
}

// Whether the leaf of crossing i shows rather than that of `best`, where the place wants leaves of
// the given kind; 2 for any.
bool shows_before(uint i, uint best, uint cut)
{
    uint a = at(i).leaf >> 1, b = at(best).leaf >> 1;
    bool wanted = uint((values[a].w & LEAF_SUBTRACTED) != 0) == cut;
    bool has = uint((values[b].w & LEAF_SUBTRACTED) != 0) == cut;
    return cut == 2 || wanted == has ? a > b : wanted;
}

// Of the crossings at one place, the one whose surface shows there: cluster_owner in cluster.c.
uint owner_of(bool solid)
{
    if (to - from == 1)
        return from;
    uint turning = turning_point(solid);
    if (turning == to)
        return from;
    uint best = turning;
    bool weak = is_paired(turning) || !matters(turning, solid);
    uint cut = frame.borders != 0 ? uint(!solid_with(SUBSET_ENTER, 0)) : 2;
    for (uint i = from; i < to; i++) {
        if (i == turning || (!weak && !shows_before(i, best, cut)) || is_border(i) ||
            is_paired(i))
            continue;
        if (at(i).key != at(turning).key && !coplanar(at(i), at(turning)))
            continue;
        if (!matters(i, solid))
            continue;
        best = i;
        weak = false;
    }
    return best;
}

// ---------------------------------------------------------------------------------------------- walk

float depth_of(float key)
{
    if (frame.orthographic == 0)
        key = key / (1 - key * frame.to_depth);
    return key + frame.shift;
}

boundary boundary_of(fragment f)
{
    bool cap = f.key <= frame.start || (f.triangle & FRAGMENT_BORDER) != 0;
    uint face = cap ? SURFACE_CAP_FACE : faces[f.triangle & FRAGMENT_TRIANGLE];
    return boundary(f.key, f.leaf >> 1, face);
}

#ifdef SPANS
uint written; // spans

void put_span(boundary enter, boundary leave)
{
    spans[first / 2 + pixel + written++] =
        span_data(depth_of(enter.key), depth_of(leave.key), enter.leaf, enter.face, leave.leaf,
                  leave.face);
}
#else
void put_surface(boundary b)
{
    uint n = uint(frame.columns) * uint(frame.rows);
    surfaces[pixel] = floatBitsToUint(b.leaf == SURFACE_NO_LEAF ? 1.0 / 0.0 : depth_of(b.key));
    surfaces[n + pixel] = b.leaf;
    surfaces[2 * n + pixel] = b.face;
}
#endif

bool solid;       // state in front of the cluster
boundary entered; // SPANS: where the open interval began

// The state changes at the cluster. True: the walk is over.
bool change(bool now)
{
    boundary b = boundary_of(at(owner_of(now)));
    if (unknown)
        return false;
    solid = now;
#ifdef SPANS
    if (now)
        entered = b;
    else
        put_span(entered, b);
    return false;
#else
    put_surface(b);
    return true;
#endif
}

// Puts what is left of the ray into its state.
void carry(uint end)
{
    pixel_state s;
    s.key[0] = before.x;
    s.key[1] = before.y;
    s.resume = from < end ? at(from).key : frame.slab_end;
    s.flags = solid ? PIXEL_SOLID : 0;
    s.entered_key = entered.key;
    s.entered_leaf = entered.leaf;
    s.entered_face = entered.face;
    states[pixel] = s;
#ifdef SPANS
    span_counts[pixel] = written;
#endif
    atomicAdd(count.alive, 1);
    atomicMin(count.resume, ordered(s.resume));
}

void finish()
{
#ifdef SPANS
    if (solid)
        put_span(entered, boundary(frame.end, SURFACE_NO_LEAF, SURFACE_CAP_FACE));
    span_counts[pixel] = written;
#endif
}

// Whatever the ray is in behind the last cluster ends where showing does. Is that thinner than
// what exists?
bool ends_thin(uvec2 key)
{
    key.y &= SECONDARY;
    return key != uvec2(0) && from < to && !thick(at(from), fragment(frame.end, 0, 0, 1));
}

// Takes the crossings up to the end of the slab. True: the first surface was met.
bool walk(uvec2 key)
{
    uint ahead = 0, i = 0;
#ifdef ARRAY
    for (int k = 0; k < inside.length(); k++)
        inside[k] = 0;
#endif
    from = 0;
    before = key;
    for (; i < size && ahead < frame.ahead; i++) {
        fragment f = at(i);
        if (i > from && thick(at(from), f)) {
            to = i;
            bool now = is_solid(key, SUBSET_ALL, 0);
            if (!unknown && now != solid && change(now))
                return true;
            ahead += uint(unknown);
#ifdef ARRAY
            count_subset(SUBSET_ALL, 0, 1);
#endif
            from = i;
            before = key;
        }
        key = key_add(key, step_of(f));
    }
    if (frame.slab_last == 0) {
        if (!unknown)
            carry(i);
        return false;
    }
    to = i;
    bool now = !ends_thin(key) && is_solid(key, SUBSET_ALL, 0);
    if (!unknown && now != solid && change(now))
        return true;
    if (!unknown)
        finish();
    return false;
}

void main()
{
    uint i = thread_number();
    uint pixels = uint(frame.columns) * uint(frame.rows);
    if (i >= (frame.pending != 0 ? frame.pending : pixels))
        return;
    pixel = frame.pending != 0 ? pending[i] : i;
    first = offsets[pixel];
    size = offsets[pixel + 1] - first;
    pixel_state s = pixel_state(uint[2](0, 0), 0, 0, 0, SURFACE_NO_LEAF, SURFACE_CAP_FACE);
    if (frame.slab_first == 0)
        s = states[pixel];
    if ((s.flags & PIXEL_DONE) != 0)
        return;
    resume = frame.slab_first != 0 ? -BEYOND : s.resume;
    if (frame.pending == 0) {
        sort();
        if (frame.windings != 0 && settle_windings())
            sort();
        drop_nothings();
    }
    while (size > 0 && at(size - 1).key == BEYOND)
        size--;

    unknown = false;
    uvec2 key = uvec2(s.key[0], s.key[1]);
    solid = (s.flags & PIXEL_SOLID) != 0;
    entered = boundary(s.entered_key, s.entered_leaf, s.entered_face);
#ifdef SPANS
    written = 0;
    walk(key);
#else
    if (walk(key))
        states[pixel].flags = PIXEL_DONE;
    else if (!unknown && frame.slab_last != 0)
        put_surface(boundary(0, SURFACE_NO_LEAF, SURFACE_CAP_FACE));
#endif
    if (unknown)
        missed[atomicAdd(count.missed, 1)] = pixel;
}
