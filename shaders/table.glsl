// table.glsl - looks combinations up in the table of src/hcsg/table.h.
#ifndef ARRAY // has the place for something else
layout(std430, binding = BIND_TABLE) readonly restrict buffer table_buffer
{
    uvec2 records[];
};
#endif

#define SET_EMPTY   0u
#define SET_SOLID   1u
#define SET_UNKNOWN 2u
#define SECONDARY   0x007fffffu // of the high word of a key

#ifndef ARRAY
uint table_lookup(uvec2 key)
{
    key.y &= SECONDARY;
    if (key == uvec2(0))
        return SET_EMPTY;
    uint h = (key.x ^ key.x >> 15) * 0x85ebca6bu;
    uvec2 record = records[h >> frame.table_shift];
    uint probes = record.y >> 27 & 15u, step = 0x9e3779b9u + (h << 12 >> 3);
    for (;;) {
        if (record.x == key.x && (record.y & SECONDARY) == key.y)
            return record.y >> 31;
        if (probes <= 1)
            return SET_UNKNOWN;
        probes--;
        h += step;
        record = records[h >> frame.table_shift];
    }
}
#endif
