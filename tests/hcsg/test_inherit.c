// test_inherit.c - what stays known when an expression takes the place of another.
#include "hcsg/discovery.h"
#include "unit.h"

#include <pthread.h>

enum { LEAVES = 12, SETS = 60 };

struct scene {
    struct expr e;
    struct sharing s;
    struct discovery *d;
};

static void scene_build(struct scene *m, const struct postfix *p, uint32_t leaves)
{
    bool convex[LEAVES + 1];
    memset(convex, true, sizeof convex);
    expr_build(&m->e, p->tokens, p->count, leaves);
    sharing_build(&m->s, &m->e, convex, true);
    m->d = discovery_new(&m->e, &m->s);
}

static void scene_free(struct scene *m)
{
    discovery_delete(m->d);
    sharing_free(&m->s);
    expr_free(&m->e);
}

static uint64_t key_of(const struct scene *m, const struct member *set, uint32_t count)
{
    uint64_t key = 0;
    for (uint32_t i = 0; i < count; i++)
        key += m->s.classes[set[i].class_id].value * set[i].count;
    return key & VALUE_MASK;
}

static uint32_t random_set(const struct scene *m, uint64_t *random, struct member *set)
{
    uint32_t n = 0;
    for (uint32_t c = 0; c < m->s.class_count; c++)
        if (random_below(random, 3) == 0)
            set[n++] = (struct member){c, 1 + random_below(random, m->s.classes[c].members)};
    return n;
}

// What the inheritor knows is true; and it knows each set whose classes all stayed.
static void check(const struct scene *now, const struct scene *before, const uint32_t *image,
                  uint64_t random, uint32_t *kept)
{
    struct member set[LEAVES];
    for (int i = 0; i < SETS; i++) {
        uint32_t n = random_set(before, &random, set);
        bool stays = n > 0;
        for (uint32_t k = 0; k < n; k++) {
            uint32_t c = image ? image[set[k].class_id] : set[k].class_id;
            stays &= c != EXPR_NONE;
            if (c != EXPR_NONE)
                assert_true(now->s.classes[c].value == before->s.classes[set[k].class_id].value);
            set[k].class_id = c;
        }
        if (!stays)
            continue;
        n = members_settle(set, n);
        bool truth = evaluate_set(&now->e, &now->s, set, n);
        assert_int_equal(discovery_lookup(now->d, key_of(now, set, n)),
                         truth ? SET_SOLID : SET_EMPTY);
        ++*kept;
    }
}

static void fill(struct scene *m, uint64_t random)
{
    struct member set[LEAVES];
    for (int i = 0; i < SETS; i++) {
        uint32_t n = random_set(m, &random, set);
        discovery_resolve(m->d, key_of(m, set, n), set, n);
    }
}

// Another operation at one place, the same leaves.
static void operations_change(void **state)
{
    (void)state;
    uint32_t kept = 0, changed = 0, identity[LEAVES];
    for (uint32_t i = 0; i < LEAVES; i++)
        identity[i] = i;
    for (uint64_t seed = 1; seed <= 400; seed++) {
        uint64_t random = seed;
        struct postfix p = postfix_random(&random, LEAVES);
        struct scene before, now;
        scene_build(&before, &p, LEAVES);
        fill(&before, seed);
        uint32_t at = random_below(&random, p.count);
        if (p.tokens[at].op != EXPR_LEAF)
            p.tokens[at].op = EXPR_UNION + (enum expr_op)random_below(&random, 3);
        scene_build(&now, &p, LEAVES);
        uint32_t *image = mem_zalloc((before.s.class_count + 1) * sizeof *image);
        if (sharing_equal(&now.s, &now.e, &before.s, &before.e)) {
            for (uint32_t i = 0; i < now.s.class_count; i++)
                assert_true(now.s.classes[i].value == before.s.classes[i].value);
            discovery_inherit(now.d, before.d, NULL);
            check(&now, &before, NULL, seed, &kept);
        } else {
            sharing_inherit(&now.s, LEAVES, &before.s, identity, image);
            discovery_inherit(now.d, before.d, image);
            check(&now, &before, image, seed, &kept);
            changed++;
        }
        scene_free(&now);
        scene_free(&before);
        free(image);
        free(p.tokens);
    }
    assert_true(kept > 2000 && changed > 50);
}

