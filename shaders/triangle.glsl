// triangle.glsl - a placed triangle: which rays cross it, where, and how steeply.
//
// Watertight as in src/render/cpu/mesh.c: vertices are rounded to a grid, edges are tested in exact
// integers, and a ray exactly on an edge counts as moved by (-e*e, +e) for an infinitely small e,
// which every edge answers alike. So a ray crosses a closed mesh consistently.
#include "frame.glsl"
#include "exact.glsl"

layout(std430, binding = BIND_VIEWS) readonly restrict buffer view_buffer
{
    leaf_view views[];
};
layout(std430, binding = BIND_VERTICES) readonly restrict buffer vertex_buffer
{
    double vertices[];
};
layout(std430, binding = BIND_TRIANGLES) readonly restrict buffer triangle_buffer
{
    uint triangles[];
};
layout(std430, binding = BIND_PLANES) readonly restrict buffer plane_buffer
{
    double planes[];
};

// A triangle cut off at the clipping depth has up to four corners.
struct polygon {
    ivec2 corners[4]; // on the grid
    int count;
    int bits;
    float low, high; // keys of the vertices
};

struct pixel_range { // inclusive; empty when x1 < x0 or y1 < y0
    int x0, y0, x1, y1;
    int left, top; // where it would begin if the band were the whole picture
};

// Keys of the rays that cross the plane of a triangle: a + b dx + c dy from pixel (x, y) on.
struct key_plane {
    int x, y;
    double a, b, c;
    float steep, steep_x, steep_y; // n.d, signed, likewise
};

double linear_at(double form[4], dvec3 p)
{
    precise double r = form[0] * p.x + form[1] * p.y + form[2] * p.z + form[3];
    return r;
}

int to_grid(double v)
{
    const double most = double(1 << COORDINATE_BITS);
    return int(roundEven(clamp(v, -most, most)));
}

ivec2 project(uint leaf, dvec3 p)
{
    precise double s = double(1 << views[leaf].bits);
    if (frame.orthographic == 0)
        s = s / linear_at(views[leaf].gt, p);
    precise double x = linear_at(views[leaf].gx, p) * s, y = linear_at(views[leaf].gy, p) * s;
    return ivec2(to_grid(x), to_grid(y));
}

bool less(dvec3 a, dvec3 b)
{
    return a.x < b.x || (a.x == b.x && (a.y < b.y || (a.y == b.y && a.z < b.z)));
}

// The point of an edge at the clipping depth: the same for both triangles of the edge.
dvec3 clip_point(dvec3 a, double ta, dvec3 b, double tb)
{
    bool swap = less(b, a);
    dvec3 from = swap ? b : a, to = swap ? a : b;
    double t = swap ? tb : ta, u = swap ? ta : tb;
    precise double s = (frame.clip - t) / (u - t);
    precise dvec3 r = from + (to - from) * s;
    return r;
}

dvec3 vertex(uint first, uint i)
{
    uint at = 3 * (first + i);
    return dvec3(vertices[at], vertices[at + 1], vertices[at + 2]);
}

// False when nothing of the triangle is in front of the clipping depth.
bool polygon_of(uint leaf, uint triangle, out polygon p)
{
    dvec3 corner[3];
    double depth[3];
    int cut = 0;
    p.low = 3.4e38;
    p.high = -3.4e38;
    for (int k = 0; k < 3; k++) {
        corner[k] = vertex(leaves[leaf].first_vertex, triangles[3 * triangle + k]);
        depth[k] = linear_at(views[leaf].gt, corner[k]);
        bool clipped = frame.orthographic == 0 && depth[k] < frame.clip;
        cut += int(clipped);
        float key = float(frame_key(clipped ? frame.clip : depth[k]));
        p.low = min(p.low, key);
        p.high = max(p.high, key);
    }
    p.count = 0;
    p.bits = views[leaf].bits;
    if (cut == 3)
        return false;
    for (int k = 0; k < 3; k++) {
        int next = k == 2 ? 0 : k + 1;
        bool inside = cut == 0 || depth[k] >= frame.clip;
        bool next_inside = cut == 0 || depth[next] >= frame.clip;
        if (inside)
            p.corners[p.count++] = project(leaf, corner[k]);
        if (inside != next_inside)
            p.corners[p.count++] =
                project(leaf, clip_point(corner[k], depth[k], corner[next], depth[next]));
    }
    if ((leaves[leaf].flags & LEAF_MIRRORED) != 0) { // the mirror turned the triangle over
        ivec2 swap = p.corners[0];
        p.corners[0] = p.corners[p.count - 1];
        p.corners[p.count - 1] = swap;
        if (p.count == 4) {
            swap = p.corners[1];
            p.corners[1] = p.corners[2];
            p.corners[2] = swap;
        }
    }
    return true;
}

