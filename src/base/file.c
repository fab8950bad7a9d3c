// file.c - whole files in and out.
#include "base/file.h"

#include "base/hash.h"
#include "base/mem.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

bool file_read(const char *path, size_t limit, char **data, size_t *size, struct error *err)
{
    bool ok = false;
    char *buffer = NULL;
    size_t used = 0, capacity = 1 << 16;
    struct stat st;
    bool standard = strcmp(path, "-") == 0;
    int fd = standard ? STDIN_FILENO : open(path, O_RDONLY | O_CLOEXEC);

    if (fd < 0 || fstat(fd, &st) != 0) {
        error_set(err, "%s: %s", path, strerror(errno));
        goto done;
    }
    if (S_ISDIR(st.st_mode)) {
        error_set(err, "%s: is a folder, not a file", path);
        goto done;
    }
    if (S_ISREG(st.st_mode) && st.st_size > 0) {
        if ((unsigned long long)st.st_size > limit) {
            error_set(err, "%s: %lld bytes, more than the limit of %zu", path,
                      (long long)st.st_size, limit);
            goto done;
        }
        capacity = (size_t)st.st_size + 1;
    }
    buffer = mem_alloc(capacity + 2);
    for (;;) {
        if (used == capacity) {
            capacity *= 2;
            buffer = mem_realloc(buffer, capacity + 2);
        }
        ssize_t n = read(fd, buffer + used, capacity - used);
        if (n < 0 && errno == EINTR)
            continue;
        if (n < 0) {
            error_set(err, "%s: %s", path, strerror(errno));
            goto done;
        }
        if (n == 0)
            break;
        used += (size_t)n;
        if (used > limit) {
            error_set(err, "%s: more than the limit of %zu bytes", path, limit);
            goto done;
        }
    }
    buffer[used] = buffer[used + 1] = 0;
    *data = buffer;
    *size = used;
    buffer = NULL;
    ok = true;
done:
    free(buffer);
    if (fd >= 0 && !standard)
        close(fd);
    return ok;
}

static bool write_all(int fd, const char *data, size_t size)
{
    while (size) {
        ssize_t n = write(fd, data, size);
        if (n < 0 && errno == EINTR)
            continue;
        if (n <= 0)
            return false;
        data += n;
        size -= (size_t)n;
    }
    return true;
}

// A file in the folder of `path` that has no name yet: whatever ends the program, nothing stays
// behind. -1 where there is no such thing.
static int open_nameless(const char *path)
{
    char *folder = file_folder(path);
    bool can_be_named = access("/proc/self/fd", X_OK) == 0;
    int fd = can_be_named ? open(folder, O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666) : -1;
    free(folder);
    return fd;
}

// Gives it a name beside `path`, which goes to `name`.
static bool name_beside(int fd, const char *path, char *name, size_t size)
{
    char own[32];
    bool ok = false;
    snprintf(own, sizeof own, "/proc/self/fd/%d", fd);
    errno = EEXIST;
    for (unsigned i = 0; !ok && errno == EEXIST; i++) {
        snprintf(name, size, "%s.%d-%u", path, (int)getpid(), i);
        ok = linkat(AT_FDCWD, own, AT_FDCWD, name, AT_SYMLINK_FOLLOW) == 0;
    }
    return ok;
}

// A new file beside `path`; its name goes to `name`, which is `size` long.
static int open_beside(const char *path, char *name, size_t size)
{
    int fd = -1;
    errno = EEXIST;
    for (unsigned i = 0; fd < 0 && errno == EEXIST; i++) {
        snprintf(name, size, "%s.%d-%u", path, (int)getpid(), i);
        fd = open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    }
    return fd;
}

