// frames.c - the exported texts of an animation, kept in one file.
#include "scad/frames.h"

#include "base/file.h"
#include "base/mem.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

bool scad_frames_begin(struct scad_frames *f, const char *folder, struct error *err)
{
    char *path = file_join(folder, "frames-XXXXXX");
    int fd = mkostemp(path, O_CLOEXEC);
    *f = (struct scad_frames){.file = fd < 0 ? NULL : fdopen(fd, "w+")};
    if (!f->file)
        error_set(err, "%s: %s", path, strerror(errno));
    if (fd >= 0)
        unlink(path);
    if (fd >= 0 && !f->file)
        close(fd);
    free(path);
    return f->file;
}

bool scad_frames_add(struct scad_frames *f, const struct scad_text *text, struct error *err)
{
    if (fwrite(text->text, 1, text->size, f->file) != text->size || fflush(f->file) != 0) {
        error_set(err, "temporary file of an animation: %s", strerror(errno));
        return false;
    }
    f->ends = mem_realloc(f->ends, (f->count + 1) * sizeof *f->ends);
    f->ends[f->count] = (f->count ? f->ends[f->count - 1] : 0) + text->size;
    f->count++;
    return true;
}

bool scad_read_frame(const struct scad_frames *f, uint32_t frame, struct scad_text *out,
                     struct error *err)
{
    size_t begin = frame ? f->ends[frame - 1] : 0, size = f->ends[frame] - begin;
    char *text = mem_zalloc(size + 2);
    if (fseeko(f->file, (off_t)begin, SEEK_SET) != 0 || fread(text, 1, size, f->file) != size) {
        error_set(err, "temporary file of an animation: cannot be read");
        free(text);
        return false;
    }
    *out = (struct scad_text){text, size};
    return true;
}

void scad_frames_free(struct scad_frames *f)
{
    if (f->file)
        fclose(f->file);
    free(f->ends);
    *f = (struct scad_frames){0};
}
