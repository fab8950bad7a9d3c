// report.c - what the user is told about a load.
#include "app/report.h"

#include "base/mem.h"

#include <string.h>

static size_t put_message(char *text, size_t used, size_t size, const struct message *m)
{
    const char *source = m->source ? m->source : "";
    int n = snprintf(text + used, size - used, "%s%s%s%s", used ? "\n" : "", m->text,
                     *source ? "\n" : "", source);
    return n > 0 && (size_t)n < size - used ? used + (size_t)n : size - 1;
}

char *report_summary(const struct messages *m)
{
    enum { SHOWN = 4, SIZE = 8192 };
    char *text = mem_zalloc(SIZE);
    size_t used = 0;
    uint32_t shown = 0;
    for (int warnings = 0; warnings < 2; warnings++)
        for (uint32_t i = 0; i < m->count && shown < SHOWN; i++)
            if ((m->items[i].level == MESSAGE_WARNING) == warnings) {
                used = put_message(text, used, SIZE, &m->items[i]);
                shown++;
            }
    if (m->warnings + m->errors > shown)
        snprintf(text + used, SIZE - used, "\n(and %u more)", m->warnings + m->errors - shown);
    return text;
}

void report_log(const char *log, struct messages *m)
{
    static const struct {
        const char *prefix;
        enum message_level level;
    } kinds[] = {{"ERROR: ", MESSAGE_ERROR},
                 {"WARNING: ", MESSAGE_WARNING},
                 {"DEPRECATED: ", MESSAGE_WARNING}};
    while (*log) {
        size_t length = strcspn(log, "\n");
        if (strncmp(log, "ECHO: ", 6) == 0)
            fprintf(stderr, "%.*s\n", (int)length, log);
        for (size_t k = 0; k < array_count(kinds); k++) {
            size_t skip = strlen(kinds[k].prefix);
            if (strncmp(log, kinds[k].prefix, skip) == 0)
                messages_add(m, kinds[k].level, (struct place){0}, "%.*s", (int)(length - skip),
                             log + skip);
        }
        log += length + (log[length] == '\n');
    }
}
