// fuzz_text.c - any bytes as the arguments of a text.
#include "type/text.h"

#include "base/mem.h"

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

// Four numbers of one byte each, then strings up to a zero byte or the end.
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const double numbers[] = {10, 0, -3, 1e-9, 1e9, 1e300, INFINITY, NAN, 1, 0.5, 100, -1e6};
    enum { NUMBERS = 4, STRINGS = 7, TEXT_MAX = 64 };
    double number[NUMBERS];
    const char *string[STRINGS] = {0};

    if (size < NUMBERS)
        return 0;
    for (size_t i = 0; i < NUMBERS; i++)
        number[i] = numbers[data[i] % array_count(numbers)];
    char *copy = mem_zalloc(size + 1), *at = copy, *end = copy + size - NUMBERS;
    memcpy(copy, data + NUMBERS, size - NUMBERS);
    for (int i = 0; i < STRINGS && at < end; i++, at += strlen(at) + 1)
        string[i] = at;
    if (string[0] && strlen(string[0]) > TEXT_MAX) // nothing new but time
        copy[TEXT_MAX] = 0;

    struct text_line line = {.text = string[0],
                             .font = string[1],
                             .direction = string[2],
                             .language = string[3],
                             .script = string[4],
                             .halign = string[5],
                             .valign = string[6],
                             .size = number[0],
                             .spacing = number[1],
                             .detail = {number[2], number[3], number[3]}};
    struct messages messages = {0};
    struct outline outline;
    bool ok = text_outline(&outline, &line, (struct place){"fuzz.csg", 1, 1}, &messages);
    if (!outline.clean || (!ok && (outline.path_count || !messages.warnings)))
        abort();
    outline_free(&outline);
    messages_free(&messages);
    free(copy);
    return 0;
}
