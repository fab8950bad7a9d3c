// scheme_choose.c - the colour scheme that a user names.
#include "render/scheme_choose.h"

#include "base/file.h"
#include "base/mem.h"
#include "render/scheme_file.h"

#include <dirent.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { FILES_MOST = 1000, NAME_MOST = 64 }; // of a folder

// Where OpenSCAD seeks its own, after a place for those that only hcsg is to see.
static const struct folder {
    enum { BELOW_CONFIG, BELOW_HOME, ABSOLUTE } where; // $XDG_CONFIG_HOME, which OpenSCAD ignores
    const char *path;
} folders[] = {
    {BELOW_CONFIG, "hcsg/color-schemes"},
    {BELOW_HOME, ".config/OpenSCAD/color-schemes/render"},
    {ABSOLUTE, "/usr/local/share/openscad/color-schemes/render"},
    {ABSOLUTE, "/usr/share/openscad/color-schemes/render"},
};

// The caller frees it; NULL: there is no such place.
static char *folder_path(const struct folder *f)
{
    const char *config = getenv("XDG_CONFIG_HOME"), *home = getenv("HOME");
    if (f->where == ABSOLUTE)
        return mem_strdup(f->path);
    if (f->where == BELOW_CONFIG && config && config[0] == '/') // the standard ignores others
        return file_join(config, f->path);
    if (!home || !*home)
        return NULL;
    char *base = f->where == BELOW_HOME ? mem_strdup(home) : file_join(home, ".config");
    char *path = file_join(base, f->path);
    free(base);
    return path;
}

static int compare_names(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

// The paths of the JSON files there, in order; returns their number.
static uint32_t list_files(const char *folder, char *paths[FILES_MOST])
{
    uint32_t count = 0;
    DIR *dir = opendir(folder);
    for (struct dirent *e; dir && count < FILES_MOST && (e = readdir(dir));)
        if (strcasecmp(file_extension(e->d_name), "json") == 0)
            paths[count++] = file_join(folder, e->d_name);
    if (dir)
        closedir(dir);
    qsort(paths, count, sizeof *paths, compare_names);
    return count;
}

struct search {
    const char *name;
    struct scheme *found;
    struct error wrong; // the first file that is none, or why the one sought cannot be used
    char others[256];   // ", Name" of each
    bool is_found, ends;
};

static void search_file(struct search *s, const char *path)
{
    char name[NAME_MOST];
    struct error err;
    bool named = scheme_read_name(name, sizeof name, path, &err);
    if (named && strcmp(name, s->name) == 0) {
        s->is_found = scheme_read(s->found, path, &s->wrong);
        s->found->name = s->name;
        s->ends = true;
    } else if (named) {
        size_t used = strlen(s->others);
        if (!scheme_find(name, NULL))
            snprintf(s->others + used, sizeof s->others - used, ", %s", name);
    } else if (!s->wrong.text[0]) {
        s->wrong = err;
    }
}

static void search_folder(struct search *s, const char *folder)
{
    char *paths[FILES_MOST];
    uint32_t count = list_files(folder, paths);
    for (uint32_t i = 0; i < count; i++) {
        if (!s->ends)
            search_file(s, paths[i]);
        free(paths[i]);
    }
}

static const struct scheme *search(const char *name, struct scheme *own, struct error *err)
{
    struct search s = {.name = name, .found = own};
    for (size_t i = 0; i < array_count(folders) && !s.ends; i++) {
        char *path = folder_path(&folders[i]);
        if (path)
            search_folder(&s, path);
        free(path);
    }
    if (s.is_found)
        return own;
    if (s.ends) {
        *err = s.wrong;
        return NULL;
    }
    struct error known = *err;
    error_set(err, "%s%s%s%s", known.text, s.others, s.wrong.text[0] ? "; " : "", s.wrong.text);
    return NULL;
}

const struct scheme *scheme_choose(const char *name, struct scheme *own, struct error *err)
{
    uint32_t count;
    if (!*name)
        return scheme_list(&count);
    if (strchr(name, '/') || strcasecmp(file_extension(name), "json") == 0)
        return scheme_read(own, name, err) ? own : NULL;
    const struct scheme *built_in = scheme_find(name, err);
    return built_in ? built_in : search(name, own, err);
}

void scheme_print_folders(FILE *out)
{
    fputs("Colour schemes:\n", out);
    for (size_t i = 0; i < array_count(folders); i++) {
        char *path = folder_path(&folders[i]);
        if (path)
            fprintf(out, "  %s\n", path);
        free(path);
    }
}
