// test_bent.c - edges of bent faces, as many as OpenSCAD's geometry has.
#include "render/bent.h"
#include "unit.h"

#define TURNED                                                                                     \
    "multmatrix([[0.902859, -0.0317397, 0.428768, 0.1], [0.208446, 0.903024, -0.372077, 0.2],"     \
    " [-0.375378, 0.425303, 0.821918, 0.3], [0, 0, 0, 1]]) "
#define BLOCK "cube(size = [20, 7, 3], center = false);"
#define ROD   "cylinder($fn = 7, $fa = 12, $fs = 2, h = 4, r1 = 5, r2 = 5, center = false);"
#define CONE  "cylinder($fn = 12, $fa = 12, $fs = 2, h = 4, r1 = 5, r2 = 3, center = false);"
#define ELSEWHERE                                                                                  \
    "multmatrix([[1, 0, 0, 100], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) { cube(size = [1, 1, " \
    "1]); }"

// The first leaf has `vertices`, and by 2021.01's count as many facets. Euler: edges = both - 2.
static void check(const char *text, uint32_t vertices, uint32_t facets)
{
    struct stage s;
    stage_make_as(&s, MODEL_RENDER, text);
    struct facets *f = facets_new(&s.model);
    struct bent *bent = bent_new(&s.model.bodies[0], f);
    struct vec3 origin = {0.1, 0.1, 10}, down = {0, 0, -1};
    uint32_t ends = 0, count;
    bent_find(bent, 0, 0, origin, down);
    for (uint32_t v = 0; v < vertices; v++) {
        bent_edges(bent, 0, v, &count);
        ends += count;
    }
    assert_int_equal(ends, 2 * (vertices + facets - 2));
    bent_delete(bent);
    facets_delete(f);
    stage_free(&s);
}

static void faces_bend_where_leaves_meet_first(void **state)
{
    (void)state;
    check(TURNED "{" BLOCK "}" ELSEWHERE, 8, 12);
    check(TURNED "{" BLOCK ELSEWHERE "}", 8, 6);
    check(TURNED "{ union() {" BLOCK ELSEWHERE "} }" ELSEWHERE, 8, 6);
    check(TURNED "{ group() { hull() {" BLOCK "} } }" ELSEWHERE, 8, 12);
    check(TURNED "{" ROD "}" ELSEWHERE, 14, 24);
    check(TURNED "{" ROD ELSEWHERE "}", 14, 9);
    check(TURNED "{" CONE "}" ELSEWHERE, 24, 44);
    check(TURNED "{" CONE ELSEWHERE "}", 24, 22);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(faces_bend_where_leaves_meet_first)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
