// arguments.comp.glsl - the work groups of a dispatch, from a number that only the device knows.
#include "shared.h"

layout(local_size_x = 1) in;

#ifdef TRIANGLES
layout(std430, binding = BIND_STARTS) readonly restrict buffer start_buffer
{
    uint starts[];
};
#endif
layout(std430, binding = BIND_FRAME) readonly restrict buffer frame_buffer
{
    frame_data frame;
};
layout(std430, binding = BIND_COUNTERS) restrict buffer counter_buffer
{
    counters count;
};

void main()
{
#ifdef TRIANGLES
    uint last = starts[frame.leaf_count];
    uint groups = last / GROUP_SIZE + uint(last % GROUP_SIZE != 0);
#else
    uint groups = min(count.large, frame.large_most);
#endif
    count.groups[0] = min(groups, GROUPS_WIDE);
    count.groups[1] = (groups + GROUPS_WIDE - 1) / GROUPS_WIDE;
    count.groups[2] = 1;
}
