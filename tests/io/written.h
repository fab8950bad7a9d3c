// written.h - a file in a folder of its own, for tests of what is written.
#pragma once
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

static char written_folder[] = "/tmp/hcsg-written-XXXXXX", written_path[64];

static inline int written_setup(void **state)
{
    (void)state;
    if (!mkdtemp(written_folder))
        return -1;
    snprintf(written_path, sizeof written_path, "%s/a", written_folder);
    return 0;
}

static inline int written_teardown(void **state)
{
    (void)state;
    unlink(written_path);
    return rmdir(written_folder); // fails when a temporary file was left
}
