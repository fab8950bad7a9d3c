// fragments.comp.glsl - the crossings of rays and leaves in one band and slab.
//
// Built with COUNT they are counted per pixel, with HISTOGRAM by their keys, with LINKED put into lists,
// else written to the places that the counts made.
// A thread takes one triangle; triangles that may cover many pixels are cut into pieces, which the
// build with PIECES takes, a work group each. All builds see the same crossings: what decides is
// exact or `precise`.
#include "triangle.glsl"

layout(local_size_x = GROUP_SIZE) in;
#include "thread.glsl"

layout(std430, binding = BIND_STARTS) readonly restrict buffer start_buffer
{
    uint starts[];
};
layout(std430, binding = BIND_LARGE) restrict buffer large_buffer
{
    uvec4 pieces[]; // leaf, triangle, part, x | y << 16 in pieces
};
layout(std430, binding = BIND_COUNTS) restrict buffer count_buffer
{
    uint counts[];
};
#ifdef LINKED
layout(std430, binding = BIND_LINKS) coherent restrict buffer link_buffer
{
    uint links[];
};
#else
layout(std430, binding = BIND_OFFSETS) readonly restrict buffer offset_buffer
{
    uint offsets[];
};
#endif
layout(std430, binding = BIND_FRAGMENTS) coherent restrict buffer fragment_buffer
{
    fragment fragments[];
};
layout(std430, binding = BIND_STATES) readonly restrict buffer state_buffer
{
    pixel_state states[];
};
layout(std430, binding = BIND_COUNTERS) restrict buffer counter_buffer
{
    counters count;
};

#include "crossings.glsl"

#ifdef HISTOGRAM
shared uint bins[BINS];
#endif

bool has_region(uint leaf)
{
    return frame.borders == 0 && leaves[leaf].flags >= LEAF_REGION;
}

// Keys of the ray where it enters and leaves the sides of the leaf's region that cut the leaf. A
// margin keeps the faces of leaves that only touch their region.
vec2 region_of(uint leaf, ivec2 pixel)
{
    vec2 keys = vec2(-3.4e38, 3.4e38);
    precise dvec3 shift = double(pixel.x) * vec(frame.step_x) + double(pixel.y) * vec(frame.step_y);
    bool parallel = frame.orthographic != 0;
    precise dvec3 origin = vec(frame.origin) + (parallel ? shift : dvec3(0));
    precise dvec3 direction = vec(frame.forward) + (parallel ? dvec3(0) : shift);
    for (uint side = 0; side < 6; side++) {
        if ((leaves[leaf].flags & LEAF_REGION << side) == 0)
            continue;
        uint axis = side / 2;
        bool high = (side & 1) != 0;
        double border = high ? leaves[leaf].roi_high[axis] + frame.margin :
                               leaves[leaf].roi_low[axis] - frame.margin;
        double to = border - origin[axis];
        double d = direction[axis], depth = to / d;
        bool along = abs(d) < 1e-13, behind = !parallel && !(depth > 0);
        if (along || behind) { // no crossing: all of the ray is on one side
            if (high == (along ? to < 0 : d > 0))
                keys = vec2(3.4e38, -3.4e38);
            continue;
        }
        float key = float(frame_key(depth));
        if (high == (d < 0))
            keys.x = max(keys.x, key);
        else
            keys.y = min(keys.y, key);
    }
    return keys;
}

// In perspective a ray begins at the eye, in what it leaves more often than it enters: each crossing
// of a leaf that reaches up to there has its counterpart at the start.
bool is_begun(uint leaf)
{
    return frame.orthographic == 0 && views[leaf].near <= frame.start;
}

void write(uint at, uint leaf, uint triangle, bool leaving, float key, float steep)
{
#if defined(HISTOGRAM)
    float bin = clamp((key - frame.bins_from) * frame.bins_each, 0, float(BINS - 1));
    atomicAdd(bins[min(uint(bin), BINS - 1)], 1);
#elif defined(COUNT)
    atomicAdd(counts[at], 1);
#elif defined(LINKED)
    if (count.fragments >= CROSSINGS_MOST) // too many to be counted
        return;
    uint number = atomicAdd(count.fragments, 1);
    if (number < frame.crossings_most) {
        fragments[number] = fragment(key, leaf << 1 | uint(leaving), triangle, steep);
        insert(at, first_cursor() + number);
    }
#else
    uint to = offsets[at] + atomicAdd(counts[at], 0xffffffffu) - 1;
    fragments[to] = fragment(key, leaf << 1 | uint(leaving), triangle, steep);
#endif
}

// A crossing of a leaf of which all of the ray must be known. One that may be a sheet has a spare
// fragment for the sheet's other side.
void put_winding(uint leaf, uint triangle, bool leaving, float key, float steep, uint at)
{
#ifndef HISTOGRAM // they are in every slab
    write(at, leaf, triangle | FRAGMENT_WINDING, leaving, key, steep);
    if ((leaves[leaf].flags & LEAF_OPEN) != 0 && !is_begun(leaf)) // else it closes
        write(at, leaf, triangle, false, BEYOND, 0);
#endif
}

