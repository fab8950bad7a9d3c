// scan.comp.glsl - prefix sums: output[i] = sum of input[0 .. i), block by block.
//
// Sums saturate: what does not fit into 32 bits reads as the largest number. Built with IN_PLACE the
// output is the input; with ADD the sums of the blocks before are added.
#include "shared.h"

layout(local_size_x = SCAN_GROUP) in;
#include "thread.glsl"

layout(std430, binding = BIND_SCAN_OUT) buffer output_buffer
{
    uint sums[];
};
#ifdef ADD
layout(std430, binding = BIND_SCAN_SUMS) readonly buffer block_buffer
{
    uint blocks[];
};
#else
layout(std430, binding = BIND_SCAN_IN) readonly buffer input_buffer
{
    uint numbers[];
};
#ifdef IN_PLACE
#define numbers sums
#endif
layout(std430, binding = BIND_SCAN_SUMS) writeonly buffer block_buffer
{
    uint blocks[];
};
shared uint partial[SCAN_GROUP];
#endif

uint plus(uint a, uint b)
{
    uint carry, sum = uaddCarry(a, b, carry);
    return carry != 0 ? 0xffffffffu : sum;
}

void main()
{
    const uint each = SCAN_BLOCK / SCAN_GROUP;
    uint block = group_number(), me = gl_LocalInvocationID.x, n = sums.length();
    uint first = block * SCAN_BLOCK + me * each;
#ifdef ADD
    uint before = block * SCAN_BLOCK < n ? blocks[block] : 0;
    for (uint i = first; i < first + each && i < n; i++)
        sums[i] = plus(sums[i], before);
#else
    uint sum = 0;
    for (uint i = first; i < first + each && i < n; i++)
        sum = plus(sum, numbers[i]);
    partial[me] = sum;
    barrier();
    for (uint step = 1; step < SCAN_GROUP; step *= 2) {
        uint other = me >= step ? partial[me - step] : 0;
        barrier();
        partial[me] = plus(partial[me], other);
        barrier();
    }
    uint before = me > 0 ? partial[me - 1] : 0;
    for (uint i = first; i < first + each && i < n; i++) {
        uint number = numbers[i];
        sums[i] = before;
        before = plus(before, number);
    }
    if (me == SCAN_GROUP - 1 && block * SCAN_BLOCK < n)
        blocks[block] = before;
#endif
}
