// input.c - the tree of the input file, read from a .csg or exported by openscad from a .scad.
#include "command/input.h"

#include "base/file.h"

#include <strings.h>

bool input_read(struct input *out, const struct request *r, struct messages *messages)
{
    *out = (struct input){0};
    if (strcasecmp(file_extension(r->input), "scad") != 0)
        return csg_parse_file(&out->tree, r->input, messages);
    struct error err;
    bool exported = scad_export(r->input, NULL, &out->scad, &err);
    if (!exported) {
        messages_add(messages, MESSAGE_ERROR, (struct place){0}, "%s", err.text);
        return false;
    }
    fputs(out->scad.log ? out->scad.log : "", stderr);
    return csg_parse(&out->tree, out->scad.name, out->scad.text, out->scad.size, messages);
}

void input_free(struct input *in)
{
    csg_free(&in->tree);
    scad_result_free(&in->scad);
}
