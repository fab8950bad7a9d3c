// texts.c - values of parameters as flags for a shell and as lines of source.
#include "base/locale.h"
#include "customizer/value.h"

#include <stdlib.h>
#include <string.h>

static void say_definition(struct words *out, const struct parameter *p, const char *equals)
{
    words_say(out, p->name);
    words_say(out, equals);
    value_say(out, p->kind, &p->value, true);
}

char *parameter_definition(const struct parameter *p)
{
    struct own_locale own = locale_enter();
    struct words out = {0};
    say_definition(&out, p, "=");
    locale_leave(&own);
    return out.data;
}

// In quotes of which a shell knows no exceptions but the quote itself.
static void say_shell_quoted(struct words *out, const char *text)
{
    words_say(out, "'");
    for (size_t plain; *text; text += plain + (text[plain] != 0)) {
        plain = strcspn(text, "'");
        words_add(out, text, plain);
        if (text[plain])
            words_say(out, "'\\''");
    }
    words_say(out, "'");
}

char *parameters_flags(const struct parameters *p)
{
    struct own_locale own = locale_enter();
    struct words out = {0}, one = {0};
    words_say(&out, "");
    for (uint32_t i = 0; i < p->count; i++) {
        if (!parameter_is_changed(&p->items[i]))
            continue;
        one.size = 0;
        say_definition(&one, &p->items[i], "=");
        words_say(&out, out.size ? " -D " : "-D ");
        say_shell_quoted(&out, one.data);
    }
    free(one.data);
    locale_leave(&own);
    return out.data;
}

char *parameters_source_lines(const struct parameters *p)
{
    struct own_locale own = locale_enter();
    struct words out = {0};
    words_say(&out, "");
    for (uint32_t i = 0; i < p->count; i++) {
        if (!parameter_is_changed(&p->items[i]))
            continue;
        say_definition(&out, &p->items[i], " = ");
        words_say(&out, ";\n");
    }
    locale_leave(&own);
    return out.data;
}
