// fuzz_customizer.c - any bytes as a program; what its parameters say of themselves is read again.
#include "customizer/parameters.h"

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void check(struct parameter *p)
{
    char *text = parameter_text(p), *again;
    if (p->choice_count && parameter_choice(p) == p->choice_count)
        abort();
    if (!(p->step > 0) || (p->ranged && !(p->min < p->max)) || parameter_is_changed(p))
        abort();
    if (!parameter_set(p, text) || parameter_is_changed(p))
        abort();
    again = parameter_text(p);
    if (strcmp(text, again) != 0)
        abort();
    for (uint32_t i = 0; i < p->choice_count; i++)
        parameter_choose(p, i);
    free(text);
    free(again);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct parameters p, q;
    parameters_read(&p, (const char *)data, size);
    parameters_read(&q, (const char *)data, size);
    for (uint32_t i = 0; i < p.count; i++)
        check(&p.items[i]);
    parameters_carry(&q, &p);
    free(parameters_flags(&q));
    char *lines = parameters_source_lines(&q);
    parameters_free(&p);
    parameters_read(&p, lines, strlen(lines));
    free(lines);
    free(parameters_json(&p, ""));
    parameters_free(&p);
    parameters_free(&q);
    return 0;
}
