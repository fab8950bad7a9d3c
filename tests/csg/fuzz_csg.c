// fuzz_csg.c - any bytes through the parser; what it accepts is printed and parsed again.
#include "csg/csg.h"

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct messages messages = {0};
    struct csg_tree tree, again;
    char *text = mem_zalloc(size + 2);

    memcpy(text, data, size);
    bool ok = csg_parse(&tree, "fuzz.csg", text, size, &messages);
    if (ok != (messages.errors == 0) || memcmp(text, data, size) != 0)
        abort();
    free(text);
    if (ok) {
        size_t printed;
        text = csg_print(&tree, &printed);
        text = mem_realloc(text, printed + 2);
        text[printed] = text[printed + 1] = 0;
        csg_parse(&again, "again.csg", text, printed, &messages);
        csg_free(&again);
        free(text);
    }
    csg_free(&tree);
    messages_free(&messages);
    return 0;
}
