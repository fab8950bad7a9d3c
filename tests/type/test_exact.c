// Texts with the fonts of OpenSCAD's own tests, beside what OpenSCAD 2021.01 makes of them.
#include "type/text.h"

#include "base/mem.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#define FONTS      "/usr/share/openscad/testdata/ttf" // of the package openscad-testing-data
#define LIBERATION .font = "Liberation Sans"

static int compare_points(const void *a, const void *b)
{
    const struct vec2 *p = a, *q = b;
    return p->x < q->x ? -1 : p->x > q->x ? 1 : (p->y > q->y) - (p->y < q->y);
}

static void set(struct outline *out, struct text_line line, double fn)
{
    struct messages messages = {0};

    line.spacing = line.spacing != 0 ? line.spacing : 1;
    line.detail = (struct detail){fn, 12, 2};
    assert_true(text_outline(out, &line, (struct place){0}, &messages));
    assert_int_equal(messages.count, 0);
    messages_free(&messages);
}

static void assert_near(double a, double b, double tolerance)
{
    if (!(fabs(a - b) <= tolerance))
        fail_msg("%.9g is not %.9g", a, b);
}

// OpenSCAD writes six digits.
static void assert_digits(double a, double b)
{
    assert_near(a, b, 1e-6 + 5.1e-6 * fabs(b));
}

static void every_vertex(void **state)
{
    static const struct {
        struct text_line line;
        double fn;
        uint32_t count;
        struct vec2 points[48]; // by x, then y
    } cases[] = {
        {{.text = "i", LIBERATION, .size = 5, .halign = "center", .valign = "top"},
         0,
         8,
         {{-0.288834, -4.91562},
          {-0.288834, -1.24696},
          {-0.288834, -0.467117},
          {-0.288834, 0.116074},
          {0.321503, -4.91562},
          {0.321503, -1.24696},
          {0.321503, -0.467117},
          {0.321503, 0.116074}}},
        {{.text = "O", LIBERATION, .size = 4},
         8,
         38,
         {{0.263107, 1.92859},   {0.319397, 1.36403}, {0.388565, 2.74538}, {0.488235, 0.874756},
          {0.763901, 0.476379},  {0.764908, 3.36211}, {0.789307, 1.92859}, {0.87883, 2.57213},
          {0.879837, 1.28401},   {1.14059, 0.184433}, {1.14735, 3.05428},  {1.15143, 0.787949},
          {1.36505, 3.74968},    {1.58002, 3.35535},  {1.58374, 0.471634}, {1.60817, 0.00541687},
          {2.15643, -0.0542297}, {2.15643, 0.366196}, {2.16187, 3.45572},  {2.16187, 3.87888},
          {2.70097, 0.00610352}, {2.70638, 3.82089},  {2.73929, 3.35399},  {2.7413, 0.468246},
          {3.1682, 0.187149},    {3.16956, 3.04883},  {3.17223, 0.774399}, {3.1736, 3.64696},
          {3.43706, 2.56534},    {3.43773, 1.26706},  {3.52623, 1.92859},  {3.54691, 0.480774},
          {3.55167, 3.36247},    {3.82596, 0.87883},  {3.82867, 2.97287},  {3.99788, 1.36641},
          {3.99857, 2.49074},    {4.05519, 1.92859}}},
        {{.text = "م", .font = "Amiri", .size = 2},
         0,
         36,
         {{0.180374, 0.0555878}, {0.204437, -0.222763}, {0.222763, 0.235977}, {0.274292, 0.0460968},
          {0.275314, 0.0176392}, {0.287506, 0.0718689}, {0.287506, 0.351257}, {0.322769, -0.740509},
          {0.324646, 0.527573},  {0.37059, -0.362106},  {0.389908, 0.695755}, {0.396347, -1.07109},
          {0.432632, 0.452972},  {0.438049, -1.36031},  {0.451965, -1.41626}, {0.45842, -0.77713},
          {0.460785, 0.540451},  {0.472473, 0.826965},  {0.480118, -1.43219}, {0.520798, 0.583176},
          {0.526215, -1.26233},  {0.544189, 0.489929},  {0.561478, 0.89241},  {0.576736, 0.251236},
          {0.58725, 0.573349},   {0.675415, 0.514008},  {0.705917, 0.889694}, {0.878845, 0.783905},
          {0.97345, 0.694397},   {0.980545, 0.238693},  {1.00972, 0.241241},  {1.02667, 0.262436},
          {1.04533, 0.346008},   {1.05923, 0.59404},    {1.07652, 0.563858},  {1.07957, 0.535706}}},
    };

    (void)state;
    for (size_t i = 0; i < array_count(cases); i++) {
        struct outline out;
        set(&out, cases[i].line, cases[i].fn);
        assert_int_equal(out.point_count, cases[i].count);
        qsort(out.points, out.point_count, sizeof *out.points, compare_points);
        for (uint32_t k = 0; k < out.point_count; k++) {
            assert_digits(out.points[k].x, cases[i].points[k].x);
            assert_digits(out.points[k].y, cases[i].points[k].y);
        }
        outline_free(&out);
    }
}

