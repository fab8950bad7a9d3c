// resolve.comp.glsl - the classification walk: a thread takes the crossings of a ray in order.
//
// Algorithms 1 and 3 of Zanni, Claux, Lefebvre 2018, with the filter and the rule of owners of
// src/render/cpu/walk.c: the same picture, crossing by crossing. Built with SPANS all solid
// intervals are written, else the first surface. A ray that meets an unknown combination puts it on
// record, goes on to record what follows, and is walked again when the table knows more. Built with
// ARRAY no combination is unknown (array.glsl). Built with OVER_FRAMES what is unknown counts as empty,
// and the first such combination of each ray is marked; its state waits until some rays have put theirs on
// record, and is carried into the next slab by a walk built with CARRY besides.
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
#ifdef LINKED
layout(std430, binding = BIND_LINKS) restrict buffer link_buffer
{
    uint links[];
};
#else
layout(std430, binding = BIND_OFFSETS) readonly restrict buffer offset_buffer
{
    uint offsets[];
};
#endif
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
uint pixel;              // of the band
uint first, begin, size; // its fragments are at(begin) and so on, up to `size`
bool unknown;            // it met an unknown combination
uint missing = 0;        // OVER_FRAMES: stands for the first of them
uvec2 before;            // the key in front of the cluster [from, to)
uint from, to;
float resume; // what is nearer is done with

fragment at(uint i)
{
    return fragments[first + i];
}

#include "crossings.glsl"

uvec2 step_of(fragment f)
{
    uvec2 value = values[f.leaf >> 1].xy;
    return (f.leaf & FRAGMENT_LEAVES) != 0 ? key_negative(value) : value;
}

#include "list.glsl"
#include "combination.glsl"
#include "cluster.glsl"

float depth_of(float key)
{
    if (frame.orthographic == 0)
        key = key / (1 - key * frame.to_depth);
    return key + frame.shift;
}

boundary boundary_of(fragment f)
{
    if ((f.leaf & FRAGMENT_LEAVES) != 0 && f.key >= frame.end)
        return boundary(frame.end, SURFACE_NO_LEAF, SURFACE_CAP_FACE);
    bool cap = f.key <= frame.start || (f.triangle & FRAGMENT_BORDER) != 0;
    uint face = cap ? SURFACE_CAP_FACE : faces[f.triangle & FRAGMENT_TRIANGLE];
    return boundary(f.key, f.leaf >> 1, face);
}

#ifdef SPANS
uint written; // spans

void put_span(boundary enter, boundary leave)
{
    spans[first_span() + written++] =
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

// Is the state to stay as it is?
bool waits()
{
#if defined(OVER_FRAMES) && !defined(CARRY)
    return missing != 0;
#else
    return unknown;
#endif
}

// Puts what is left of the ray into its state.
void carry(uint end)
{
    pixel_state s;
    s.key[0] = before.x;
    s.key[1] = before.y;
    s.resume = from != end ? at(from).key : frame.slab_end;
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
    return key != uvec2(0) && from != to && !thick(at(from), fragment(frame.end, 0, 0, 1));
}

// Does a cluster begin at crossing i? All crossings at one depth belong to one cluster: the steepest
// face there decides.
bool begins(uint i)
{
    bool off = false;
    for (float key = at(i).key; !off && i != size && at(i).key == key; i = next(i))
        off = thick(at(from), at(i));
    return off;
}

// Takes the crossings up to the end of the slab. True: the first surface was met.
bool walk(uvec2 key)
{
    uint ahead = 0, i = begin;
#ifdef ARRAY
    for (int k = 0; k < inside.length(); k++)
        inside[k] = 0;
#endif
    from = begin;
    before = key;
    float last_key = BEYOND;
    for (;; i = next(i)) {
        // Behind the crossings of the slab others may follow, further away than its end.
        bool over = i == size || ahead >= frame.ahead;
        fragment f = fragment(frame.slab_end, 0, 0, 0);
        if (!over)
            f = at(i);
        else if (frame.slab_last == 0 && (unknown || i != size))
            break;
        bool last = over && frame.slab_last != 0;
        if (last || (i != from && (over ? thick(at(from), f) : f.key > last_key && begins(i)))) {
            to = i;
            bool now = is_solid(key, SUBSET_ALL, 0);
            if (last && now && ends_thin(key)) // nothing begins there any more
                now = solid;
            if (!unknown && now != solid && change(now))
                return true;
            ahead += uint(unknown);
#ifdef ARRAY
            count_subset(SUBSET_ALL, 0, 1);
#endif
            from = i;
            before = key;
        }
        if (over)
            break;
        last_key = f.key;
        key = key_add(key, step_of(f));
    }
    if (frame.slab_last != 0) {
        if (!unknown)
            finish();
    } else if (!waits()) {
        carry(i);
    }
    return false;
}

void main()
{
    uint i = thread_number();
    uint pixels = uint(frame.columns) * uint(frame.rows);
    if (i >= (frame.pending != 0 ? frame.pending : pixels))
        return;
    pixel = frame.pending != 0 ? pending[i] : i;
    if (pixel == NO_PIXEL)
        return;
    pixel_state s = pixel_state(uint[2](0, 0), 0, 0, 0, SURFACE_NO_LEAF, SURFACE_CAP_FACE);
    if (frame.slab_first == 0)
        s = states[pixel];
#ifdef CARRY
    if ((states[pixel].flags & PIXEL_MISSED) == 0)
        return;
#elif defined(OVER_FRAMES)
    missed[pixel] = 0;
#endif
    if ((s.flags & PIXEL_DONE) != 0)
        return;
    resume = frame.slab_first != 0 ? -BEYOND : s.resume;
#ifdef CARRY
    find_list(false);
#else
    find_list(frame.pending == 0);
#endif

    unknown = false;
    uvec2 key = uvec2(s.key[0], s.key[1]);
    solid = (s.flags & PIXEL_SOLID) != 0;
    entered = boundary(s.entered_key, s.entered_leaf, s.entered_face);
#ifdef SPANS
    written = 0;
    walk(key);
#else
    bool found = walk(key);
    if (found && !waits())
        states[pixel].flags = PIXEL_DONE;
    else if (!found && !unknown && frame.slab_last != 0)
        put_surface(boundary(0, SURFACE_NO_LEAF, SURFACE_CAP_FACE));
#endif
#if defined(OVER_FRAMES) && !defined(CARRY)
    if (missing == 0)
        return;
    missed[pixel] = missing;
    s.flags |= PIXEL_MISSED;
    states[pixel] = s;
    atomicAdd(count.missed, 1);
#else
    if (unknown)
        missed[atomicAdd(count.missed, 1)] = pixel;
#endif
}
