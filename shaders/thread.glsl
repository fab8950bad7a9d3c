// thread.glsl - the number of a thread in a dispatch of one or two dimensions.
uint group_number()
{
    return gl_WorkGroupID.y * GROUPS_WIDE + gl_WorkGroupID.x;
}

uint thread_number()
{
    return group_number() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
}
