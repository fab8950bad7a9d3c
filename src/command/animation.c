// animation.c - one frame of an animation as a request of its own.
#include "command/animation.h"

#include "base/file.h"
#include "base/mem.h"

#include <stdlib.h>
#include <string.h>

static char *numbered(const char *path, uint32_t number)
{
    const char *extension = file_extension(path);
    size_t stem = *extension ? (size_t)(extension - 1 - path) : strlen(path);
    size_t size = strlen(path) + 16;
    char *name = mem_alloc(size);
    snprintf(name, size, "%.*s%05u%s", (int)stem, path, number, path + stem);
    return name;
}

void animation_frame(struct request *out, const struct request *r, uint32_t number)
{
    *out = *r;
    if (!r->frames)
        return;
    for (uint32_t i = 0; i < r->output_count; i++)
        out->outputs[i].path = numbered(r->outputs[i].path, number);
    if (r->summary_file && strcmp(r->summary_file, "-") != 0)
        out->summary_file = numbered(r->summary_file, number);
}

void animation_frame_free(struct request *frame)
{
    if (!frame->frames)
        return;
    for (uint32_t i = 0; i < frame->output_count; i++)
        free((char *)(uintptr_t)frame->outputs[i].path);
    if (frame->summary_file && strcmp(frame->summary_file, "-") != 0)
        free((char *)(uintptr_t)frame->summary_file);
}