// Where a link leads, also to a file that is not there yet. The caller frees it.
static char *follow_links(const char *path)
{
    enum { LINKS_MOST = 40 };
    char *real = realpath(path, NULL);
    if (real)
        return real;
    real = mem_strdup(path);
    for (int i = 0; i < LINKS_MOST; i++) {
        char link[PATH_MAX];
        ssize_t n = readlink(real, link, sizeof link - 1);
        if (n < 0)
            break;
        link[n] = 0;
        char *folder = file_folder(real);
        free(real);
        real = file_join(folder, link);
        free(folder);
    }
    return real;
}

// `old`: the file that is there, NULL without one; its mode stays.
static bool write_beside(const char *path, const struct stat *old, const void *data, size_t size)
{
    char *target = follow_links(path); // a link stays one
    size_t room = strlen(target) + 32;
    char *name = mem_alloc(room);
    int fd = open_nameless(target);
    bool nameless = fd >= 0;
    if (!nameless)
        fd = open_beside(target, name, room);
    if (fd >= 0 && old)
        (void)!fchmod(fd, old->st_mode & 0777); // some file systems have no modes
    bool ok = fd >= 0 && write_all(fd, data, size);
    if (ok && nameless) {
        ok = name_beside(fd, target, name, room);
        nameless = !ok;
    }
    int saved = errno;
    if (fd >= 0 && close(fd) != 0 && ok) {
        ok = false;
        saved = errno;
    }
    if (ok && rename(name, target) != 0) {
        ok = false;
        saved = errno;
    }
    if (fd >= 0 && !ok && !nameless)
        unlink(name);
    free(name);
    free(target);
    errno = saved;
    return ok;
}

// Pipes and devices cannot be renamed over.
static bool write_in_place(const char *path, const void *data, size_t size)
{
    int fd = open(path, O_WRONLY | O_CLOEXEC);
    bool ok = fd >= 0 && write_all(fd, data, size);
    int saved = errno;
    if (fd >= 0)
        close(fd);
    errno = saved;
    return ok;
}

bool file_write(const char *path, const void *data, size_t size, struct error *err)
{
    struct stat st;
    bool ok, standard = strcmp(path, "-") == 0;
    bool exists = !standard && stat(path, &st) == 0;
    bool refused = !standard && (exists ? access(path, W_OK) != 0 : errno == ELOOP);
    if (standard)
        ok = write_all(STDOUT_FILENO, data, size);
    else if (refused)
        ok = false; // errno says why; renaming would pass over it
    else if (exists && !S_ISREG(st.st_mode))
        ok = write_in_place(path, data, size);
    else
        ok = write_beside(path, exists ? &st : NULL, data, size);
    if (!ok)
        error_set(err, "%s: %s", standard ? "standard output" : path, strerror(errno));
    return ok;
}

uint64_t file_stamp(const char *path)
{
    struct stat st;
    if (stat(path, &st) != 0)
        return 0;
    const uint64_t parts[] = {(uint64_t)st.st_dev, (uint64_t)st.st_ino, (uint64_t)st.st_size,
                              (uint64_t)st.st_mtim.tv_sec, (uint64_t)st.st_mtim.tv_nsec};
    return hash_bytes(1, parts, sizeof parts);
}

char *file_folder(const char *path)
{
    const char *slash = strrchr(path, '/');
    if (!slash)
        return mem_strdup(".");
    size_t length = slash == path ? 1 : (size_t)(slash - path);
    char *folder = mem_alloc(length + 1);
    memcpy(folder, path, length);
    folder[length] = 0;
    return folder;
}

char *file_join(const char *folder, const char *name)
{
    if (name[0] == '/' || strcmp(folder, ".") == 0)
        return mem_strdup(name);
    size_t size = strlen(folder) + strlen(name) + 2;
    char *joined = mem_alloc(size);
    snprintf(joined, size, "%s/%s", folder, name);
    return joined;
}

const char *file_extension(const char *path)
{
    const char *slash = strrchr(path, '/'), *dot = strrchr(slash ? slash : path, '.');
    return dot ? dot + 1 : "";
}
