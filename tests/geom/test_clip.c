// test_clip.c - 2D booleans, offsets and sums against what OpenSCAD 2021.01 exports.
#include "base/angle.h"
#include "base/hash.h"
#include "geom/clip.h"
#include "unit.h"

// Points of paths, one path after the other; each ends with END.
#define END        ((struct vec2){NAN, NAN})
#define SHAPE(...) shape_of((const struct vec2[]){__VA_ARGS__, END, END})

static struct outline shape_of(const struct vec2 *points)
{
    struct outline o = {0};
    for (; !isnan(points->x) || !isnan(points[-1].x); points++) {
        if (isnan(points->x))
            outline_close(&o);
        else
            outline_add(&o, *points);
    }
    return o;
}

static struct outline square(double x, double y, double size)
{
    struct outline o = SHAPE({x, y}, {x + size, y}, {x + size, y + size}, {x, y + size});
    o.clean = true;
    return o;
}

static struct outline circle(double x, double y, double r, uint32_t n)
{
    struct outline o = {.clean = true};
    for (uint32_t i = 0; i < n; i++) {
        double angle = 360.0 * i / n;
        outline_add(&o, (struct vec2){x + r * cos_degrees(angle), y + r * sin_degrees(angle)});
    }
    outline_close(&o);
    return o;
}

// Frees both. Exported numbers have six digits.
static void expect(struct outline got, struct outline want)
{
    assert_true(got.clean);
    assert_int_equal(got.path_count, want.path_count);
    assert_int_equal(got.point_count, want.point_count);
    for (uint32_t i = 0; i < got.path_count; i++)
        assert_int_equal(got.ends[i], want.ends[i]);
    for (uint32_t i = 0; i < got.point_count; i++) {
        struct vec2 p = want.points[i];
        assert_close(got.points[i].x, p.x, 5.1e-6 * fmax(1, fabs(p.x)));
        assert_close(got.points[i].y, p.y, 5.1e-6 * fmax(1, fabs(p.y)));
    }
    outline_free(&got);
    outline_free(&want);
}

typedef bool operation(struct outline *, const struct outline *const *, uint32_t);

// Frees the operands.
static struct outline combined(operation *f, struct outline a, struct outline b)
{
    struct outline out;
    assert_true(f(&out, (const struct outline *const[]){&a, &b}, 2));
    outline_free(&a);
    outline_free(&b);
    return out;
}

static struct outline cleaned(struct outline o)
{
    struct outline out;
    assert_true(clip_clean(&out, &o));
    outline_free(&o);
    return out;
}

static struct outline moved_out(struct outline o, double by, enum clip_join join, double fn)
{
    struct outline out;
    assert_true(clip_offset(&out, &o, by, join, (struct detail){fn, 12, 2}));
    outline_free(&o);
    return out;
}

static struct outline sum(struct outline a, struct outline b)
{
    struct outline out;
    assert_true(clip_minkowski(&out, &a, &b));
    outline_free(&a);
    outline_free(&b);
    return out;
}

static void booleans_cut_coordinates_off(void **state)
{
    (void)state;
    expect(combined(clip_union, square(0, 0, 1.0 / 3), circle(.2, .1, 1, 7)),
           SHAPE({0.823486, -0.681824}, {1.2, 0.0999908}, {0.823486, 0.881821},
                 {-0.0225067, 1.07492}, {-0.700958, 0.533875}, {-0.700958, -0.333878},
                 {-0.0225067, -0.874924}));
    // Towards zero on both sides of it.
    expect(combined(clip_union, square(-1.0 / 3, -1.0 / 3, 1.0 / 7), square(2, 2, 1.0 / 3)),
           SHAPE({2.33333, 2.33333}, {2, 2.33333}, {2, 2}, {2.33333, 2}, END,
                 {-0.190475, -0.190475}, {-0.333328, -0.190475}, {-0.333328, -0.333328},
                 {-0.190475, -0.333328}));
    expect(combined(clip_union, square(0, 0, 1), square(1, 1, 1)),
           SHAPE({2, 2}, {1, 2}, {1, 1}, {2, 1}, END, {1, 1}, {0, 1}, {0, 0}, {1, 0}));
    expect(combined(clip_intersection, circle(0, 0, 2, 5), square(0, 0, 3)),
           SHAPE({0.618027, 1.9021}, {0, 1.70129}, {0, 0}, {2, 0}));
}

