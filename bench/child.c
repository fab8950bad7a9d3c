// child.c - another program run to its end, timed.
#include "child.h"

#include "base/clock.h"
#include "base/mem.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

// In a process group of its own, so that what it starts ends with it.
static int start(pid_t *pid, const char *const *argv, const int ends[2], bool loud)
{
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    posix_spawn_file_actions_init(&actions);
    posix_spawnattr_init(&attributes);
    posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, ends[1], 1);
    if (!loud)
        posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    posix_spawnattr_setpgroup(&attributes, 0);
    // posix_spawn leaves the texts alone; its type is older than const.
    int fault = posix_spawnp(pid, argv[0], &actions, &attributes, (char *const *)argv, environ);
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    return fault;
}

// Reads until the child closes its output. False when the time is over before that.
static bool collect(struct child *c, int fd, double end)
{
    uint32_t capacity = 0;
    for (;;) {
        double left = end - clock_seconds();
        struct pollfd wait = {.fd = fd, .events = POLLIN};
        if (left <= 0 || poll(&wait, 1, (int)(left * 1e3) + 1) == 0)
            return false;
        array_reserve(&c->output, &capacity, c->size + 4096);
        ssize_t got = read(fd, c->output + c->size, 4095);
        if (got > 0)
            c->size += (size_t)got;
        c->output[c->size] = 0;
        if (got == 0 || (got < 0 && errno != EINTR))
            return true;
    }
}

bool child_run(struct child *out, const char *const *argv, double limit, bool loud,
               struct error *err)
{
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) {
        error_set(err, "%s: %s", argv[0], strerror(errno));
        return false;
    }
    struct child c = {0};
    double begin = clock_seconds();
    pid_t pid;
    int fault = start(&pid, argv, ends, loud);
    close(ends[1]);
    if (fault) {
        close(ends[0]);
        error_set(err, "%s: %s", argv[0], strerror(fault));
        return false;
    }
    c.late = !collect(&c, ends[0], begin + limit);
    close(ends[0]);
    if (c.late)
        kill(-pid, SIGTERM);
    int status = 0;
    struct rusage usage = {0};
    while (wait4(pid, &status, 0, &usage) < 0 && errno == EINTR)
        ;
    c.peak_bytes = (size_t)usage.ru_maxrss * 1024;
    c.seconds = clock_seconds() - begin;
    c.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    if (!c.output)
        c.output = mem_strdup("");
    *out = c;
    return true;
}

void child_free(struct child *c)
{
    free(c->output);
    *c = (struct child){0};
}
