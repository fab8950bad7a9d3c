// reduce.comp.glsl - of all combinations missing in a square of rays, the one that goes on record.
//
// Section 4.1 of Zanni, Claux, Lefebvre 2018: two by two rays, then two by two of those, one that several
// miss goes before others, and lots decide among equals.
#include "shared.h"

layout(local_size_x = REDUCE_SIDE * REDUCE_SIDE) in;
#include "thread.glsl"

layout(std430, binding = BIND_FRAME) readonly restrict buffer frame_buffer
{
    frame_data frame;
};
layout(std430, binding = BIND_MISSED) readonly restrict buffer missed_buffer
{
    uint missed[]; // per pixel a number that stands for the combination, or 0
};
layout(std430, binding = BIND_PENDING) writeonly restrict buffer pending_buffer
{
    uint pending[]; // per square
};

struct cell {
    uint mark, times, pixel;
};
shared cell cells[REDUCE_SIDE * REDUCE_SIDE];

uint lot(cell c)
{
    uint h = (c.mark ^ c.pixel) * 0x9e3779b1u;
    return (h ^ h >> 15) * 0x85ebca77u;
}

bool goes_before(cell a, cell b)
{
    if (a.mark == 0 || b.mark == 0)
        return b.mark == 0;
    return a.times != b.times ? a.times > b.times : lot(a) < lot(b);
}

// Of four cells, from the first one of which the next row is `wide` cells away.
cell choose(uint first, uint wide)
{
    cell best = cell(0, 0, NO_PIXEL);
    for (uint i = 0; i < 4; i++) {
        cell c = cells[first + (i >> 1) * wide + (i & 1)];
        uint times = 0;
        for (uint k = 0; k < 4; k++) {
            cell other = cells[first + (k >> 1) * wide + (k & 1)];
            times += other.mark == c.mark ? other.times : 0;
        }
        c.times = times;
        if (c.mark != 0 && goes_before(c, best))
            best = c;
    }
    return best;
}

void main()
{
    uint n = gl_LocalInvocationID.x, square = group_number();
    uint columns = uint(frame.columns), wide = (columns + REDUCE_SIDE - 1) / REDUCE_SIDE;
    uint x = square % wide * REDUCE_SIDE + n % REDUCE_SIDE;
    uint y = square / wide * REDUCE_SIDE + n / REDUCE_SIDE, pixel = y * columns + x;
    uint mark = x < columns && y < uint(frame.rows) ? missed[pixel] : 0;
    cells[n] = cell(mark, uint(mark != 0), mark != 0 ? pixel : NO_PIXEL);
    for (uint side = REDUCE_SIDE / 2; side > 0; side /= 2) {
        cell best;
        barrier();
        if (n < side * side)
            best = choose(n / side * 4 * side + n % side * 2, 2 * side);
        barrier();
        if (n < side * side)
            cells[n] = best;
    }
    if (n == 0 && y < uint(frame.rows))
        pending[square] = cells[0].pixel;
}
