// test_triangulate.c - triangles cover the outline, and their edges add up to its paths.
#include "base/hash.h"
#include "geom/outline.h"
#include "unit.h"

static void add_path(struct outline *o, const double (*points)[2], uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        outline_add(o, (struct vec2){points[i][0], points[i][1]});
    outline_close(o);
    o->clean = true;
}

static bool same(const struct outline *o, uint32_t i, uint32_t j)
{
    return o->points[i].x == o->points[j].x && o->points[i].y == o->points[j].y;
}

static uint32_t place(const struct outline *o, uint32_t i)
{
    uint32_t first = 0;
    while (!same(o, first, i))
        first++;
    return first;
}

// Edges are counted in a matrix: +1 one way, -1 back.
static void count_edge(int *matrix, const struct outline *o, uint32_t i, uint32_t j, int sign)
{
    uint32_t a = place(o, i), b = place(o, j);
    matrix[a * o->point_count + b] += sign;
    matrix[b * o->point_count + a] -= sign;
}

// Takes the outline; returns the number of triangles. `upright`: none is turned over.
static uint32_t check(struct outline *o, bool upright)
{
    uint32_t(*t)[3], count;
    outline_triangulate(o, &t, &count);
    int *matrix = mem_zalloc((size_t)o->point_count * o->point_count * sizeof *matrix);
    double area = 0;
    for (uint32_t i = 0; i < count; i++) {
        struct vec2 a = o->points[t[i][0]], b = o->points[t[i][1]], c = o->points[t[i][2]];
        double twice = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        assert_true(!upright || twice >= 0);
        area += twice / 2;
        for (int k = 0; k < 3; k++)
            count_edge(matrix, o, t[i][k], t[i][(k + 1) % 3], 1);
    }
    for (uint32_t path = 0, begin = 0; path < o->path_count; begin = o->ends[path++])
        for (uint32_t i = begin; i < o->ends[path]; i++)
            count_edge(matrix, o, i, i + 1 < o->ends[path] ? i + 1 : begin, -1);
    for (size_t i = 0; i < (size_t)o->point_count * o->point_count; i++)
        assert_int_equal(matrix[i], 0);
    assert_close(area, outline_area(o), 1e-9 * fmax(1, fabs(area)));
    free(matrix);
    free(t);
    outline_free(o);
    return count;
}

static void nothing_has_no_triangles(void **state)
{
    (void)state;
    struct outline o = {0};
    assert_int_equal(check(&o, true), 0);
}

static void convex_and_dented(void **state)
{
    (void)state;
    struct outline o = {0};
    add_path(&o, (double[][2]){{0, 0}, {4, 0}, {4, 3}, {0, 3}}, 4);
    assert_int_equal(check(&o, true), 2);
    add_path(&o, (double[][2]){{0, 0}, {4, 0}, {4, 3}, {2, 1}, {0, 3}}, 5);
    assert_int_equal(check(&o, true), 3);
    add_path(&o, (double[][2]){{0, 0}, {4, 0}, {4, 4}, {0, 4}}, 4);
    add_path(&o, (double[][2]){{1, 1}, {1, 3}, {3, 3}, {3, 1}}, 4);
    assert_int_equal(check(&o, true), 8);
}

static void paths_may_touch(void **state)
{
    (void)state;
    struct outline o = {0};
    // Corner to corner, and a hole with a corner on a corner and one on a side.
    add_path(&o, (double[][2]){{0, 0}, {2, 0}, {2, 2}, {0, 2}}, 4);
    add_path(&o, (double[][2]){{2, 2}, {5, 2}, {5, 5}, {2, 5}}, 4);
    add_path(&o, (double[][2]){{2, 2}, {3, 4}, {5, 3}}, 3);
    check(&o, true);
    // Side on side: together they are a plate.
    add_path(&o, (double[][2]){{0, 0}, {2, 0}, {2, 2}, {0, 2}}, 4);
    add_path(&o, (double[][2]){{2, 0}, {4, 0}, {4, 3}, {2, 3}}, 4);
    check(&o, true);
    // Points on a side, one of them twice.
    add_path(&o, (double[][2]){{0, 0}, {1, 0}, {1, 0}, {3, 0}, {3, 3}, {2, 1}, {0, 3}}, 7);
    check(&o, true);
    // Out along a line and back.
    add_path(&o, (double[][2]){{0, 0}, {4, 0}, {4, 4}, {4, 6}, {4, 4}, {2, 3}, {0, 4}}, 7);
    check(&o, true);
}

