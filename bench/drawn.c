// drawn.c - a model in GL: leaves in vertex buffers, a picture to draw into, camera and light.
#include <GL/glew.h>

#include <GLFW/glfw3.h>

#include "drawn.h"

#include "base/mem.h"
#include "render/scheme.h"

#include <stdlib.h>
#include <string.h>

struct vertex {
    float position[3];
};

struct lit_vertex { // of a triangle of its own: flat faces share no normals
    float position[3], normal[3];
};

struct leaf_range {
    GLsizei first_index, count; // of indices, and of lit vertices
};

struct drawn {
    GLFWwindow *window;
    GLuint buffers[3]; // vertices, indices, lit vertices
    GLuint frame, colour, depth;
    int size;
    const struct body *body;
    struct leaf_range *ranges;
    double to_clip[16]; // column-major, as GL has it
};

static struct vec3 placed_vertex(const struct leaf *leaf, uint32_t i)
{
    return affine_point(&leaf->to_world, leaf->solid->mesh.vertices[i]);
}

static void store(float out[3], struct vec3 v)
{
    out[0] = (float)v.x;
    out[1] = (float)v.y;
    out[2] = (float)v.z;
}

// Appends a leaf, in the world, to the three arrays.
static void add_leaf(const struct leaf *leaf, uint32_t base, struct vertex *vertices,
                     uint32_t *indices, struct lit_vertex *lit)
{
    const struct mesh *m = &leaf->solid->mesh;
    for (uint32_t i = 0; i < m->vertex_count; i++)
        store(vertices[i].position, placed_vertex(leaf, i));
    for (uint32_t t = 0; t < m->triangle_count; t++) {
        uint32_t corner[3] = {m->triangles[t][0], m->triangles[t][1], m->triangles[t][2]};
        if (leaf->mirrored) {
            corner[1] = m->triangles[t][2];
            corner[2] = m->triangles[t][1];
        }
        struct vec3 p[3];
        for (int i = 0; i < 3; i++) {
            p[i] = placed_vertex(leaf, corner[i]);
            indices[3 * t + (uint32_t)i] = base + corner[i];
        }
        struct vec3 normal =
            vec3_normalized(vec3_cross(vec3_sub(p[1], p[0]), vec3_sub(p[2], p[0])));
        for (int i = 0; i < 3; i++) {
            store(lit[3 * t + (uint32_t)i].position, p[i]);
            store(lit[3 * t + (uint32_t)i].normal, normal);
        }
    }
}

static void fill_buffers(struct drawn *d)
{
    size_t vertex_count = 0, index_count = 0;
    for (uint32_t i = 0; i < d->body->leaf_count; i++) {
        const struct mesh *m = &d->body->leaves[i].solid->mesh;
        d->ranges[i] = (struct leaf_range){(GLsizei)index_count, (GLsizei)(3 * m->triangle_count)};
        vertex_count += m->vertex_count;
        index_count += 3 * m->triangle_count;
    }
    struct vertex *vertices = mem_alloc((vertex_count + 1) * sizeof *vertices);
    uint32_t *indices = mem_alloc((index_count + 1) * sizeof *indices);
    struct lit_vertex *lit = mem_alloc((index_count + 1) * sizeof *lit);
    uint32_t base = 0;
    for (uint32_t i = 0; i < d->body->leaf_count; i++) {
        size_t first = (size_t)d->ranges[i].first_index;
        add_leaf(&d->body->leaves[i], base, vertices + base, indices + first, lit + first);
        base += d->body->leaves[i].solid->mesh.vertex_count;
    }
    glGenBuffers(3, d->buffers);
    glBindBuffer(GL_ARRAY_BUFFER, d->buffers[0]);
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(vertex_count * sizeof *vertices), vertices,
                 GL_STATIC_DRAW);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, d->buffers[1]);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)(index_count * sizeof *indices), indices,
                 GL_STATIC_DRAW);
    glBindBuffer(GL_ARRAY_BUFFER, d->buffers[2]);
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(index_count * sizeof *lit), lit, GL_STATIC_DRAW);
    free(vertices);
    free(indices);
    free(lit);
}

