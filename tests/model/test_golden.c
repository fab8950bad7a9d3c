// test_golden.c - models of small files as text, compared with the text beside each file.
#include "unit.h"

#include "base/file.h"

#include <dirent.h>
#include <stdio.h>
#include <unistd.h>

static void put_box(FILE *f, struct box b)
{
    if (box_is_empty(b))
        fprintf(f, "empty");
    else
        fprintf(f, "%.4g %.4g %.4g .. %.4g %.4g %.4g", b.min.x + 0.0, b.min.y + 0.0, b.min.z + 0.0,
                b.max.x + 0.0, b.max.y + 0.0, b.max.z + 0.0);
}

static void put_node(FILE *f, const struct expr *e, uint32_t i)
{
    const struct expr_node *n = &e->nodes[i];
    if (n->op == EXPR_LEAF) {
        fprintf(f, "%u", n->leaf);
        return;
    }
    for (uint32_t k = 0; k < n->count; k++) {
        fputs(k == 0 ? "(" : n->op == EXPR_UNION ? " + " : " * ", f);
        put_node(f, e, e->kids[n->first + k]);
    }
    if (n->minus != EXPR_NONE && n->op == EXPR_INTERSECTION) {
        fputs(" - ", f);
        put_node(f, e, n->minus);
    }
    fputc(')', f);
}

static void put_leaf(FILE *f, uint32_t number, const struct body *body)
{
    const struct leaf *l = &body->leaves[number];
    fprintf(f, "  %u %u:%u %u vertices%s%s%s, volume %.4g, ", number, l->place.line,
            l->place.column, l->solid->mesh.vertex_count, l->solid->convex ? ", convex" : "",
            l->mirrored ? ", mirrored" : "", l->subtracted ? ", subtracted" : "", leaf_volume(l));
    put_box(f, l->box);
    if (l->colour[0] != -1 || l->colour[1] != -1 || l->colour[2] != -1 || l->colour[3] != -1)
        fprintf(f, ", colour %.3g %.3g %.3g %.3g", (double)l->colour[0], (double)l->colour[1],
                (double)l->colour[2], (double)l->colour[3]);
    fputs(body->expr.leaf_node[number] == EXPR_NONE ? ", cannot matter\n" : "\n", f);
}

static char *dump(const struct model *m, const struct messages *messages)
{
    static const char *const kinds[] = {"main", "background", "highlight"};
    char *text;
    size_t size;
    FILE *f = open_memstream(&text, &size);
    fputs("bounds ", f);
    put_box(f, m->bounds);
    fprintf(f, "\n%u solids, %u unsupported\n", m->stats.solids, m->stats.unsupported);
    for (uint32_t i = 0; i < m->body_count; i++) {
        const struct body *body = &m->bodies[i];
        fprintf(f, "%s ", kinds[body->kind]);
        if (body->expr.root == EXPR_NONE || !body->expr.node_count)
            fputs("empty", f);
        else
            put_node(f, &body->expr, body->expr.root);
        fputc('\n', f);
        for (uint32_t l = 0; l < body->leaf_count; l++)
            put_leaf(f, l, body);
    }
    messages_print(messages, f);
    fclose(f);
    return text;
}

static void compare_file(const char *name)
{
    char path[300], expected_path[300];
    snprintf(path, sizeof path, "%s.csg", name);
    snprintf(expected_path, sizeof expected_path, "%s.txt", name);

    struct error err;
    char *text, *expected;
    size_t size;
    if (!file_read(path, 1 << 20, &text, &size, &err))
        fail_msg("%s", err.text);
    struct messages messages = {0};
    struct solid_store *store = solid_store_new();
    struct model m;
    model_of_text(&m, path, text, store, &messages);
    char *got = dump(&m, &messages);
    model_free(&m);
    solid_store_delete(store);
    messages_free(&messages);
    free(text);

    if (getenv("HCSG_UPDATE") && !file_write(expected_path, got, strlen(got), &err))
        fail_msg("%s", err.text);
    if (!file_read(expected_path, 1 << 20, &expected, &size, &err))
        fail_msg("%s", err.text);
    if (strcmp(got, expected) != 0)
        fail_msg("%s.csg gives\n%s\nnot\n%s", name, got, expected);
    free(expected);
    free(got);
}

static int is_csg(const struct dirent *d)
{
    const char *dot = strrchr(d->d_name, '.');
    return dot && strcmp(dot, ".csg") == 0;
}

static void all_files_give_their_models(void **state)
{
    (void)state;
    struct dirent **entries;
    int count = scandir(".", &entries, is_csg, alphasort);
    assert_true(count > 10);
    for (int i = 0; i < count; i++) {
        char name[256];
        snprintf(name, sizeof name, "%.*s", (int)(strlen(entries[i]->d_name) - 4),
                 entries[i]->d_name);
        compare_file(name);
        free(entries[i]);
    }
    free(entries);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(all_files_give_their_models)};
    if (chdir(FOLDER) != 0) // file names in messages are then short
        return 1;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
