// answer.c - what openscad leaves behind: its messages and its list of files.
#include "scad/answer.h"

#include "base/file.h"
#include "base/mem.h"
#include "scad/includes.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { LOG_KEPT = 1 << 18, RULE_LIMIT = 1 << 24 };

// A design may echo without end; its newest messages say why it stopped.
void scad_log_add(struct scad_log *log, const char *data, size_t size)
{
    if (!log->text)
        log->text = mem_alloc(2 * LOG_KEPT + 1);
    while (size) {
        size_t part = size < LOG_KEPT ? size : LOG_KEPT;
        if (log->size + part > 2 * LOG_KEPT) {
            size_t drop = log->size - LOG_KEPT;
            const char *line = memchr(log->text + drop, '\n', LOG_KEPT);
            if (line)
                drop = (size_t)(line + 1 - log->text);
            log->size -= drop;
            memmove(log->text, log->text + drop, log->size);
        }
        for (size_t i = 0; i < part; i++)
            log->text[log->size + i] = data[i] ? data[i] : ' ';
        log->size += part;
        data += part;
        size -= part;
    }
    log->text[log->size] = 0;
}

// The next line of *text, NULL at the end.
static const char *next_line(const char **text, size_t *length)
{
    const char *line = *text;
    if (!line || !*line)
        return NULL;
    *length = strcspn(line, "\n");
    *text = line + *length + (line[*length] == '\n');
    return line;
}

static bool begins(const char *line, size_t length, const char *prefix)
{
    size_t n = strlen(prefix);
    return length >= n && memcmp(line, prefix, n) == 0;
}

bool scad_log_has_error(const char *log)
{
    size_t length;
    for (const char *line; (line = next_line(&log, &length));)
        if (begins(line, length, "ERROR:"))
            return true;
    return false;
}

// Finds "in file NAME, line N" at the end of a message; returns the number and where it stands.
static unsigned long find_place(const char *line, size_t length, size_t *at, size_t *name,
                                size_t *name_length)
{
    static const char in_file[] = " in file ", comma_line[] = ", line ";
    const char *end = line + length, *found = NULL, *comma = NULL;
    for (const char *p = line; (p = memmem(p, (size_t)(end - p), in_file, sizeof in_file - 1)); p++)
        found = p;
    if (!found)
        return 0;
    for (const char *p = found;
         (p = memmem(p, (size_t)(end - p), comma_line, sizeof comma_line - 1)); p++)
        comma = p;
    if (!comma)
        return 0;
    *at = (size_t)(found - line);
    *name = *at + sizeof in_file - 1;
    *name_length = (size_t)(comma - line) - *name;
    return strtoul(comma + sizeof comma_line - 1, NULL, 10);
}

static size_t shown(size_t length)
{
    enum { SHOWN = 600 };
    return length < SHOWN ? length : SHOWN;
}

static bool ends_with(const char *path, const char *name)
{
    size_t length = strlen(path), n = strlen(name);
    return n <= length && strcmp(path + length - n, name) == 0 &&
           (n == length || path[length - n - 1] == '/');
}

static bool same_file(const char *a, const char *b)
{
    struct stat x, y;
    return stat(a, &x) == 0 && stat(b, &y) == 0 && x.st_dev == y.st_dev && x.st_ino == y.st_ino;
}

// openscad names a file relative to the working folder (syntax errors), to its own folder
// (evaluation) or to the main file's. NULL when there is no such file.
static char *find_file(const struct scad_result *r, const char *name, size_t length)
{
    char *own = mem_alloc(length + 1), *found = NULL;
    memcpy(own, name, length);
    own[length] = 0;
    for (uint32_t i = 0; i < r->file_count && !found; i++)
        if (ends_with(r->files[i], own) || same_file(r->files[i], own))
            found = mem_strdup(r->files[i]);
    if (!found && access(own, F_OK) == 0)
        found = mem_strdup(own);
    if (!found) {
        char *folder = file_folder(r->files[0]);
        found = file_join(folder, own);
        free(folder);
        if (access(found, F_OK) != 0) {
            free(found);
            found = NULL;
        }
    }
    free(own);
    return found;
}

// The first line that begins with `level`, without that, NULL when there is none.
static const char *find_message(const char *log, const char *level, size_t *length)
{
    for (const char *line; (line = next_line(&log, length));)
        if (begins(line, *length, level)) {
            size_t skip = strlen(level);
            while (skip < *length && line[skip] == ' ')
                skip++;
            *length -= skip;
            return line + skip;
        }
    return NULL;
}