static bool open_context(struct drawn *d, struct error *err)
{
    if (!glfwInit()) {
        error_set(err, "no display for OpenCSG; under xvfb-run there is one");
        return false;
    }
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    d->window = glfwCreateWindow(64, 64, "bench", NULL, NULL);
    if (!d->window) {
        error_set(err, "no OpenGL context for OpenCSG");
        return false;
    }
    glfwMakeContextCurrent(d->window);
    if (glewInit() != GLEW_OK || !GLEW_ARB_framebuffer_object) {
        error_set(err, "OpenGL has no frame buffer objects");
        return false;
    }
    return true;
}

static bool make_picture(struct drawn *d, struct error *err)
{
    glGenFramebuffers(1, &d->frame);
    glBindFramebuffer(GL_FRAMEBUFFER, d->frame);
    glGenRenderbuffers(1, &d->colour);
    glBindRenderbuffer(GL_RENDERBUFFER, d->colour);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, d->size, d->size);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, d->colour);
    glGenRenderbuffers(1, &d->depth);
    glBindRenderbuffer(GL_RENDERBUFFER, d->depth);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH24_STENCIL8, d->size, d->size);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER,
                              d->depth);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        error_set(err, "OpenGL refuses a picture of %d x %d", d->size, d->size);
        return false;
    }
    glViewport(0, 0, d->size, d->size);
    return true;
}

bool drawn_new(struct drawn **out, const struct body *body, int size, struct error *err)
{
    struct drawn *d = mem_zalloc(sizeof *d);
    d->body = body;
    d->size = size;
    d->ranges = mem_alloc((body->leaf_count + 1) * sizeof *d->ranges);
    if (!open_context(d, err) || !make_picture(d, err)) {
        drawn_delete(d);
        return false;
    }
    fill_buffers(d);
    *out = d;
    return true;
}

void drawn_delete(struct drawn *d)
{
    if (!d)
        return;
    glfwTerminate(); // and with the context all that lives in it
    free(d->ranges);
    free(d);
}

// The frustum of the rays: exactly the view that our renderer draws.
static void set_camera(struct drawn *d, const struct rays *r)
{
    struct vec3 right = vec3_normalized(r->step_x);
    struct vec3 up = vec3_scale(vec3_normalized(r->step_y), -1);
    struct vec3 back = vec3_cross(right, up);
    double half = vec3_length(r->step_x) * d->size / 2; // at depth 1
    double view[16] = {right.x, up.x, back.x, 0, right.y, up.y, back.y, 0,
                       right.z, up.z, back.z, 0, 0,       0,    0,      1};
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glFrustum(-half * r->near, half * r->near, -half * r->near, half * r->near, r->near, r->far);
    glMatrixMode(GL_MODELVIEW);
    // OpenSCAD's light: the same from two opposite sides, fixed to the viewer.
    const float light[2][4] = {{-1, 1, 1, 0}, {1, -1, -1, 0}};
    const float white[4] = {1, 1, 1, 1};
    glLoadIdentity();
    for (int i = 0; i < 2; i++) {
        GLenum name = GL_LIGHT0 + (GLenum)i;
        glLightfv(name, GL_POSITION, light[i]);
        glLightfv(name, GL_DIFFUSE, white);
        glEnable(name);
    }
    glLoadMatrixd(view);
    glTranslated(-r->origin.x, -r->origin.y, -r->origin.z);

    double m[16], p[16];
    glGetDoublev(GL_MODELVIEW_MATRIX, m);
    glGetDoublev(GL_PROJECTION_MATRIX, p);
    for (int column = 0; column < 4; column++)
        for (int row = 0; row < 4; row++) {
            double sum = 0;
            for (int k = 0; k < 4; k++)
                sum += p[4 * k + row] * m[4 * column + k];
            d->to_clip[4 * column + row] = sum;
        }
}

void drawn_begin(struct drawn *d, const struct rays *rays)
{
    struct rgb background = scheme_list(&(uint32_t){0})->background;
    glClearColor((float)background.r / 255, (float)background.g / 255, (float)background.b / 255,
                 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    set_camera(d, rays);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glColorMaterial(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE);
}

// OpenCSG draws from arrays of its own in between: it must find no buffer bound.
static void bind(GLuint vertices, GLuint indices)
{
    glBindBuffer(GL_ARRAY_BUFFER, vertices);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices);
    if (vertices)
        glEnableClientState(GL_VERTEX_ARRAY);
    else
        glDisableClientState(GL_VERTEX_ARRAY);
}

