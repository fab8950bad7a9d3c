// frame.glsl - the frame and its leaves, as every pass that draws sees them.
#include "shared.h"

layout(std430, binding = BIND_FRAME) readonly restrict buffer frame_buffer
{
    frame_data frame;
};
layout(std430, binding = BIND_LEAVES) readonly restrict buffer leaf_buffer
{
    leaf_data leaves[];
};

dvec3 vec(double a[3])
{
    return dvec3(a[0], a[1], a[2]);
}

double frame_key(double depth)
{
    precise double key = frame.orthographic != 0 ? depth - frame.t0
                                                 : frame.t0 - frame.t0 * frame.t0 / depth;
    return key;
}