static void odd_outlines_close_too(void **state)
{
    (void)state;
    struct outline o = {0};
    add_path(&o, (double[][2]){{0, 0}, {4, 4}, {4, 0}, {0, 4}, {2, 7}}, 5); // crosses itself
    check(&o, false);
    add_path(&o, (double[][2]){{0, 0}, {1, 1}, {2, 2}, {3, 3}}, 4); // on one line
    check(&o, false);
    add_path(&o, (double[][2]){{0, 0}, {1e300, 0}, {1e290, 1e-300}, {1e299, 1e300}}, 4);
    uint32_t(*t)[3], count;
    outline_triangulate(&o, &t, &count);
    free(t);
    outline_free(&o);
    uint64_t random = 3;
    for (int n = 0; n < 500; n++) {
        for (uint32_t i = 0; i < 3 + (uint32_t)n % 12; i++) {
            double x = (double)(random_next(&random) % 5) / 3;
            outline_add(&o, (struct vec2){x, (double)(random_next(&random) % 5) / 3});
        }
        outline_close(&o);
        check(&o, false);
    }
}

// Long spikes from both sides: edges across many triangles of a first guess.
static void many_points(void **state)
{
    (void)state;
    struct outline o = {0};
    uint64_t random = 1;
    uint32_t n = 20000;
    for (uint32_t i = 0; i < n; i++)
        outline_add(
            &o, (struct vec2){i, i % 2 ? 1e5 * random_unit(&random) : -5e4 * random_unit(&random)});
    outline_add(&o, (struct vec2){n, 3e5});
    outline_add(&o, (struct vec2){-1, 3e5});
    outline_close(&o);
    uint32_t(*t)[3], count;
    outline_triangulate(&o, &t, &count);
    assert_int_equal(count, n);
    free(t);
    outline_free(&o);
}

// A strip of frames, upwards or to the right, as far from each other in the list as can be: holes
// come after all outer paths.
static void long_strips_are_cut_in_pieces(void **state)
{
    (void)state;
    enum { FRAMES = 3000 };
    for (int up = 0; up < 2; up++) {
        struct outline o = {0};
        for (uint32_t i = 0; i < 2 * FRAMES; i++) {
            bool hole = i >= FRAMES;
            double at = 10.0 * (i * 7 % FRAMES), low = hole ? 1 : 0, high = hole ? 7 : 8;
            const double x[4] = {low, high, high, low}, y[4] = {low, low, high, high};
            for (int k = 0; k < 4; k++) {
                int c = hole ? 3 - k : k;
                outline_add(&o,
                            up ? (struct vec2){x[c], at + y[c]} : (struct vec2){at + x[c], y[c]});
            }
            outline_close(&o);
        }
        o.clean = true;
        uint32_t(*t)[3], count;
        double area = 0;
        outline_triangulate(&o, &t, &count);
        assert_int_equal(count, 8 * FRAMES);
        for (uint32_t i = 0; i < count; i++) {
            struct vec2 a = o.points[t[i][0]], b = o.points[t[i][1]], c = o.points[t[i][2]];
            double twice = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
            assert_true(twice > 0);
            for (int k = 0; k < 3; k++) // of one frame
                assert_int_equal(t[i][k] / 4 % FRAMES, t[i][0] / 4 % FRAMES);
            area += twice / 2;
        }
        assert_close(area, 28.0 * FRAMES, 1e-6);
        free(t);
        outline_free(&o);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_has_no_triangles),
        cmocka_unit_test(convex_and_dented),
        cmocka_unit_test(paths_may_touch),
        cmocka_unit_test(odd_outlines_close_too),
        cmocka_unit_test(many_points),
        cmocka_unit_test(long_strips_are_cut_in_pieces),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