void drawn_depth(struct drawn *d, uint32_t leaf)
{
    const struct leaf_range *r = &d->ranges[leaf];
    bind(d->buffers[0], d->buffers[1]);
    glVertexPointer(3, GL_FLOAT, sizeof(struct vertex), NULL);
    glDrawElements(GL_TRIANGLES, r->count, GL_UNSIGNED_INT,
                   (const void *)((size_t)r->first_index * sizeof(uint32_t)));
    bind(0, 0);
}

void drawn_colour(struct drawn *d, uint32_t leaf, enum drawn_sides sides)
{
    const struct leaf_range *r = &d->ranges[leaf];
    const struct leaf *l = &d->body->leaves[leaf];
    const struct scheme *scheme = scheme_list(&(uint32_t){0});
    struct rgb stock = l->subtracted ? scheme->back : scheme->front;
    float c[3] = {(float)stock.r / 255, (float)stock.g / 255, (float)stock.b / 255};
    for (int i = 0; i < 3; i++)
        if (l->colour[i] >= 0)
            c[i] = l->colour[i];
    glEnable(GL_LIGHTING);
    glEnable(GL_COLOR_MATERIAL);
    glEnable(GL_CULL_FACE);
    glCullFace(sides == DRAWN_OUTSIDE ? GL_BACK : GL_FRONT);
    glColor3fv(c);
    bind(d->buffers[2], 0);
    glVertexPointer(3, GL_FLOAT, sizeof(struct lit_vertex), NULL);
    glEnableClientState(GL_NORMAL_ARRAY);
    glNormalPointer(GL_FLOAT, sizeof(struct lit_vertex),
                    (const void *)offsetof(struct lit_vertex, normal));
    glDrawArrays(GL_TRIANGLES, r->first_index, r->count);
    glDisableClientState(GL_NORMAL_ARRAY);
    bind(0, 0);
    glDisable(GL_CULL_FACE);
    glDisable(GL_COLOR_MATERIAL);
    glDisable(GL_LIGHTING);
}

void drawn_equal(bool only_equal)
{
    glDepthFunc(only_equal ? GL_EQUAL : GL_LESS);
}

void drawn_end(struct drawn *d)
{
    (void)d;
    glFinish();
}

void drawn_box(const struct drawn *d, uint32_t leaf, float box[6])
{
    const double *m = d->to_clip;
    for (int axis = 0; axis < 3; axis++) {
        box[axis] = 1;
        box[3 + axis] = -1;
    }
    for (int i = 0; i < 8; i++) {
        struct vec3 p = box_corner(d->body->leaves[leaf].box, i);
        double w = m[3] * p.x + m[7] * p.y + m[11] * p.z + m[15];
        for (int axis = 0; axis < 3; axis++) {
            double v = (m[axis] * p.x + m[4 + axis] * p.y + m[8 + axis] * p.z + m[12 + axis]) / w;
            // A pixel more than enough: rounding must not cut anything off.
            double margin = axis < 2 ? 2.0 / d->size : 1e-6;
            box[axis] = fminf(box[axis], (float)fmax(-1, v - margin));
            box[3 + axis] = fmaxf(box[3 + axis], (float)fmin(1, v + margin));
        }
    }
}

uint8_t *drawn_picture(const struct drawn *d)
{
    size_t row = 3 * (size_t)d->size;
    uint8_t *bottom_up = mem_alloc(row * (size_t)d->size);
    uint8_t *rgb = mem_alloc(row * (size_t)d->size);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, d->size, d->size, GL_RGB, GL_UNSIGNED_BYTE, bottom_up);
    for (size_t y = 0; y < (size_t)d->size; y++)
        memcpy(rgb + row * y, bottom_up + row * ((size_t)d->size - 1 - y), row);
    free(bottom_up);
    return rgb;
}

const char *drawn_renderer(void)
{
    return (const char *)glGetString(GL_RENDERER);
}
