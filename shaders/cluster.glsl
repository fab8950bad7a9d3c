// cluster.glsl - which face shows where surfaces touch: src/render/cpu/cluster.c.

// Is the interval between two crossings thick enough to exist?
bool thick(fragment a, fragment b)
{
    if (a.key >= b.key)
        return false;
    double steep = double(max(max(a.steep, b.steep), float(STEEP_LEAST)));
    double gap = double(b.key) - double(a.key);
    if (frame.orthographic == 0) {
        double p = frame.t0 - double(a.key), q = frame.t0 - double(b.key);
        if (!(q > 0))
            return true;
        gap *= frame.t0 * frame.t0 / (p * q);
    }
    return gap * steep >= frame.epsilon;
}

// Does the leaf of crossing c cross the other way as often? It is too thin to show there.
bool is_paired(uint c)
{
    uint leaf = at(c).leaf, same = 0, other = 0;
    for (uint i = from; i != to; i = next(i)) {
        same += uint(at(i).leaf == leaf);
        other += uint((at(i).leaf ^ leaf) == FRAGMENT_LEAVES);
    }
    return other >= same;
}

vec3 normal_of(fragment f)
{
    if (f.key <= frame.start)
        return vec3(0);
    uint t = 4 * (f.triangle & FRAGMENT_TRIANGLE), l = f.leaf >> 1;
    dvec3 n = dvec3(planes[t], planes[t + 1], planes[t + 2]);
    vec3 w = vec3(leaves[l].to_local[0] * n.x + leaves[l].to_local[4] * n.y +
                      leaves[l].to_local[8] * n.z,
                  leaves[l].to_local[1] * n.x + leaves[l].to_local[5] * n.y +
                      leaves[l].to_local[9] * n.z,
                  leaves[l].to_local[2] * n.x + leaves[l].to_local[6] * n.y +
                      leaves[l].to_local[10] * n.z);
    return normalize(w);
}

bool coplanar(fragment a, fragment b)
{
    vec3 n = normal_of(a), m = normal_of(b);
    return length(cross(n, m)) < 1e-4 && abs(dot(n, m)) > 0.5;
}

// Takes away the two neighbouring turns that are nearest to each other.
void drop_turns()
{
    uint last = to, best = to, best_next = to;
    float least = 3.4e38;
    for (uint i = from; i != to; i = next(i)) {
        if (!is_marked(i))
            continue;
        if (last != to && at(i).key - at(last).key <= least) {
            least = at(i).key - at(last).key;
            best = last;
            best_next = i;
        }
        last = i;
    }
    mark(best, false);
    mark(best_next, false);
}

// Marks the crossings that turn the state, which is `solid` behind the cluster, when they are taken
// one by one. Returns how many; 0 when the last of them leaves it otherwise.
uint find_turns(bool solid)
{
    uvec2 key = before;
    bool now = !solid;
    uint turns = 0;
    for (uint i = from; i != to; i = next(i))
        if (is_border(i) && in_subset(SUBSET_PREFIX, i, 0))
            key = key_add(key, step_of(at(i)));
    for (uint i = from; i != to; i = next(i)) {
        mark(i, false);
        if (is_border(i))
            continue;
        key = key_add(key, step_of(at(i)));
        bool turned = is_solid(key, SUBSET_PREFIX, i) != now;
        mark(i, turned);
        now = now != turned;
        turns += uint(turned);
    }
    return now == solid ? turns : 0;
}

// Would the state be another one without the leaf of crossing i, or is it the same with that alone?
// Of a leaf that is too thin to show only one side is meant.
bool matters(uint i, bool solid)
{
    like = is_paired(i) ? 0xffffffffu : ~FRAGMENT_LEAVES;
    return solid_with(SUBSET_REST, i) != solid || solid_with(SUBSET_ALONE, i) == solid;
}

// Of the crossings of the cluster that make the state `solid`, the one that does: taken one by one
// they may turn it several times, for there are thin intervals between. The thinnest go first, and
// one that does not matter gives way to one that does.
uint turning_point(bool solid)
{
    uint most = find_turns(solid), found = from;
    if (most == 0)
        return to;
    for (uint turns = most; turns > 1; turns -= 2)
        drop_turns();
    while (!is_marked(found))
        found = next(found);
    if (most == 1 || matters(found, solid))
        return found;
    find_turns(solid);
    bool makes = true;
    for (uint i = from; i != to; i = next(i)) {
        if (!is_marked(i))
            continue;
        if (makes && matters(i, solid))
            return i;
        makes = !makes;
    }
    return found;
}

// Whether the leaf of crossing i shows rather than that of `best`, where the place wants leaves of
// the given kind; 2 for any.
bool shows_before(uint i, uint best, uint cut)
{
    uint a = at(i).leaf >> 1, b = at(best).leaf >> 1;
    bool wanted = uint((values[a].w & LEAF_SUBTRACTED) != 0) == cut;
    bool has = uint((values[b].w & LEAF_SUBTRACTED) != 0) == cut;
    return cut == 2 || wanted == has ? a > b : wanted;
}

// May crossing i show in place of the one that turns the state?
bool competes(uint i, uint turning)
{
    return !is_border(i) && !is_paired(i) &&
           (at(i).key == at(turning).key || coplanar(at(i), at(turning)));
}

// Of the crossings that compete, the next one in the file; `to`: `last` was the last one.
uint next_in_file(uint last, uint turning)
{
    uint found = to, after = last == to ? 0 : at(last).leaf >> 1;
    for (uint i = from; i != to; i = next(i)) {
        uint leaf = at(i).leaf >> 1;
        bool behind = last == to || leaf > after || (leaf == after && goes_first(at(last), at(i)));
        if (behind && (found == to || leaf < at(found).leaf >> 1) && competes(i, turning))
            found = i;
    }
    return found;
}

// Where several crossings in one plane turn the state together, so that none of them matters: they
// are left out in the order of the file as long as the state stays as it is. What must remain owns
// the place as if it mattered.
uint owner_together(uint turning, bool solid, uint cut)
{
    uint best = turning;
    bool found = false;
    for (uint i = from; i != to; i = next(i))
        mark(i, false);
    for (uint i = to;;) {
        i = next_in_file(i, turning);
        if (i == to)
            break;
        mark(i, true);
        if (solid_with(SUBSET_KEPT, 0) == solid)
            continue;
        mark(i, false);
        if (!found || shows_before(i, best, cut))
            best = i;
        found = true;
    }
    return best;
}

// Of the crossings at one place, the one whose surface shows there: cluster_owner in cluster.c.
uint owner_of(bool solid)
{
    if (next(from) == to)
        return from;
    uint turning = turning_point(solid);
    if (turning == to)
        return from;
    uint best = turning;
    bool weak = is_paired(turning) || !matters(turning, solid);
    uint cut = frame.borders != 0 ? uint(!solid_with(SUBSET_ENTER, 0)) : 2;
    for (uint i = from; i != to; i = next(i)) {
        if (i == turning || (!weak && !shows_before(i, best, cut)) || !competes(i, turning) ||
            !matters(i, solid))
            continue;
        best = i;
        weak = false;
    }
    return weak ? owner_together(turning, solid, cut) : best;
}
