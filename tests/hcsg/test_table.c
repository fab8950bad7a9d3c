// test_table.c - the hash table of combinations at every load, with friendly and hostile keys.
#include "hcsg/table.h"
#include "unit.h"

#include <stdio.h>

static bool solid_of(uint64_t key)
{
    return hash_mix(key) & 1;
}

static const unsigned char *set_of(uint64_t key) // any pointer that tells the key
{
    return (const unsigned char *)(uintptr_t)(key + 1);
}

// All invariants of a table.
static void check_table(const struct table *t)
{
    uint32_t count = 0;
    for (uint32_t place = 0; place < table_capacity(t); place++) {
        uint64_t record = t->records[place], key = record & VALUE_MASK;
        uint32_t age = table_age(record);
        if (age == 0) {
            assert_int_equal(key, 0);
            assert_null(t->sets[place]);
            continue;
        }
        count++;
        uint32_t h = table_hash(key);
        assert_int_equal((h + (age - 1) * table_step(h)) >> t->shift, place);
        assert_true(table_max_age(t->records[h >> t->shift]) >= age);
        assert_ptr_equal(t->sets[place], set_of(key));
        assert_int_equal(record >> TABLE_SOLID_SHIFT, solid_of(key));
    }
    assert_int_equal(count, t->count);
}

static void check_found(const struct table *t, const uint64_t *keys, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        uint64_t record = table_find(t, keys[i]);
        assert_true(record != 0);
        assert_int_equal(record & VALUE_MASK, keys[i]);
        assert_int_equal(record >> TABLE_SOLID_SHIFT, solid_of(keys[i]));
        assert_true(table_matches(t->records[table_place(t, keys[i])], keys[i]));
    }
}

static struct table *add(struct table *t, uint64_t key, bool *stored)
{
    struct table *next = table_add(t, key, solid_of(key), set_of(key), stored);
    if (next != t)
        table_delete(t);
    return next;
}

static void layout_is_as_documented(void **state)
{
    (void)state;
    struct table *t = table_new(TABLE_BITS_FIRST, 0);
    assert_int_equal(table_capacity(t) * sizeof t->records[0], 1024);
    assert_int_equal((uintptr_t)t->records % 64, 0);
    uint64_t key = 0x7fffff00000001u;
    assert_true(table_insert(t, key, true, set_of(key)));
    uint32_t words[2];
    uint32_t place = table_place(t, key);
    uint64_t record = t->records[place];
    memcpy(words, &record, sizeof words);
    assert_int_equal(words[0], 1);
    assert_int_equal(words[1], 0x7fffffu | 1u << 23 | 1u << 27 | 1u << 31);
    assert_int_equal(place, (1u * TABLE_MULTIPLIER) >> 25);
    table_delete(t);
    table_delete(NULL);
}

static void random_keys_at_every_load(void **state)
{
    (void)state;
    enum { N = 5000 };
    uint64_t random = 11, *keys = mem_alloc(N * sizeof *keys);
    struct table *t = table_new(TABLE_BITS_FIRST, 0);
    uint32_t capacity = table_capacity(t);
    for (uint32_t i = 0; i < N; i++) {
        keys[i] = random_next(&random) & VALUE_MASK;
        bool stored;
        t = add(t, keys[i], &stored);
        assert_true(stored);
        assert_int_equal(t->count, i + 1);
        assert_true((uint64_t)t->count * 100 <= (uint64_t)table_capacity(t) * 80);
        if (table_capacity(t) != capacity) {
            assert_int_equal(table_capacity(t), 2 * capacity);
            assert_in_range(t->count * 100 / table_capacity(t), 39, 41);
            capacity = table_capacity(t);
        }
        if (i < 500 || i % 50 == 0) {
            check_table(t);
            check_found(t, keys, i + 1);
            for (int miss = 0; miss < 20; miss++)
                assert_int_equal(table_find(t, random_next(&random) & VALUE_MASK), 0);
        }
    }
    table_delete(t);
    free(keys);
}

static void check_regular(uint64_t (*key_of)(uint32_t i), uint32_t count)
{
    uint64_t *keys = mem_alloc(count * sizeof *keys);
    struct table *t = table_new(TABLE_BITS_FIRST, 0);
    for (uint32_t i = 0; i < count; i++) {
        keys[i] = key_of(i);
        bool stored;
        t = add(t, keys[i], &stored);
        assert_true(stored);
    }
    check_table(t);
    check_found(t, keys, count);
    assert_true(table_capacity(t) <= 16 * count);
    table_delete(t);
    free(keys);
}

static uint64_t counting(uint32_t i)
{
    return i + 1;
}
static uint64_t low_bits_zero(uint32_t i)
{
    return ((uint64_t)i + 1) << 18 & UINT32_MAX;
}
static uint64_t multiples(uint32_t i) // of one value: what a class with many members makes
{
    return (uint64_t)(i + 1) * 0x12345678900001u & VALUE_MASK;
}
static uint64_t grid(uint32_t i) // sums of two values
{
    return ((i % 64 + 1) * 0x00f00d12345677u + (i / 64 + 1) * 0x0badcafe987653u) & VALUE_MASK;
}
static uint64_t twins(uint32_t i) // each primary key four times
{
    return hash_mix(i / 4) >> 32 | (uint64_t)(i % 4) << 32 | (uint64_t)1 << 40;
}

static void regular_keys(void **state)
{
    (void)state;
    check_regular(counting, 5000);
    check_regular(low_bits_zero, 10000);
    check_regular(multiples, 5000);
    check_regular(grid, 4096);
    check_regular(twins, 5000);
}

