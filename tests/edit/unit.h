// unit.h - cmocka, and edits of a text.
#pragma once
#include "base/mem.h"
#include "edit/edit.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static inline struct edit *edit_of_text(const char *text)
{
    struct messages messages = {0};
    size_t size = strlen(text);
    char *copy = mem_zalloc(size + 2);
    memcpy(copy, text, size);
    struct source *s = source_new("unit.csg", copy, size, &messages);
    messages_print(&messages, stderr);
    assert_non_null(s);
    messages_free(&messages);
    struct edit *e = edit_new(s);
    source_release(s);
    return e;
}