// a - b - c - d without b: the holes are one class before and after, the solid is the other.
static void a_leaf_goes(void **state)
{
    (void)state;
    struct postfix p = {0};
    struct scene before, now;
    for (uint32_t i = 0; i < 4; i++)
        postfix_push(&p, EXPR_LEAF, i);
    postfix_push(&p, EXPR_DIFFERENCE, 4);
    scene_build(&before, &p, 4);
    fill(&before, 5);
    p.count = 0;
    for (uint32_t i = 0; i < 3; i++)
        postfix_push(&p, EXPR_LEAF, i);
    postfix_push(&p, EXPR_DIFFERENCE, 3);
    scene_build(&now, &p, 3);
    uint32_t counterpart[3] = {0, 2, 3}, image[2], kept = 0;
    sharing_inherit(&now.s, 3, &before.s, counterpart, image);
    assert_int_equal(image[0], 0);
    assert_int_equal(image[1], 1);
    discovery_inherit(now.d, before.d, image);
    assert_int_equal(discovery_stats(now.d).combinations, discovery_stats(before.d).combinations);
    check(&now, &before, image, 5, &kept);
    assert_true(kept > 0);
    scene_free(&now);
    scene_free(&before);
    free(p.tokens);
}

// (a - b) + c becomes a + b + c: the union of all is no class that was there.
static void classes_that_mix_are_new(void **state)
{
    (void)state;
    struct postfix p = {0};
    struct scene before, now;
    postfix_push(&p, EXPR_LEAF, 0);
    postfix_push(&p, EXPR_LEAF, 1);
    postfix_push(&p, EXPR_DIFFERENCE, 2);
    postfix_push(&p, EXPR_LEAF, 2);
    postfix_push(&p, EXPR_UNION, 2);
    scene_build(&before, &p, 3);
    fill(&before, 7);
    p.tokens[2].op = EXPR_UNION;
    scene_build(&now, &p, 3);
    uint32_t counterpart[3] = {0, 1, 2}, image[3];
    assert_int_equal(now.s.class_count, 1);
    sharing_inherit(&now.s, 3, &before.s, counterpart, image);
    for (int i = 0; i < 3; i++) {
        assert_int_equal(image[i], EXPR_NONE);
        assert_true(now.s.classes[0].value != 0);
    }
    discovery_inherit(now.d, before.d, image);
    assert_int_equal(discovery_stats(now.d).combinations, 0);
    scene_free(&now);
    scene_free(&before);
    free(p.tokens);
}

struct finder {
    struct scene *scene;
    _Atomic bool over;
};

static void *find(void *argument)
{
    struct finder *f = argument;
    for (uint64_t i = 1; !f->over; i++)
        fill(f->scene, i);
    return NULL;
}

// The old model is drawn while the new one is made.
static void the_old_one_may_be_in_use(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 20; seed++) {
        uint64_t random = seed;
        uint32_t kept = 0;
        struct postfix p = postfix_random(&random, LEAVES);
        struct scene before, now;
        scene_build(&before, &p, LEAVES);
        scene_build(&now, &p, LEAVES);
        fill(&before, seed);
        struct finder finder = {.scene = &before};
        pthread_t thread;
        assert_int_equal(pthread_create(&thread, NULL, find, &finder), 0);
        discovery_inherit(now.d, before.d, NULL);
        finder.over = true;
        pthread_join(thread, NULL);
        check(&now, &before, NULL, seed, &kept);
        scene_free(&now);
        scene_free(&before);
        free(p.tokens);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(operations_change),
        cmocka_unit_test(a_leaf_goes),
        cmocka_unit_test(classes_that_mix_are_new),
        cmocka_unit_test(the_old_one_may_be_in_use),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
