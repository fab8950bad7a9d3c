// scad_view.c - the camera that a .scad file sets with $vpt, $vpr, $vpd and $vpf.
#include "command/scad_view.h"

#include "base/file.h"
#include "base/mem.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define MARK     "ECHO: \"hcsg_view\", "
#define SET_MARK "WARNING: Viewall and autocenter disabled in favor of $vp*"
enum { SOURCE_LIMIT = 1 << 26 };

// Whether `name` is given a value in the text; one in a comment counts.
static bool is_set_in(const char *text, const char *name)
{
    for (const char *at = text; (at = strstr(at, name));) {
        at += strlen(name);
        const char *equals = at + strspn(at, " \t\r\n");
        if (equals[0] == '=' && equals[1] != '=')
            return true;
    }
    return false;
}

static bool is_set_in_file(const char *path, const char *name)
{
    char *text;
    size_t size;
    if (strcasecmp(file_extension(path), "scad") != 0 ||
        !file_read(path, SOURCE_LIMIT, &text, &size, NULL))
        return false;
    bool set = is_set_in(text, name);
    free(text);
    return set;
}

static bool is_defined(const struct request *r, const char *name)
{
    bool set = false;
    for (uint32_t i = 0; i < r->definitions.count; i++)
        set |= is_set_in(r->definitions.items[i], name);
    return set;
}

static bool is_set(const struct request *r, const struct scad_result *scad, const char *name)
{
    bool set = is_defined(r, name);
    for (uint32_t i = 0; i < scad->file_count && !set; i++)
        set = is_set_in_file(scad->files[i], name);
    return set;
}

bool scad_view_is_named(const struct request *r)
{
    static const char *const names[] = {"$vpt", "$vpr", "$vpd", "$vpf"};
    bool named = false;
    for (size_t i = 0; i < array_count(names) && !named; i++)
        named = is_defined(r, names[i]) || is_set_in_file(r->input, names[i]);
    return named;
}

bool scad_view_was_set(const struct scad_result *scad)
{
    return scad->log && strstr(scad->log, SET_MARK);
}

// Takes the first line that begins with `mark` out of the log.
static bool take_line(char *log, const char *mark, char *line, size_t size)
{
    for (char *at = log, *end; at && *at; at = end ? end + 1 : NULL) {
        end = strchr(at, '\n');
        if (strncmp(at, mark, strlen(mark)) != 0)
            continue;
        size_t length = end ? (size_t)(end - at) : strlen(at);
        snprintf(line, size, "%.*s", (int)length, at);
        length += end != NULL;
        memmove(at, at + length, strlen(at + length) + 1);
        return true;
    }
    return false;
}

// Two or three numbers, as OpenSCAD takes them; another value leaves *out alone.
static bool read_vector(const char *text, struct vec3 *out)
{
    struct vec3 v = {0};
    int end = 0;
    if (sscanf(text, " [%lf, %lf]%n", &v.x, &v.y, &end) != 2 || !end)
        if (sscanf(text, " [%lf, %lf, %lf]%n", &v.x, &v.y, &v.z, &end) != 3 || !end)
            return false;
    *out = v;
    return true;
}

static bool read_number(const char *text, double *out)
{
    return sscanf(text, "%lf", out) == 1 && isfinite(*out);
}

static const char *after_value(const char *text)
{
    for (int depth = 0; *text && (depth || *text != ','); text++)
        depth += (*text == '[') - (*text == ']');
    return *text ? text + 1 : text;
}

// What is of another kind than a camera needs leaves it as it is, as in OpenSCAD.
static void parse(struct camera *out, const char *text, bool sets_rotation, bool sets_distance)
{
    struct vec3 turn;
    double number;
    read_vector(text, &out->centre);
    text = after_value(text);
    // Where a file sets none, exports have these values, and pictures others.
    if (read_vector(text, &turn) && (turn.x != 0 || turn.y != 0 || turn.z != 0 || sets_rotation))
        out->rotation = turn;
    text = after_value(text);
    if (read_number(text, &number) && (number != 500 || sets_distance))
        out->distance = number;
    text = after_value(text);
    if (read_number(text, &number) && number > 0 && number < 180)
        out->fov = number;
}

bool scad_view_take(struct scad_view *out, uint32_t frames, const struct request *r,
                    struct scad_result *scad)
{
    char line[512];
    bool set = scad_view_was_set(scad);
    bool rotation = set && is_set(r, scad, "$vpr"), distance = set && is_set(r, scad, "$vpd");
    uint32_t i = 0;
    for (; i < frames && take_line(scad->log, MARK, line, sizeof line); i++) {
        out[i].camera = r->camera;
        out[i].set = set && !r->camera_given;
        if (out[i].set)
            parse(&out[i].camera, line + strlen(MARK), rotation, distance);
    }
    while (take_line(scad->log, SET_MARK, line, sizeof line))
        ;
    if (set && r->framing_given && !r->quiet)
        fputs(SET_MARK "\n", stderr);
    return i == frames || !set || r->camera_given;
}
