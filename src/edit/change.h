// change.h - what edits, their steps and their writers share.
#pragma once
#include "edit/edit.h"

#define CHANGE_NAME UINT32_MAX // as `argument`: the node's name

struct change_place {
    uint32_t node, argument, scalar;
};

struct change { // of a scalar or a name from what the file says
    struct change_place place;
    struct csg_value value; // of a name: a string that lives as long as the program
};

struct step {
    struct change_place place;
    struct csg_value before, after;
};

struct mark {
    uint32_t node;
    uint8_t modifiers;
};

struct edit {
    struct source *source;
    struct change *changes; // by place
    uint32_t change_count, change_room;
    struct step *steps; // the first `done` of them are done, the others undone
    uint32_t step_count, step_room, done;
    bool open;          // the newest step may go on
    struct mark *marks; // by node
    uint32_t mark_count, mark_room;
    uint64_t version;
};