void put(uint leaf, uint triangle, bool leaving, float key, float steep, ivec2 pixel)
{
    uint at = uint(pixel.y - frame.band) * uint(frame.columns) + uint(pixel.x - frame.column);
    bool later = frame.slab_first == 0;
    if (later && (states[at].flags & PIXEL_DONE) != 0)
        return;
    if ((leaves[leaf].flags & LEAF_WINDING) != 0) {
        put_winding(leaf, triangle, leaving, key, steep, at);
        return;
    }
    if (has_region(leaf)) {
        vec2 region = region_of(leaf, pixel);
        if (!(region.x < region.y))
            return;
        float moved = clamp(key, region.x, region.y);
        if (moved != key)
            triangle |= FRAGMENT_BORDER;
        key = moved;
    }
    if (key <= frame.start) { // cut open there
        triangle &= FRAGMENT_TRIANGLE;
        key = frame.start;
        steep = 1;
    }
    if (key <= frame.slab_end && !(later && key < states[at].resume))
        write(at, leaf, triangle, leaving, key, steep);
}

// The crossings of part `part` of a polygon with the rays of the pixels.
void draw(uint leaf, uint triangle, polygon p, int part, int way, pixel_range r, int step,
          ivec2 first)
{
    key_plane k = plane_of(leaf, triangle, r.left, r.top);
    // y runs down in the picture: counter-clockwise from outside is clockwise there
    bool leaving = way > 0 != (frame.mirrored != 0);
    bool begun = is_begun(leaf);
    for (int y = r.y0 + first.y; y <= r.y1; y += step)
        for (int x = r.x0 + first.x; x <= r.x1; x += step) {
            ivec2 pixel = ivec2(x, y);
            if (!crosses(p, part, way, pixel))
                continue;
            put(leaf, triangle, leaving, key_at(k, p, pixel), steep_at(k, pixel), pixel);
            if (begun)
                put(leaf, triangle, !leaving, frame.start, 1, pixel);
        }
}

#ifdef PIECES
void take()
{
    uint i = group_number();
    if (i >= min(count.large, frame.large_most))
        return;
    uvec4 piece = pieces[i];
    polygon p;
    polygon_of(piece.x, piece.y, p);
    pixel_range all = range_of(p), r = all;
    r.x0 = max(all.x0, int(piece.w & 0xffffu) * PIECE);
    r.y0 = max(all.y0, int(piece.w >> 16) * PIECE);
    r.x1 = min(all.x1, int(piece.w & 0xffffu) * PIECE + PIECE - 1);
    r.y1 = min(all.y1, int(piece.w >> 16) * PIECE + PIECE - 1);
    ivec2 first = ivec2(gl_LocalInvocationID.x & 7u, gl_LocalInvocationID.x >> 3);
    draw(piece.x, piece.y, p, int(piece.z), facing(p, int(piece.z)), r, 8, first);
}
#else
// The leaf of triangle number i of those drawn.
uint leaf_of(uint i)
{
    uint low = 0, high = frame.leaf_count;
    while (high - low > 1) {
        uint middle = (low + high) / 2;
        if (starts[middle] <= i)
            low = middle;
        else
            high = middle;
    }
    return low;
}

// Puts the pieces of a part on the list; what finds no room is counted.
void cut(uint leaf, uint triangle, int part, pixel_range r)
{
    int x0 = r.x0 / PIECE, y0 = r.y0 / PIECE, x1 = r.x1 / PIECE, y1 = r.y1 / PIECE;
    uint n = uint((x1 - x0 + 1) * (y1 - y0 + 1)), at = atomicAdd(count.large, n);
    if (at + n < at)
        count.wrapped = 1;
    if (at + n > frame.large_most || at + n < at)
        return;
    for (int y = y0; y <= y1; y++)
        for (int x = x0; x <= x1; x++)
            pieces[at++] = uvec4(leaf, triangle, part, uint(x) | uint(y) << 16);
}

void take()
{
    uint i = thread_number();
    if (i >= starts[frame.leaf_count])
        return;
    uint leaf = leaf_of(i);
    uint triangle = leaves[leaf].first_triangle + i - starts[leaf];
    polygon p;
    if (!polygon_of(leaf, triangle, p))
        return;
    if (p.low > frame.slab_end && !has_region(leaf) && !is_begun(leaf) &&
        (leaves[leaf].flags & LEAF_WINDING) == 0)
        return;
    pixel_range r = range_of(p);
    if (r.x0 > r.x1 || r.y0 > r.y1)
        return;
    bool small = (r.x1 - r.x0 + 1) * (r.y1 - r.y0 + 1) <= SMALL_PIXELS;
    for (int part = 1; part + 1 < p.count; part++) {
        int way = facing(p, part);
        if (way == 0)
            continue;
        if (small)
            draw(leaf, triangle, p, part, way, r, 1, ivec2(0));
#if defined(COUNT) || defined(LINKED)
        else
            cut(leaf, triangle, part, r);
#endif
    }
}
#endif

void main()
{
#ifdef HISTOGRAM
    for (uint i = gl_LocalInvocationID.x; i < BINS; i += GROUP_SIZE)
        bins[i] = 0;
    barrier();
    take();
    barrier();
    for (uint i = gl_LocalInvocationID.x; i < BINS; i += GROUP_SIZE)
        if (bins[i] != 0)
            atomicAdd(counts[i], bins[i]);
#else
    take();
#endif
}