static void counts_boxes_and_sums(void **state)
{
    static const struct {
        struct text_line line;
        double fn;
        uint32_t count;
        struct vec2 min, max, sum; // the sum of all points
    } cases[] = {
        {{.text = "OpenSCAD", LIBERATION, .size = 5},
         0,
         419,
         {0.328888, -1.44099},
         {35.2165, 4.84859},
         {6610.366, 986.9999}},
        {{.text = "OpenSCAD", LIBERATION, .size = 5, .halign = "center", .valign = "center"},
         0,
         419,
         {-17.3869, -3.10506},
         {17.5007, 3.18452},
         {-812.547, 289.7594}},
        {{.text = "OpenSCAD", LIBERATION, .size = 5, .halign = "right", .valign = "bottom"},
         0,
         419,
         {-35.1027, -0.0316162},
         {-0.215057, 6.25797},
         {-8235.463, 1577.528}},
        {{.text = "OpenSCAD", LIBERATION, .size = 20, .halign = "center"},
         0,
         545,
         {-69.5476, -5.76399},
         {70.0029, 19.3944},
         {-4496.068, 5162.987}},
        {{.text = "OpenSCAD", LIBERATION, .size = 5, .direction = "ttb", .valign = "center"},
         0,
         419,
         {-2.30859, -24.6068},
         {2.43149, 24.7897},
         {43.33048, 1153.31}},
        {{.text = "OpenSCAD", LIBERATION, .size = 5, .direction = "btt", .halign = "right"},
         0,
         419,
         {-6.94296, -50.1357},
         {-2.20287, -0.736023},
         {-1898.469, -11543.77}},
        {{.text = "OpenSCAD", LIBERATION, .size = 5, .direction = "rtl"},
         0,
         419,
         {0.569641, -1.44099},
         {35.2256, 4.84859},
         {8322.111, 986.9999}},
        {{.text = "abcXYZ", LIBERATION, .size = 4, .spacing = 0.5},
         0,
         150,
         {0.235992, -0.0542297},
         {11.212, 4.02534},
         {581.8888, 239.9641}},
        {{.text = "abcXYZ", LIBERATION, .size = 4, .spacing = 2},
         0,
         171,
         {0.235992, -0.0542297},
         {35.189, 4.02534},
         {1699.734, 248.1474}},
        {{.text = "T-X-U", .font = " Liberation Sans:style=Regular ", .size = 40},
         2,
         54,
         {1.24759, -0.542389},
         {138.299, 38.2192},
         {4653.869, 858.704}},
        {{.text = "Å", .font = "", .size = 40},
         0,
         79,
         {0.108398, 0},
         {36.9444, 48.4724},
         {1467.002, 2932.22}},
        {{.text = "типографика", LIBERATION, .size = 3, .language = "ru"},
         0,
         356,
         {0.0711823, -0.864594},
         {24.4205, 3.01901},
         {5287.746, 375.008}},
        {{.text = "الخط الأميري", .font = "Amiri", .size = 3},
         0,
         439,
         {0.266479, -1.81749},
         {17.8987, 4.15166},
         {3862.948, 457.7139}},
        {{.text = "abcd", .font = "Amiri", .size = 40, .halign = "center"},
         0,
         651,
         {-47.3453, -0.43399},
         {49.0294, 37.6496},
         {-654.2265, 8338.295}},
        {{.text = "0123 ABCD", .font = "MarVoSym", .size = 4},
         0,
         272,
         {0.265839, -0.0542297},
         {34.7958, 4.03619},
         {5457.52, 468.3485}},
        {{.text = "abc", LIBERATION, .size = -5},
         0,
         140,
         {-10.8322, -5.03169},
         {-0.294998, 0.0677948},
         {-691.9732, -231.6237}},
        {{.text = "AV To", LIBERATION, .size = 5, .valign = "top"},
         0,
         81,
         {0.0135498, -4.73341},
         {17.2662, 0.111771},
         {907.264, -199.1773}},
    };

    (void)state;
    for (size_t i = 0; i < array_count(cases); i++) {
        struct outline out;
        struct vec2 sum = {0}, all = {0};
        set(&out, cases[i].line, cases[i].fn);
        struct box box = outline_bounds(&out);
        for (uint32_t k = 0; k < out.point_count; k++) {
            struct vec2 p = out.points[k];
            sum = (struct vec2){sum.x + p.x, sum.y + p.y};
            all = (struct vec2){all.x + fabs(p.x), all.y + fabs(p.y)};
        }
        assert_int_equal(out.point_count, cases[i].count);
        assert_digits(box.min.x, cases[i].min.x);
        assert_digits(box.min.y, cases[i].min.y);
        assert_digits(box.max.x, cases[i].max.x);
        assert_digits(box.max.y, cases[i].max.y);
        assert_near(sum.x, cases[i].sum.x, 1e-6 * all.x);
        assert_near(sum.y, cases[i].sum.y, 1e-6 * all.y);
        outline_free(&out);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_vertex),
        cmocka_unit_test(counts_boxes_and_sums),
    };

    if (access(FONTS "/liberation-2.00.1/LiberationSans-Regular.ttf", R_OK) != 0) {
        printf("skipped: needs the package openscad-testing-data\n");
        return 77;
    }
    setenv("FONTCONFIG_FILE", FONTS_CONF, 1); // only these fonts, whatever else the machine has
    setenv("HOME", "/nowhere", 1);
    setenv("OPENSCAD_FONT_PATH", "/nowhere::" FONTS, 1);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
