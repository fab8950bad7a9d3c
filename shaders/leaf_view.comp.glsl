// leaf_view.comp.glsl - how each leaf shows in the picture: maps, rectangle, depths.
#include "frame.glsl"

layout(local_size_x = GROUP_SIZE) in;
#include "thread.glsl"

layout(std430, binding = BIND_VIEWS) writeonly restrict buffer view_buffer
{
    leaf_view views[];
};

// What the linear form g over the world is over local points.
void linear(leaf_data l, dvec3 g, out double form[4])
{
    precise dvec3 r;
    r.x = l.to_world[0] * g.x + l.to_world[4] * g.y + l.to_world[8] * g.z;
    r.y = l.to_world[1] * g.x + l.to_world[5] * g.y + l.to_world[9] * g.z;
    r.z = l.to_world[2] * g.x + l.to_world[6] * g.y + l.to_world[10] * g.z;
    precise dvec3 at = dvec3(l.to_world[3], l.to_world[7], l.to_world[11]) - vec(frame.origin);
    precise double constant = g.x * at.x + g.y * at.y + g.z * at.z;
    form = double[4](r.x, r.y, r.z, constant);
}

dvec3 local_vector(leaf_data l, dvec3 v)
{
    return dvec3(l.to_local[0] * v.x + l.to_local[1] * v.y + l.to_local[2] * v.z,
                 l.to_local[4] * v.x + l.to_local[5] * v.y + l.to_local[6] * v.z,
                 l.to_local[8] * v.x + l.to_local[9] * v.y + l.to_local[10] * v.z);
}

double at(double form[4], dvec3 p)
{
    return form[0] * p.x + form[1] * p.y + form[2] * p.z + form[3];
}

dvec3 corner(dvec3 low, dvec3 high, int i)
{
    return dvec3((i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y,
                 (i & 4) != 0 ? high.z : low.z);
}

struct extent {
    double x0, y0, x1, y1, near, far; // pixels, depths
    bool behind;                      // some of it passes the eye
};

void extend(inout extent e, double x, double y, double t)
{
    e.near = min(e.near, t);
    e.far = max(e.far, t);
    if (frame.orthographic == 0) {
        if (t < frame.near * 0.5) {
            e.behind = true;
            return;
        }
        x /= t;
        y /= t;
    }
    e.x0 = min(e.x0, x);
    e.x1 = max(e.x1, x);
    e.y0 = min(e.y0, y);
    e.y1 = max(e.y1, y);
}

// The grid of a leaf: as fine as its largest picture coordinate allows.
int grid_bits(double largest)
{
    int log = 0;
    for (; largest >= 2 && log < COORDINATE_BITS; log++)
        largest *= 0.5;
    return clamp(COORDINATE_BITS - 1 - log, 0, GRID_BITS);
}

void main()
{
    uint i = thread_number();
    if (i >= frame.leaf_count)
        return;
    leaf_data l = leaves[i];
    leaf_view v;
    linear(l, vec(frame.dual_x), v.gx);
    linear(l, vec(frame.dual_y), v.gy);
    linear(l, vec(frame.axis), v.gt);

    dvec3 origin = vec(frame.origin);
    dvec3 o = local_vector(l, origin) + dvec3(l.to_local[3], l.to_local[7], l.to_local[11]);
    dvec3 f = local_vector(l, vec(frame.forward));
    dvec3 sx = local_vector(l, vec(frame.step_x));
    dvec3 sy = local_vector(l, vec(frame.step_y));
    v.origin = double[3](o.x, o.y, o.z);
    v.forward = double[3](f.x, f.y, f.z);
    v.step_x = double[3](sx.x, sx.y, sx.z);
    v.step_y = double[3](sy.x, sy.y, sy.z);

    extent e = extent(1e300, 1e300, -1e300, -1e300, 1e300, -1e300, false);
    double largest = 1;
    for (int k = 0; k < 8; k++) {
        dvec3 p = corner(vec(l.low), vec(l.high), k);
        double x = at(v.gx, p), y = at(v.gy, p), t = at(v.gt, p);
        extend(e, x, y, t);
        double limited = frame.orthographic != 0 ? 1 : max(t, frame.clip);
        largest = max(largest, max(abs(x), abs(y)) / limited);
    }
    v.bits = grid_bits(frame.orthographic != 0 ? largest : 2 * largest);
    if (e.behind) {
        e.x0 = e.y0 = -1;
        e.x1 = frame.width;
        e.y1 = frame.height;
    }
    double slack = 1e-6 * (abs(e.near) + abs(e.far));
    v.x0 = float(max(e.x0 - 0.01, -1e9));
    v.y0 = float(max(e.y0 - 0.01, -1e9));
    v.x1 = float(min(e.x1 + 0.01, 1e9));
    v.y1 = float(min(e.y1 + 0.01, 1e9));
    v.near = e.near - slack <= frame.near ? frame.start : float(frame_key(e.near - slack));
    v.far = e.far + slack >= frame.far ? frame.end : float(frame_key(e.far + slack));
    v.shows = uint(l.triangle_count > 0 && e.far >= frame.near && e.near <= frame.far &&
                   v.x1 >= 0 && v.y1 >= 0 && v.x0 <= float(frame.width - 1) &&
                   v.y0 <= float(frame.height - 1));
    views[i] = v;
}