static void holes_run_clockwise(void **state)
{
    (void)state;
    struct outline frame = combined(clip_difference, square(0, 0, 4), square(1, 1, 2));
    expect(
        combined(clip_difference, frame, square(3, 3, 3)),
        SHAPE({4, 3}, {3, 3}, {3, 4}, {0, 4}, {0, 0}, {4, 0}, END, {1, 1}, {1, 3}, {3, 3}, {3, 1}));
}

static void intersections_are_of_all(void **state)
{
    (void)state;
    struct outline a = circle(0, 0, 2, 5), b = square(0, 0, 3), c = square(-1.5, -1.5, 3), out;
    double s = sin_degrees(30), k = cos_degrees(30);
    outline_transform(&c, &(struct affine){{{k, -s, 0, 0}, {s, k, 0, 0}, {0, 0, 1, 0}}});
    assert_true(clip_intersection(&out, (const struct outline *const[]){&a, &b, &c}, 3));
    expect(out, SHAPE({0.695114, 1.79601}, {0.618027, 1.9021}, {0, 1.70129}, {0, 0}, {1.73204, 0}));
    outline_free(&a);
    outline_free(&b);
    outline_free(&c);
}

static void odd_paths_count(void **state)
{
    (void)state;
    // All squares run the same way round.
    expect(cleaned(SHAPE({0, 0}, {6, 0}, {6, 6}, {0, 6}, END, {1, 1}, {5, 1}, {5, 5}, {1, 5}, END,
                         {2, 2}, {2, 4}, {4, 4}, {4, 2})),
           SHAPE({6, 6}, {0, 6}, {0, 0}, {6, 0}, END, {1, 1}, {1, 5}, {5, 5}, {5, 1}, END, {4, 4},
                 {2, 4}, {2, 2}, {4, 2}));
    expect(cleaned(SHAPE({0, 0}, {2, 2}, {2, 0}, {0, 2})),
           SHAPE({2, 2}, {1, 1}, {2, 0}, END, {1, 1}, {0, 2}, {0, 0}));
    expect(cleaned(SHAPE({0, 3}, {-1.8, -2.4}, {2.9, .9}, {-2.9, .9}, {1.8, -2.4})),
           SHAPE({1.11723, -0.35173}, {2.89999, 0.899994}, {0.699997, 0.899994}, {0, 3},
                 {-0.699997, 0.899994}, {0.699997, 0.899994}, {1.11723, -0.35173}, {0, -1.13617},
                 {1.79999, -2.39999}, END, {0, -1.13617}, {-1.11723, -0.35173},
                 {-0.699997, 0.899994}, {-2.89999, 0.899994}, {-1.11723, -0.35173},
                 {-1.79999, -2.39999}));
    expect(cleaned(SHAPE({0, 0}, {5, 0}, {5, .00001}, {0, .00001})), (struct outline){0});
}

