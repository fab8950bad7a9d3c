// includes.c - the files that a .scad file names, for when openscad does not list them.
#include "scad/includes.h"

#include "base/file.h"
#include "base/mem.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

enum { ADDED_MOST = 200, SIZE_LIMIT = 1 << 24 };

void scad_add_file(struct scad_result *out, uint32_t *capacity, char *path)
{
    for (uint32_t i = 0; i < out->file_count; i++)
        if (strcmp(out->files[i], path) == 0) {
            free(path);
            return;
        }
    array_reserve(&out->files, capacity, out->file_count + 1);
    out->files[out->file_count++] = path;
}

// The same file by another name: files that include each other would give new names for ever.
static bool is_known(const struct scad_result *r, const char *path)
{
    struct stat st, other;
    if (stat(path, &st) != 0)
        return false;
    for (uint32_t i = 0; i < r->file_count; i++)
        if (stat(r->files[i], &other) == 0 && st.st_dev == other.st_dev &&
            st.st_ino == other.st_ino)
            return true;
    return false;
}

// The end of the keyword that begins at `at`, NULL when none does.
static const char *after_keyword(const char *text, const char *at)
{
    static const char *const keywords[] = {"include", "use"};
    if (at > text && (isalnum((unsigned char)at[-1]) || at[-1] == '_'))
        return NULL;
    for (size_t k = 0; k < array_count(keywords); k++)
        if (strncmp(at, keywords[k], strlen(keywords[k])) == 0)
            return at + strlen(keywords[k]);
    return NULL;
}

static void add_named(struct scad_result *out, uint32_t *capacity, const char *text,
                      const char *folder, uint32_t most)
{
    for (const char *at = text; (at = strchr(at, '<')) && out->file_count < most; at++) {
        const char *word = at, *end = strchr(at, '>');
        while (word > text && strchr(" \t\r\n", word[-1]))
            word--;
        const char *blank = word;
        while (word > text && isalpha((unsigned char)word[-1]))
            word--;
        if (!end || after_keyword(text, word) != blank || end == at + 1)
            continue;
        size_t length = (size_t)(end - at) - 1;
        char *name = mem_zalloc(length + 1);
        memcpy(name, at + 1, length);
        char *path = file_join(folder, name);
        free(name);
        if (is_known(out, path))
            free(path);
        else
            scad_add_file(out, capacity, path);
    }
}

void scad_add_includes(struct scad_result *out, uint32_t *capacity)
{
    uint32_t most = out->file_count + ADDED_MOST;
    for (uint32_t i = 0; i < out->file_count && out->file_count < most; i++) {
        char *text, *folder;
        size_t size;
        if (strcasecmp(file_extension(out->files[i]), "scad") != 0 ||
            !file_read(out->files[i], SIZE_LIMIT, &text, &size, NULL))
            continue;
        folder = file_folder(out->files[i]);
        add_named(out, capacity, text, folder, most);
        free(folder);
        free(text);
    }
}
