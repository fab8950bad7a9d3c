// array.glsl - the method that hashing is measured against: a counter per class of leaves, and the whole
// expression for each interval (Lefebvre, IceSL: A GPU accelerated CSG modeler and slicer, 2013).
//
// Built with ARRAY, and with VALUES and NODES as room for the classes and the nodes over them.
#ifdef ARRAY
#ifndef VALUES
#define VALUES 1
#define NODES 1
#endif
#define TRUTH_WORDS ((NODES + 31) / 32)

layout(std430, binding = BIND_NODES) readonly restrict buffer node_buffer
{
    // What nodes begin with, a bit each; their number; for each its class, how many members have to be
    // around, 0 for any, and how it joins; then the classes of leaves.
    uint nodes[];
};

uint inside[(VALUES + 1) / 2]; // counters of classes, two in a word

void count_leaf(uint leaf, uint by)
{
    uint which = nodes[TRUTH_WORDS + 1 + NODE_WORDS * nodes[TRUTH_WORDS] + leaf];
    uint shift = (which & 1) * 16, word = inside[which >> 1];
    inside[which >> 1] = word & ~(0xffffu << shift) | (((word >> shift) + by) & 0xffffu) << shift;
}

bool holds(uint which, uint members)
{
    uint number = inside[which >> 1] >> (which & 1) * 16 & 0xffffu;
    if (members != 0)
        return number == members;
    return number != 0 && number < 0x8000u; // below 0 in parts of a cluster
}

// Children come before their parents, and tell them what they are.
bool evaluate()
{
    uint truth[TRUTH_WORDS];
    for (int i = 0; i < TRUTH_WORDS; i++)
        truth[i] = nodes[i];
    bool value = false;
    uint number = nodes[TRUTH_WORDS];
    for (uint i = 0; i < number; i++) {
        uint at = TRUTH_WORDS + 1 + NODE_WORDS * i, which = nodes[at], join = nodes[at + 2];
        value = which != NODE_INNER ? holds(which, nodes[at + 1])
                                    : (truth[i >> 5] >> (i & 31) & 1) != 0;
        uint to = join >> 2, bit = 1u << (to & 31);
        if (value && (join & 3) == NODE_ADDS)
            truth[to >> 5] |= bit;
        else if (value ? (join & 3) == NODE_CUTS : (join & 3) == NODE_LIMITS)
            truth[to >> 5] &= ~bit;
    }
    return value;
}
#endif
