// package.c - the files in a zip archive in memory, through libzip.
#include "io/package.h"

#include "base/mem.h"

#include <stdlib.h>
#include <string.h>
#include <zip.h>

// Models are text of numbers, which shrinks to a tenth; bombs grow a thousandfold.
enum { RATIO_MOST = 256, PART = 1 << 16 };
#define ALWAYS_ALLOWED ((uint64_t)1 << 20)
#define UNPACKED_MOST  ((uint64_t)1 << 31)

struct package {
    zip_t *zip;
    const char *path;
    uint64_t limit, unpacked; // bytes, of all files read
};

bool package_is_zip(const char *data, size_t size)
{
    return size >= 4 && memcmp(data, "PK\3\4", 4) == 0;
}

struct package *package_open(const char *path, const char *data, size_t size, struct error *err)
{
    zip_error_t why;
    zip_error_init(&why);
    zip_source_t *source = zip_source_buffer_create(data, size, 0, &why);
    zip_t *zip = source ? zip_open_from_source(source, ZIP_RDONLY, &why) : NULL;
    struct package *p = NULL;
    if (zip) {
        uint64_t limit = ALWAYS_ALLOWED + (uint64_t)size * RATIO_MOST;
        p = mem_alloc(sizeof *p);
        *p = (struct package){
            .zip = zip, .path = path, .limit = limit < UNPACKED_MOST ? limit : UNPACKED_MOST};
    } else {
        error_set(err, "%s: zip: %s", path, zip_error_strerror(&why));
        zip_source_free(source);
    }
    zip_error_fini(&why);
    return p;
}

void package_close(struct package *p)
{
    if (!p)
        return;
    zip_discard(p->zip);
    free(p);
}

int64_t package_count(const struct package *p)
{
    return zip_get_num_entries(p->zip, 0);
}

const char *package_name(const struct package *p, int64_t file)
{
    return zip_get_name(p->zip, (zip_uint64_t)file, 0);
}

int64_t package_find(const struct package *p, const char *name)
{
    int64_t file = zip_name_locate(p->zip, name, ZIP_FL_ENC_GUESS);
    return file < 0 ? PACKAGE_NONE : file;
}

static bool hand_over(struct package *p, zip_file_t *file,
                      bool (*take)(void *user, const char *data, size_t size), void *user,
                      struct error *err)
{
    char *part = mem_alloc(PART);
    bool ok = true;
    for (int64_t n; ok && (n = zip_fread(file, part, PART)) != 0;) {
        p->unpacked += n > 0 ? (uint64_t)n : 0;
        ok = n > 0 && p->unpacked <= p->limit;
        if (n < 0)
            error_set(err, "%s: zip: %s", p->path, zip_file_strerror(file));
        else if (!ok)
            error_set(err, "%s: zip: unpacks to more than %llu bytes", p->path,
                      (unsigned long long)p->limit);
        else
            ok = take(user, part, (size_t)n);
    }
    free(part);
    return ok;
}

bool package_read(struct package *p, int64_t file,
                  bool (*take)(void *user, const char *data, size_t size), void *user,
                  struct error *err)
{
    zip_file_t *open = zip_fopen_index(p->zip, (zip_uint64_t)file, 0);
    if (!open) {
        error_set(err, "%s: zip: %s", p->path, zip_strerror(p->zip));
        return false;
    }
    bool ok = hand_over(p, open, take, user, err);
    zip_fclose(open);
    return ok;
}