static void mirrored_shapes_are_cleaned(void **state)
{
    (void)state;
    struct outline a = SHAPE({0, 0}, {1.0 / 3, 0}, {1.0 / 3, 1}, {0, 1});
    a.clean = true;
    a = combined(clip_union, a, square(.2, .1, 1));
    outline_transform(&a, &(struct affine){{{-1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}});
    expect(cleaned(a), SHAPE({0, 1}, {-0.199997, 1}, {-0.199997, 1.09999}, {-1.2, 1.09999},
                             {-1.2, 0.0999908}, {-0.333328, 0.0999908}, {-0.333328, 0}, {0, 0}));
}

static void offsets_have_joins(void **state)
{
    (void)state;
    expect(moved_out(square(0, 0, 4), 1, CLIP_ROUND, 0),
           SHAPE({5, 0}, {5, 4}, {4, 5}, {0, 5}, {-1, 4}, {-1, 0}, {0, -1}, {4, -1}));
    expect(moved_out(square(0, 0, 4), 1, CLIP_ROUND, 8),
           SHAPE({4.70711, -0.707108}, {5, 0}, {5, 4}, {4.70711, 4.70711}, {4, 5}, {0, 5},
                 {-0.707108, 4.70711}, {-1, 4}, {-1, 0}, {-0.707108, -0.707108}, {0, -1}, {4, -1}));
    expect(moved_out(square(0, 0, 4), 1, CLIP_CHAMFER, 0),
           SHAPE({5, -0.414215}, {5, 4.41422}, {4.41422, 5}, {-0.414215, 5}, {-1, 4.41422},
                 {-1, -0.414215}, {-0.414215, -1}, {4.41422, -1}));
    expect(moved_out(cleaned(SHAPE({0, 0}, {9, .5}, {0, 1})), .5, CLIP_MITRE, 0),
           SHAPE({18.0139, 0.5}, {-0.5, 1.52855}, {-0.5, -0.528549}));
}

static void negative_offsets_split_and_vanish(void **state)
{
    (void)state;
    struct outline frame = combined(clip_difference, square(0, 0, 6), square(2, 2, 2));
    expect(moved_out(frame, -.5, CLIP_MITRE, 0),
           SHAPE({5.5, 5.5}, {0.5, 5.5}, {0.5, 0.5}, {5.5, 0.5}, END, {1.5, 1.5}, {1.5, 4.5},
                 {4.5, 4.5}, {4.5, 1.5}));
    struct outline bone = SHAPE({0, 0}, {3, 0}, {3, 1}, {4, 1}, {4, 0}, {7, 0}, {7, 3}, {4, 3},
                                {4, 2}, {3, 2}, {3, 3}, {0, 3});
    expect(moved_out(cleaned(bone), -.6, CLIP_ROUND, 8),
           SHAPE({6.39999, 2.39999}, {4.60001, 2.39999}, {4.60001, 2}, {4.42427, 1.57573},
                 {4.24144, 1.5}, {4.42427, 1.42427}, {4.60001, 1}, {4.60001, 0.600006},
                 {6.39999, 0.600006}, END, {2.39999, 1}, {2.57573, 1.42427}, {2.75856, 1.5},
                 {2.57573, 1.57573}, {2.39999, 2}, {2.39999, 2.39999}, {0.600006, 2.39999},
                 {0.600006, 0.600006}, {2.39999, 0.600006}));
    expect(moved_out(square(0, 0, 4), -2, CLIP_MITRE, 0), (struct outline){0});
}

static void sums_keep_holes(void **state)
{
    (void)state;
    expect(sum(square(0, 0, 2), circle(0, 0, 1, 4)),
           SHAPE({-1, 2}, {-1, 0}, {0, -1}, {2, -1}, {3, 0}, {3, 2}, {2, 3}, {0, 3}));
    struct outline frame = combined(clip_difference, square(0, 0, 6), square(1, 1, 4));
    expect(sum(frame, circle(1, 0, 1, 4)),
           SHAPE({0, 6}, {0, 0}, {1, -1}, {7, -1}, {8, 0}, {8, 6}, {7, 7}, {1, 7}, END, {3, 2},
                 {3, 4}, {5, 4}, {5, 2}));
    frame = combined(clip_difference, square(0, 0, 4), square(1, 1, 2));
    expect(sum(frame, circle(0, 0, 1, 4)),
           SHAPE({-1, 4}, {-1, 0}, {0, -1}, {4, -1}, {5, 0}, {5, 4}, {4, 5}, {0, 5}));
}

static void large_sums_agree_with_small_ones(void **state)
{
    (void)state;
    struct outline round = sum(circle(0, 0, 3, 100), circle(5, 5, 2, 100));
    assert_int_equal(round.point_count, 100);
    assert_close(outline_area(&round), 50 * 25 * sin_degrees(3.6), 1e-2);
    outline_free(&round);

    struct outline frame = combined(clip_difference, circle(0, 0, 9, 64), circle(0, 0, 5, 64));
    struct outline grown = sum(frame, circle(0, 0, 1, 64));
    assert_int_equal(grown.path_count, 2);
    assert_int_equal(grown.point_count, 128);
    assert_close(outline_area(&grown), 32 * (100 - 16) * sin_degrees(5.625), 1e-2);
    outline_free(&grown);
}

static void filled_shapes_have_no_holes(void **state)
{
    (void)state;
    struct outline frame = combined(clip_difference, square(0, 0, 6), square(1, 1, 4)), out;
    frame = combined(clip_union, frame, square(2, 2, 1));
    assert_int_equal(frame.path_count, 3);
    assert_true(clip_fill(&out, &frame));
    expect(out, SHAPE({6, 6}, {0, 6}, {0, 0}, {6, 0}));
    outline_free(&frame);
}

static void lines_have_caps(void **state)
{
    (void)state;
    const struct vec2 line[] = {{0, 0}, {2, 0}};
    static const double width[] = {2, 3, 3};
    for (enum clip_cap cap = CLIP_CAP_BUTT; cap <= CLIP_CAP_SQUARE; cap++) {
        struct outline out;
        assert_true(clip_stroke(&out, line, 2, 1, cap, CLIP_MITRE));
        struct box b = outline_bounds(&out);
        assert_close(b.max.x - b.min.x, width[cap], 1e-3);
        assert_close(b.max.y - b.min.y, 1, 1e-3);
        assert_int_equal(out.path_count, 1);
        assert_true(cap == CLIP_CAP_ROUND ? out.point_count > 300 : out.point_count == 4);
        outline_free(&out);
    }
}

static void nothing_is_a_shape(void **state)
{
    (void)state;
    struct outline empty = {0}, a = square(0, 0, 1.0 / 3), out;
    const struct outline *const first[] = {NULL, &a}, *const second[] = {&a, NULL};
    const struct {
        operation *f;
        const struct outline *const *shapes;
        uint32_t count, points;
    } cases[] = {
        {clip_union, first, 0, 0},        {clip_union, first, 1, 0},
        {clip_union, first, 2, 4},        {clip_union, second, 2, 4},
        {clip_difference, first, 2, 0},   {clip_difference, second, 2, 4},
        {clip_intersection, first, 2, 0}, {clip_intersection, second, 2, 0},
        {clip_nonzero, first, 0, 0},      {clip_nonzero, second, 2, 4},
    };
    for (size_t i = 0; i < array_count(cases); i++) {
        assert_true(cases[i].f(&out, cases[i].shapes, cases[i].count));
        assert_int_equal(out.point_count, cases[i].points);
        assert_true(out.clean);
        outline_free(&out);
    }
    assert_true(clip_union(&out, second, 1)); // as it is
    assert_close(out.points[2].x, 1.0 / 3, 0);
    outline_free(&out);

    expect(cleaned(empty), empty);
    expect(moved_out(empty, 1, CLIP_ROUND, 0), empty);
    expect(sum(empty, square(0, 0, 1)), empty);
    expect(sum(square(0, 0, 1), empty), empty);
    assert_true(clip_fill(&out, &empty));
    expect(out, empty);
    assert_true(clip_stroke(&out, NULL, 0, 1, CLIP_CAP_ROUND, CLIP_ROUND));
    expect(out, empty);
    outline_free(&a);
}

static void what_is_out_of_range_is_refused(void **state)
{
    (void)state;
    const double bad[] = {NAN, INFINITY, -INFINITY, 1e300, 7.1e13};
    for (size_t i = 0; i < array_count(bad); i++) {
        struct outline o = SHAPE({0, 0}, {1, 0}, {1, 1}), one = square(0, 0, 1), out;
        o.points[1].y = bad[i];
        assert_false(clip_clean(&out, &o));
        assert_int_equal(out.path_count, 0);
        assert_false(clip_union(&out, (const struct outline *const[]){&one, &o}, 2));
        assert_false(clip_minkowski(&out, &one, &o));
        assert_false(clip_fill(&out, &o));
        assert_false(clip_offset(&out, &one, bad[i], CLIP_ROUND, DETAIL_DEFAULT));
        o.points[1].y *= 10; // its grid is coarser
        assert_false(clip_stroke(&out, o.points, 3, 1, CLIP_CAP_BUTT, CLIP_MITRE));
        assert_int_equal(out.path_count, 0);
        outline_free(&o);
        outline_free(&one);
    }
    struct outline far = square(3e13, 3e13, 3e13), one = square(0, 0, 1), out;
    const struct vec2 point = {1, 1}; // its round cap would have 10^9 corners
    assert_false(clip_stroke(&out, &point, 1, 7e13, CLIP_CAP_ROUND, CLIP_ROUND));
    assert_true(clip_union(&out, (const struct outline *const[]){&far, &one}, 2));
    assert_int_equal(out.path_count, 2);
    outline_free(&out);
    assert_false(clip_minkowski(&out, &far, &far));
    assert_false(clip_offset(&out, &far, 2e13, CLIP_ROUND, DETAIL_DEFAULT));
    outline_free(&far);
    outline_free(&one);
}

// A comb whose teeth point up: Clipper's own way takes minutes.
static struct outline comb(uint32_t corners)
{
    struct outline o = {0};
    outline_add(&o, (struct vec2){0, 0});
    outline_add(&o, (struct vec2){corners * .01, 0});
    for (uint32_t i = corners; i > 0; i--)
        outline_add(&o,
                    (struct vec2){i * .01, (i % 2 ? 15 : 10) + (double)(i * 7919 % 1000) / 1e4});
    outline_close(&o);
    return o;
}

static void large_shapes_are_quick(void **state)
{
    (void)state;
    struct outline o = comb(100000);
    double area = fabs(outline_area(&o));
    struct outline clean = cleaned(o);
    assert_int_equal(clean.path_count, 1);
    assert_int_equal(clean.point_count, 100002);
    assert_close(outline_area(&clean), area, 1e-4 * area);
    outline_free(&clean);

    expect(combined(clip_difference, circle(0, 0, 5, 200000), square(-9, -9, 18)),
           (struct outline){0});
}

static void tangles_are_refused(void **state)
{
    (void)state;
    struct outline o = {0}, out;
    uint64_t random = 1;
    for (uint32_t i = 0; i < 2000; i++) { // some 400,000 crossings
        uint64_t r = random = random * 6364136223846793005u + 1442695040888963407u;
        outline_add(&o, (struct vec2){(double)(r >> 48), (double)(r >> 32 & 0xffff)});
    }
    outline_close(&o);
    assert_false(clip_clean(&out, &o));
    outline_free(&o);

    struct outline a = comb(5000), b = comb(5000);
    a.clean = b.clean = true;
    assert_false(clip_minkowski(&out, &a, &b));
    assert_int_equal(out.path_count, 0);
    outline_free(&a);
    outline_free(&b);
}

// 20,000 discs upon each other cross some 10 million times, but only few of them in the end.
static void heaps_of_shapes_are_quick(void **state)
{
    (void)state;
    enum { DISCS = 20000 };
    struct outline *discs = mem_zalloc(DISCS * sizeof *discs), all, apart;
    const struct outline **list = mem_alloc(DISCS * sizeof *list);
    uint64_t random = 3;
    for (uint32_t i = 0; i < DISCS; i++) {
        double x = (double)(random_next(&random) % 1000), y = (double)(random_next(&random) % 1000);
        for (uint32_t k = 0; k < 16; k++)
            outline_add(&discs[i], (struct vec2){x + 40 * cos(acos(-1) * k / 8),
                                                 y + 40 * sin(acos(-1) * k / 8)});
        outline_close(&discs[i]);
        discs[i].clean = true;
        list[i] = &discs[i];
    }
    assert_true(clip_union(&all, list, DISCS));
    assert_int_equal(all.path_count, 1);
    struct box box = outline_bounds(&all);
    assert_true(fabs(box.min.x + 40) < 1e-4 && fabs(box.max.y - 1039) < 1e-4);
    assert_true(outline_area(&all) > 1000 * 1000 && outline_area(&all) < 1080 * 1080);

    // The same in two steps, of which the second is not in pieces.
    struct outline halves[2];
    assert_true(clip_union(&halves[0], list, DISCS / 2));
    assert_true(clip_union(&halves[1], list + DISCS / 2, DISCS / 2));
    const struct outline *two[2] = {&halves[0], &halves[1]};
    assert_true(clip_union(&apart, two, 2));
    assert_true(fabs(outline_area(&apart) - outline_area(&all)) < 1e-3 * 1e-2 * 1080);
    outline_free(&apart);
    assert_true(clip_difference(&apart, list, DISCS)); // the first less all others
    assert_true(outline_area(&apart) < outline_area(&discs[0]));
    outline_free(&apart);
    for (uint32_t i = 0; i < DISCS; i++)
        outline_free(&discs[i]);
    outline_free(&halves[0]);
    outline_free(&halves[1]);
    outline_free(&all);
    free(discs);
    free(list);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(booleans_cut_coordinates_off),
        cmocka_unit_test(holes_run_clockwise),
        cmocka_unit_test(intersections_are_of_all),
        cmocka_unit_test(odd_paths_count),
        cmocka_unit_test(mirrored_shapes_are_cleaned),
        cmocka_unit_test(offsets_have_joins),
        cmocka_unit_test(negative_offsets_split_and_vanish),
        cmocka_unit_test(sums_keep_holes),
        cmocka_unit_test(large_sums_agree_with_small_ones),
        cmocka_unit_test(filled_shapes_have_no_holes),
        cmocka_unit_test(lines_have_caps),
        cmocka_unit_test(nothing_is_a_shape),
        cmocka_unit_test(what_is_out_of_range_is_refused),
        cmocka_unit_test(large_shapes_are_quick),
        cmocka_unit_test(tangles_are_refused),
        cmocka_unit_test(heaps_of_shapes_are_quick),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
