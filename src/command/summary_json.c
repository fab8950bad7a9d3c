// summary_json.c - a summary as JSON, with OpenSCAD's keys.
#include "command/summary.h"

#include "base/file.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <string.h>

static void add_vector(cJSON *to, const char *key, struct vec3 v, int dimensions)
{
    const double numbers[3] = {v.x, v.y, v.z};
    cJSON_AddItemToObject(to, key, cJSON_CreateDoubleArray(numbers, dimensions));
}

static void add_cache(cJSON *to, const struct summary *s)
{
    cJSON *cache = cJSON_AddObjectToObject(to, "cache");
    cJSON *solids = cJSON_AddObjectToObject(cache, "geometry_cache");
    cJSON_AddNumberToObject(solids, "entries", s->model->stats.solids);
    cJSON *combinations = cJSON_AddObjectToObject(cache, "combination_cache");
    cJSON_AddNumberToObject(combinations, "entries", s->combinations.combinations);
    cJSON_AddNumberToObject(combinations, "bytes", (double)s->combinations.bytes);
}

static void add_time(cJSON *to, const struct timing *t)
{
    long total = lround(1e3 * (t->read + t->build + t->draw + t->write));
    char text[32];
    snprintf(text, sizeof text, "%ld:%02ld:%02ld.%03ld", total / 3600000, total / 60000 % 60,
             total / 1000 % 60, total % 1000);
    cJSON *time = cJSON_AddObjectToObject(to, "time");
    cJSON_AddStringToObject(time, "time", text);
    cJSON_AddNumberToObject(time, "total", (double)total);
    cJSON_AddNumberToObject(time, "milliseconds", (double)(total % 1000));
    cJSON_AddNumberToObject(time, "seconds", (double)(total / 1000 % 60));
    cJSON_AddNumberToObject(time, "minutes", (double)(total / 60000 % 60));
    cJSON_AddNumberToObject(time, "hours", (double)(total / 3600000));
    cJSON *steps = cJSON_AddObjectToObject(time, "steps");
    const double ms[] = {t->read, t->build, t->draw, t->write};
    static const char *const names[] = {"read", "build", "draw", "write"};
    for (int i = 0; i < 4; i++)
        cJSON_AddNumberToObject(steps, names[i], round(ms[i] * 1e6) / 1e3);
}

static void add_camera(cJSON *to, const struct summary *s)
{
    const struct camera *c = &s->drawn->camera;
    cJSON *camera = cJSON_AddObjectToObject(to, "camera");
    add_vector(camera, "translation", c->centre, 3);
    add_vector(camera, "rotation", c->rotation, 3);
    cJSON_AddNumberToObject(camera, "distance", c->distance);
    cJSON_AddNumberToObject(camera, "fov", c->fov);
    if (!depth_range_is_known(s->depths))
        return;
    cJSON *depth = cJSON_AddObjectToObject(camera, "depth");
    cJSON_AddNumberToObject(depth, "nearest", s->depths.nearest);
    cJSON_AddNumberToObject(depth, "farthest", s->depths.farthest);
}

static void add_box(cJSON *to, struct box b, int dimensions)
{
    if (box_is_empty(b))
        return;
    cJSON *box = cJSON_AddObjectToObject(to, "bounding_box");
    add_vector(box, "min", b.min, dimensions);
    add_vector(box, "max", b.max, dimensions);
    add_vector(box, "size", vec3_sub(b.max, b.min), dimensions);
}

static void add_geometry(cJSON *to, const struct summary *s)
{
    const struct model *m = s->model;
    int dimensions = summary_is_flat(m) ? 2 : 3;
    cJSON *geometry = cJSON_AddObjectToObject(to, "geometry");
    cJSON_AddNumberToObject(geometry, "dimensions", dimensions);
    if (s->request->summary & SUMMARY_GEOMETRY) {
        cJSON_AddNumberToObject(geometry, "nodes", m->stats.nodes);
        cJSON_AddNumberToObject(geometry, "leaves", m->stats.leaves);
        cJSON_AddNumberToObject(geometry, "solids", m->stats.solids);
        cJSON_AddNumberToObject(geometry, "triangles", m->stats.triangles);
        cJSON_AddNumberToObject(geometry, "not_drawn", m->stats.unsupported);
        cJSON_AddNumberToObject(geometry, "warnings", s->messages->warnings);
    }
    if (s->request->summary & SUMMARY_BOX)
        add_box(geometry, s->box, dimensions);
}

static void add_measured(cJSON *to, const char *key, struct measured v)
{
    cJSON *one = cJSON_AddObjectToObject(to, key);
    cJSON_AddNumberToObject(one, "value", v.value);
    cJSON_AddNumberToObject(one, "error", v.bound);
}

static void add_measures(cJSON *to, const struct summary *s)
{
    const struct measure *m = &s->measure;
    uint32_t parts = s->request->summary;
    cJSON *measures = cJSON_AddObjectToObject(to, "measurements");
    cJSON_AddBoolToObject(measures, "closed", m->open_rays == 0);
    if (parts & SUMMARY_AREA)
        add_measured(measures, "area", m->area);
    if (parts & SUMMARY_VOLUME) {
        add_measured(measures, "volume", m->volume);
        cJSON *centre = cJSON_AddArrayToObject(measures, "centre_of_mass");
        for (int i = 0; i < 3; i++) {
            cJSON *one = cJSON_CreateObject();
            cJSON_AddNumberToObject(one, "value", m->centre[i].value);
            cJSON_AddNumberToObject(one, "error", m->centre[i].bound);
            cJSON_AddItemToArray(centre, one);
        }
    }
    if (parts & SUMMARY_MASS)
        add_measured(measures, "mass", measure_mass(m, s->request->density));
}

bool summary_write(const char *path, const struct summary *s, struct error *err)
{
    uint32_t parts = s->request->summary;
    cJSON *all = cJSON_CreateObject();
    if (parts & SUMMARY_CACHE)
        add_cache(all, s);
    if (parts & SUMMARY_TIME)
        add_time(all, &s->times);
    if (parts & (SUMMARY_GEOMETRY | SUMMARY_BOX))
        add_geometry(all, s);
    if (parts & SUMMARY_MEASURED)
        add_measures(all, s);
    if (parts & SUMMARY_CAMERA)
        add_camera(all, s);
    char *text = cJSON_Print(all);
    cJSON_Delete(all);
    size_t length = strlen(text);
    text[length] = '\n'; // in the place of its end
    bool ok = file_write(path, text, length + 1, err);
    cJSON_free(text);
    return ok;
}
