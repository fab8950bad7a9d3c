// array.glsl - the method that hashing is measured against: a counter per leaf, and the whole
// expression for each interval (Lefebvre, IceSL: A GPU accelerated CSG modeler and slicer, 2013).
//
// Built with ARRAY, and with LEAVES and NODES as room for those of the body.
#ifdef ARRAY
#ifndef LEAVES
#define LEAVES 1
#define NODES 1
#endif
#define TRUTH_WORDS ((NODES + 31) / 32)

layout(std430, binding = BIND_NODES) readonly restrict buffer node_buffer
{
    uint nodes[]; // what nodes begin with, a bit each; then for each its leaf, and how it joins
};

uint inside[(LEAVES + 3) / 4]; // counters of leaves, four in a word

void count_leaf(uint leaf, uint by)
{
    uint shift = (leaf & 3) * 8, word = inside[leaf >> 2];
    inside[leaf >> 2] = word & ~(0xffu << shift) | (((word >> shift) + by) & 0xffu) << shift;
}

bool is_inside(uint leaf)
{
    uint number = inside[leaf >> 2] >> (leaf & 3) * 8 & 0xffu;
    return number != 0 && number < 128; // below 0 in parts of a cluster
}

// Children come before their parents, and tell them what they are.
bool evaluate()
{
    uint truth[TRUTH_WORDS];
    for (int i = 0; i < TRUTH_WORDS; i++)
        truth[i] = nodes[i];
    bool value = false;
    uint number = uint(nodes.length() - TRUTH_WORDS) / 2;
    for (uint i = 0; i < number; i++) {
        uint leaf = nodes[TRUTH_WORDS + 2 * i], join = nodes[TRUTH_WORDS + 2 * i + 1];
        value = leaf != NODE_INNER ? is_inside(leaf) : (truth[i >> 5] >> (i & 31) & 1) != 0;
        uint to = join >> 2, bit = 1u << (to & 31);
        if (value && (join & 3) == NODE_ADDS)
            truth[to >> 5] |= bit;
        else if (value ? (join & 3) == NODE_CUTS : (join & 3) == NODE_LIMITS)
            truth[to >> 5] &= ~bit;
    }
    return value;
}
#endif
