// edit.h - changes to the numbers and operations of a file, on top of its text.
//
// Nodes have the numbers of struct source, arguments their order, scalars that of csg_scalar. What
// was not changed stays as it is, byte for byte; what was changed back is not changed.
#pragma once
#include "edit/source.h"

struct edit;
struct edit *edit_new(struct source *s); // holds it
void edit_delete(struct edit *e);        // accepts NULL
struct source *edit_source(const struct edit *e);

// What stands there now. A number, boolean, undef or string; false when there is none.
bool edit_scalar(const struct edit *e, uint32_t node, uint32_t argument, uint32_t scalar,
                 struct csg_value *out);
const char *edit_name(const struct edit *e, uint32_t node);

// Changes, false with a reason: numbers are finite and take the place of numbers, booleans that of
// booleans. Operations are union, difference, intersection, hull, minkowski and group.
bool edit_set_number(struct edit *e, uint32_t node, uint32_t argument, uint32_t scalar,
                     double number, struct error *err);
bool edit_set_boolean(struct edit *e, uint32_t node, uint32_t argument, uint32_t scalar,
                      bool boolean, struct error *err);
bool edit_set_operation(struct edit *e, uint32_t node, const char *name, struct error *err);
const char *const *edit_operations(void); // their names, NULL behind the last
bool edit_is_operation(const char *name);

// Changes of one thing in a row are one step until this is called: a slider let go, say.
void edit_end_step(struct edit *e);
bool edit_undo(struct edit *e); // false: nothing left
bool edit_redo(struct edit *e);
bool edit_is_changed(const struct edit *e);
uint64_t edit_version(const struct edit *e); // another after whatever changes the tree

// What is to be seen of a node, in place of its modifiers % # ! * in the file: CSG_DISABLE hides
// it, CSG_ROOT shows it alone, CSG_BACKGROUND shows it as a ghost and takes it out of the model,
// CSG_HIGHLIGHT shows it marked. They mean what they mean in the file, and are neither part of the
// text nor of the steps. Of all nodes one can be shown alone.
void edit_mark(struct edit *e, uint32_t node, uint8_t modifiers);
uint8_t edit_marks(const struct edit *e, uint32_t node);
void edit_unmark_all(struct edit *e);

// The tree as it is now; borrows from the source, which has to be held as long. For csg_free.
void edit_tree(const struct edit *e, struct csg_tree *out);
// The text as it is now, followed by two zero bytes that are not counted. The caller frees it.
// False when it would not read back as the tree.
bool edit_text(const struct edit *e, char **text, size_t *size, struct error *err);
