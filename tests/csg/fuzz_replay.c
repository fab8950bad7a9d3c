// fuzz_replay.c - runs the fuzz target over the files named, without libFuzzer.
#include "base/file.h"

#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int main(int argc, char **argv)
{
    for (int i = 1; i < argc; i++) {
        struct error err;
        char *data;
        size_t size;
        if (!file_read(argv[i], (size_t)1 << 30, &data, &size, &err)) {
            fprintf(stderr, "%s\n", err.text);
            return 1;
        }
        LLVMFuzzerTestOneInput((const uint8_t *)data, size);
        free(data);
    }
    return 0;
}