// Of keys with one primary key TABLE_AGE_MOST fit; others are refused and the table stays small.
static void one_primary_key_for_all(void **state)
{
    (void)state;
    uint64_t stored_keys[200], others[60];
    uint32_t stored_count = 0;
    struct table *t = table_new(TABLE_BITS_FIRST, 0);
    bool stored;
    for (uint32_t i = 0; i < 60; i++) {
        others[i] = hash_mix(i) & VALUE_MASK;
        t = add(t, others[i], &stored);
        assert_true(stored);
    }
    for (uint32_t i = 0; i < 200; i++) {
        uint64_t key = 0x1234567u | (uint64_t)(i + 1) << 32;
        t = add(t, key, &stored);
        if (stored)
            stored_keys[stored_count++] = key;
        check_table(t);
        check_found(t, stored_keys, stored_count);
        check_found(t, others, 60);
    }
    assert_int_equal(stored_count, TABLE_AGE_MOST);
    assert_true(table_capacity(t) <= 4096);
    uint32_t ages = 0; // all of them are in use
    for (uint32_t i = 0; i < stored_count; i++)
        ages |= 1u << table_age(table_find(t, stored_keys[i]));
    assert_int_equal(ages, 0xfffe);
    table_delete(t);
}

static void refused_insertion_changes_no_record(void **state)
{
    (void)state;
    uint64_t random = 12;
    struct table *t = table_new(TABLE_BITS_FIRST, 0);
    uint32_t refused = 0;
    for (int i = 0; i < 2000; i++) {
        uint64_t key = random_next(&random) & VALUE_MASK, before[128];
        for (uint32_t k = 0; k < 128; k++)
            before[k] = t->records[k] << 5 >> 5; // max ages may rise
        if (table_insert(t, key, solid_of(key), set_of(key)))
            continue;
        refused++;
        for (uint32_t k = 0; k < 128; k++)
            assert_int_equal(before[k], t->records[k] << 5 >> 5);
        check_table(t);
    }
    assert_true(refused > 1000 && t->count > 100);
    table_delete(t);
}

static void renewal_changes_secondary_keys(void **state)
{
    (void)state;
    struct table *t = table_new(TABLE_BITS_FIRST, 0);
    bool stored;
    for (uint32_t i = 0; i < 100; i++)
        t = add(t, hash_mix(i) & VALUE_MASK, &stored);
    for (uint32_t i = 0; i < 100; i++) {
        uint64_t key = hash_mix(i) & VALUE_MASK, next = key ^ (uint64_t)0x2a << 32;
        table_renew(t, table_place(t, key), next);
        assert_int_equal(table_find(t, key), 0);
        assert_int_equal(table_find(t, next) >> TABLE_SOLID_SHIFT, solid_of(key));
        assert_ptr_equal(t->sets[table_place(t, next)], set_of(key));
    }
    table_delete(t);
}

// A copy that takes over the blocks written since it last looked is the table.
static void copies_follow_by_blocks(void **state)
{
    (void)state;
    struct table *t = table_new(TABLE_BITS_FIRST, 1);
    static uint64_t copy[1 << 14];
    uint64_t random = 5, version = 0, born = 0;
    uint32_t taken = 0, tables = 0;
    bool stored;
    for (int i = 0; i < 3000; i++) {
        t->version++;
        t = add(t, random_next(&random) & VALUE_MASK, &stored);
        if (i % 10)
            continue;
        tables += born != t->born;
        version = born == t->born ? version : 0;
        born = t->born;
        for (uint32_t b = 0; b < table_blocks(t); b++)
            if (t->written[b] > version) {
                for (uint32_t k = b << TABLE_BLOCK_BITS; k < (b + 1) << TABLE_BLOCK_BITS; k++)
                    copy[k] = t->records[k];
                taken++;
            }
        version = t->version;
        for (uint32_t k = 0; k < table_capacity(t); k++)
            assert_true(copy[k] == t->records[k]);
    }
    assert_int_equal(table_capacity(t), 4096);
    assert_int_equal(tables, 6); // 128, 256, ... places
    assert_in_range(taken, 300, 300 * table_blocks(t) / 4);
    table_delete(t);
}

static void ages_stay_low(void **state)
{
    (void)state;
    for (uint32_t bits = 7; bits <= 17; bits += 2) {
        struct table *t = table_new(bits, 0);
        uint64_t random = bits;
        uint32_t count = (uint32_t)((uint64_t)table_capacity(t) * 80 / 100);
        while (t->count < count) {
            uint64_t key = random_next(&random) & VALUE_MASK;
            if (!table_insert(t, key, solid_of(key), set_of(key)))
                break;
        }
        uint32_t most = 0;
        double sum = 0;
        for (uint32_t i = 0; i < table_capacity(t); i++) {
            uint32_t age = table_age(t->records[i]);
            sum += age;
            most = age > most ? age : most;
        }
        printf("%u places, %.0f %% full: average age %.2f, max %u\n", table_capacity(t),
               100.0 * t->count / table_capacity(t), sum / t->count, most);
        assert_true(sum / t->count < 2.5);
        table_delete(t);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(layout_is_as_documented),
        cmocka_unit_test(random_keys_at_every_load),
        cmocka_unit_test(regular_keys),
        cmocka_unit_test(one_primary_key_for_all),
        cmocka_unit_test(refused_insertion_changes_no_record),
        cmocka_unit_test(renewal_changes_secondary_keys),
        cmocka_unit_test(copies_follow_by_blocks),
        cmocka_unit_test(ages_stay_low),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