// The pixels whose rays may cross the polygon, within the band.
pixel_range range_of(polygon p)
{
    ivec2 low = p.corners[0], high = low;
    for (int k = 1; k < p.count; k++) {
        low = min(low, p.corners[k]);
        high = max(high, p.corners[k]);
    }
    int unit = 1 << p.bits;
    int left = max((low.x - 1 + unit - 1) >> p.bits, 0);
    int top = max((low.y - 1 + unit - 1) >> p.bits, 0);
    return pixel_range(max(left, frame.column), max(top, frame.band),
                       min((high.x + 1) >> p.bits, frame.column + frame.columns - 1),
                       min((high.y + 1) >> p.bits, frame.band + frame.rows - 1), left, top);
}

// Which side of the line a -> b a point lies on: exact, never 0.
int side(ivec2 a, ivec2 b, ivec2 p)
{
    bool swap = a.x > b.x || (a.x == b.x && a.y > b.y);
    ivec2 from = swap ? b : a, to = swap ? a : b;
    int s = compare_products(to.x - from.x, p.y - from.y, to.y - from.y, p.x - from.x);
    return (s >= 0) != swap ? 1 : -1;
}

// Which way part `k` (1 or 2) of a polygon faces: above 0 clockwise in the picture, 0 seen edge-on.
int facing(polygon p, int k)
{
    ivec2 u = p.corners[k] - p.corners[0], v = p.corners[k + 1] - p.corners[0];
    return compare_products(u.x, v.y, u.y, v.x);
}

// Does the ray of a pixel cross part `k`, which faces the given way?
bool crosses(polygon p, int k, int facing, ivec2 pixel)
{
    ivec2 at = pixel << p.bits;
    return side(p.corners[0], p.corners[k], at) == facing &&
           side(p.corners[k], p.corners[k + 1], at) == facing &&
           side(p.corners[k + 1], p.corners[0], at) == facing;
}

// From a pixel that does not depend on bands and pieces: keys are the same however a picture is cut.
key_plane plane_of(uint leaf, uint triangle, int x, int y)
{
    dvec3 n = dvec3(planes[4 * triangle], planes[4 * triangle + 1], planes[4 * triangle + 2]);
    double d = planes[4 * triangle + 3];
    dvec3 o = vec(views[leaf].origin), f = vec(views[leaf].forward), sx = vec(views[leaf].step_x), sy = vec(views[leaf].step_y);
    precise double nx = dot(n, sx), ny = dot(n, sy);
    precise double ray = dot(n, f), eye = d - dot(n, o), scale;
    precise double a, b, c;
    key_plane k;
    k.x = x;
    k.y = y;
    if (frame.orthographic != 0) {
        eye -= x * nx + y * ny;
        scale = abs(ray) < 1e-25 ? 0 : 1 / ray;
        a = (eye - frame.t0 * ray) * scale;
        b = -nx * scale;
        c = -ny * scale;
    } else {
        ray += x * nx + y * ny;
        scale = abs(eye) < 1e-25 ? 0 : frame.t0 / eye;
        a = (eye - frame.t0 * ray) * scale;
        b = -frame.t0 * nx * scale;
        c = -frame.t0 * ny * scale;
    }
    k.a = a;
    k.b = b;
    k.c = c;
    // n of the world has another length
    dvec3 w = dvec3(leaves[leaf].to_local[0] * n.x + leaves[leaf].to_local[4] * n.y + leaves[leaf].to_local[8] * n.z,
                    leaves[leaf].to_local[1] * n.x + leaves[leaf].to_local[5] * n.y + leaves[leaf].to_local[9] * n.z,
                    leaves[leaf].to_local[2] * n.x + leaves[leaf].to_local[6] * n.y + leaves[leaf].to_local[10] * n.z);
    precise float unit = float(1 / length(w));
    precise float steep = float(ray) * unit;
    precise float steep_x = frame.orthographic != 0 ? 0 : float(nx) * unit;
    precise float steep_y = frame.orthographic != 0 ? 0 : float(ny) * unit;
    k.steep = steep;
    k.steep_x = steep_x;
    k.steep_y = steep_y;
    return k;
}

float key_at(key_plane k, polygon p, ivec2 pixel)
{
    precise double key = k.a + k.b * double(pixel.x - k.x) + k.c * double(pixel.y - k.y);
    return clamp(float(key), p.low, p.high);
}

float steep_at(key_plane k, ivec2 pixel)
{
    precise float steep = k.steep + k.steep_x * float(pixel.x - k.x) +
                          k.steep_y * float(pixel.y - k.y);
    return abs(steep);
}
