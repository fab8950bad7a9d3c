// select.comp.glsl - how many triangles of each leaf are drawn into the band and slab.
#include "frame.glsl"
#include "exact.glsl"

layout(local_size_x = GROUP_SIZE) in;
#include "thread.glsl"

layout(std430, binding = BIND_VIEWS) readonly restrict buffer view_buffer
{
    leaf_view views[];
};
layout(std430, binding = BIND_COUNTS) writeonly restrict buffer count_buffer
{
    uint counts[];
};
layout(std430, binding = BIND_COUNTERS) readonly restrict buffer counter_buffer
{
    counters count;
};

void main()
{
    uint i = thread_number();
    if (i > frame.leaf_count)
        return;
    bool drawn = false;
    if (i < frame.leaf_count) {
        bool begun = views[i].near <= frame.start && (frame.slab_first != 0 ||
                                                      count.resume <= ordered(frame.start));
        bool all = begun || (leaves[i].flags & LEAF_WINDING) != 0;
        drawn = views[i].shows != 0 && views[i].y0 <= float(frame.band + frame.rows - 1) &&
                views[i].y1 >= float(frame.band) &&
                views[i].x0 <= float(frame.column + frame.columns - 1) &&
                views[i].x1 >= float(frame.column) &&
                (all || views[i].near <= frame.slab_end) &&
                (all || frame.slab_first != 0 || ordered(views[i].far) >= count.resume);
    }
    counts[i] = drawn ? leaves[i].triangle_count : 0;
}