static void set_message(const struct scad_result *r, const char *text, size_t length,
                        struct error *err)
{
    size_t at, name, name_length;
    unsigned long number = find_place(text, length, &at, &name, &name_length);
    char *file = number ? find_file(r, text + name, name_length) : NULL;
    if (file)
        error_at(err, (struct place){.file = file, .line = (uint32_t)number}, "%.*s",
                 (int)shown(at), text);
    else
        error_set(err, "%s: %.*s", r->files[0], (int)shown(length), text);
    free(file);
}

void scad_error(const struct scad_result *r, struct error *err)
{
    size_t length, last_length;
    const char *first = find_message(r->log, "ERROR:", &length);
    if (first) {
        set_message(r, first, length, err);
        return;
    }
    const char *last = "failed without a message", *log = r->log;
    last_length = strlen(last);
    for (const char *line; (line = next_line(&log, &length));)
        if (begins(line, length, "Usage:")) // what was wrong stands above
            break;
        else if (length) {
            last = line;
            last_length = length;
        }
    error_set(err, "%s: openscad: %.*s", r->files[0], (int)shown(last_length), last);
}

bool scad_warning(const struct scad_result *r, struct error *err)
{
    size_t length;
    const char *first = find_message(r->log, "WARNING:", &length);
    if (first)
        set_message(r, first, length, err);
    return first;
}

bool scad_next_message(const struct scad_result *r, const char **rest, struct scad_message *out)
{
    static const struct {
        const char *prefix;
        enum scad_level level;
    } kinds[] = {{"ECHO:", SCAD_ECHO},
                 {"TRACE:", SCAD_TRACE},
                 {"ERROR:", SCAD_ERROR},
                 {"WARNING:", SCAD_WARNING},
                 {"DEPRECATED:", SCAD_WARNING},
                 {"FONT-WARNING:", SCAD_WARNING},
                 {"EXPORT-WARNING:", SCAD_WARNING}};
    size_t length, at, name, name_length;
    for (const char *line; (line = next_line(rest, &length));)
        for (size_t k = 0; k < array_count(kinds); k++) {
            size_t skip = strlen(kinds[k].prefix);
            if (!begins(line, length, kinds[k].prefix))
                continue;
            skip += skip < length && line[skip] == ' ';
            *out = (struct scad_message){kinds[k].level, line + skip, length - skip, NULL, 0};
            unsigned long number = 0;
            if (out->level != SCAD_ECHO)
                number = find_place(out->text, out->length, &at, &name, &name_length);
            if (number)
                out->file = find_file(r, out->text + name, name_length);
            if (out->file) {
                out->line = (uint32_t)number;
                out->length = at;
            }
            return true;
        }
    return false;
}

// One line of the rule: a tab, the name with its blanks escaped, and " \" unless it is the last.
static char *file_of_rule(const char *line, size_t length)
{
    while (length && (*line == '\t' || *line == ' ')) {
        line++;
        length--;
    }
    if (length >= 2 && line[length - 1] == '\\' && line[length - 2] == ' ')
        length -= 2;
    if (!length)
        return NULL;
    char *file = mem_alloc(length + 1);
    size_t n = 0;
    for (size_t i = 0; i < length; i++)
        if (line[i] != '\\' || i + 1 == length || line[i + 1] != ' ')
            file[n++] = line[i];
    file[n] = 0;
    return file;
}

void scad_read_files(const char *rule_path, const char *path, struct scad_result *out)
{
    uint32_t capacity = out->file_count;
    char *rule = NULL;
    size_t size, length;
    scad_add_file(out, &capacity, mem_strdup(path));
    bool ruled = rule_path && file_read(rule_path, RULE_LIMIT, &rule, &size, NULL);
    if (ruled) {
        const char *rest = rule;
        next_line(&rest, &length); // the target
        for (const char *line; (line = next_line(&rest, &length));) {
            char *file = file_of_rule(line, length);
            if (file)
                scad_add_file(out, &capacity, file);
        }
        free(rule);
    }
    const char *rest = out->log;
    for (const char *line; (line = next_line(&rest, &length));) {
        size_t at, name, name_length;
        if (begins(line, length, "ERROR:") && find_place(line, length, &at, &name, &name_length)) {
            char *file = find_file(out, line + name, name_length);
            if (file)
                scad_add_file(out, &capacity, file);
        }
    }
    if (!ruled || strstr(out->log, "\nWARNING: Can't open ") ||
        begins(out->log, strlen(out->log), "WARNING: Can't open "))
        scad_add_includes(out, &capacity);
}
