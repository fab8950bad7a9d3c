// file.c - whole files in and out.
#include "base/file.h"

#include "base/mem.h"

#include <errno.h>
#include <fcntl.h>
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
    int fd = standard ? STDIN_FILENO : open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);

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

bool file_write(const char *path, const void *data, size_t size, struct error *err)
{
    if (strcmp(path, "-") == 0) {
        if (write_all(STDOUT_FILENO, data, size))
            return true;
        error_set(err, "standard output: %s", strerror(errno));
        return false;
    }
    struct stat st;
    if (stat(path, &st) == 0 && !S_ISREG(st.st_mode)) { // a pipe or a device: no renaming
        int fd = open(path, O_WRONLY | O_CLOEXEC);
        bool ok = fd >= 0 && write_all(fd, data, size);
        if (!ok)
            error_set(err, "%s: %s", path, strerror(errno));
        if (fd >= 0)
            close(fd);
        return ok;
    }
    size_t length = strlen(path);
    char *temporary = mem_alloc(length + 16);
    snprintf(temporary, length + 16, "%s.XXXXXX", path);
    int fd = mkostemp(temporary, O_CLOEXEC);
    if (fd < 0) {
        error_set(err, "%s: %s", path, strerror(errno));
        free(temporary);
        return false;
    }
    mode_t mask = umask(0);
    umask(mask);
    bool ok = fchmod(fd, 0666 & ~mask) == 0 && write_all(fd, data, size);
    int saved = errno;
    if (close(fd) != 0 && ok) {
        ok = false;
        saved = errno;
    }
    if (ok && rename(temporary, path) != 0) {
        ok = false;
        saved = errno;
    }
    if (!ok) {
        unlink(temporary);
        error_set(err, "%s: %s", path, strerror(saved));
    }
    free(temporary);
    return ok;
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
