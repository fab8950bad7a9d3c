// unit.h - cmocka, and a model from a text that is ready to be drawn.
#pragma once
#include "base/mem.h"
#include "csg/csg.h"
#include "render/camera.h"
#include "render/device.h"
#include "render/shade.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

struct stage {
    struct csg_tree tree;
    struct model model;
    struct solid_store *store;
    struct shader shader;
    struct device *device;
    struct render_settings settings;
};

static inline void stage_make_as(struct stage *s, enum model_mode mode, const char *text)
{
    struct messages messages = {0};
    struct error err;
    *s = (struct stage){.store = solid_store_new(), .device = cpu_device_new()};
    char *copy = mem_zalloc(strlen(text) + 2);
    memcpy(copy, text, strlen(text));
    assert_true(csg_parse(&s->tree, "unit.csg", copy, strlen(text), &messages));
    free(copy);
    struct model_options options = MODEL_DEFAULTS;
    options.mode = mode;
    model_build(&s->model, &s->tree, s->store, &options, &messages);
    assert_int_equal(messages.count, 0);
    messages_free(&messages);
    shader_init(&s->shader, &s->model, scheme_find("Cornfield", &err));
    s->settings = (struct render_settings){.epsilon = model_epsilon(&s->model, -1), .threads = 2};
}

static inline void stage_make(struct stage *s, const char *text)
{
    stage_make_as(s, MODEL_PREVIEW, text);
}

static inline void stage_free(struct stage *s)
{
    shader_free(&s->shader);
    device_delete(s->device);
    model_free(&s->model);
    solid_store_delete(s->store);
    csg_free(&s->tree);
}

// From above, x to the right: `size` pixels for as many mm around the origin, the eye at z = 100.
static inline struct rays rays_from_above(int size)
{
    struct camera c = {.distance = 100, .orthographic = true};
    c.fov = 2 * atan(size / 200.0) * (180 / M_PI);
    return camera_rays(&c, size, size, BOX_EMPTY);
}
