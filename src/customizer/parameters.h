// parameters.h - the parameters of a .scad program, as OpenSCAD's customizer shows them, and their
// values.
#pragma once
#include "base/mem.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum parameter_kind {
    PARAMETER_BOOL,   // a check box
    PARAMETER_NUMBER, // a slider, a drop-down or a number
    PARAMETER_STRING, // a text or a drop-down
    PARAMETER_VECTOR, // of numbers: one field or slider for each
    PARAMETER_SOURCE, // any other vector or range, as text
};

enum { PARAMETER_NUMBERS_MOST = 4 };

// What the parameter's kind says is in use.
struct parameter_value {
    bool boolean;
    uint32_t count; // of numbers: 1 unless a vector
    double numbers[PARAMETER_NUMBERS_MOST];
    char *text; // of a string, or source; owned
};

struct parameter_choice {
    double number;    // of a PARAMETER_NUMBER
    const char *text; // of a PARAMETER_STRING
    const char *label;
};

struct parameter {
    const char *name;
    const char *group;       // "Parameters" without one
    const char *description; // "" without one
    uint32_t line;           // of the assignment
    enum parameter_kind kind;
    bool hidden; // [Hidden]: not shown
    bool global; // [Global]: shown with every group
    // Of numbers and vectors. OpenSCAD takes values beyond the range as well, from -D and sets.
    bool ranged; // a slider from min to max, between which the initial value is
    double min, max;
    double step;          // above 0; where none is given, 1 or that of the last decimal in sight
    uint32_t length_most; // characters of a string; 0: any number
    const struct parameter_choice *choices; // a drop-down; the initial value is one of them
    uint32_t choice_count;
    struct parameter_value initial; // what the source says
    struct parameter_value value;   // to be changed in place: boolean, numbers
};

struct parameters { // {0} is valid and empty
    struct parameter *items;
    uint32_t count;
    struct arena arena;
};

// In the order of the source, hidden ones as well. Broken text gives those in front of the fault.
void parameters_read(struct parameters *out, const char *text, size_t size);
void parameters_free(struct parameters *p);                                      // leaves {0}
struct parameter *parameters_find(const struct parameters *p, const char *name); // or NULL

bool parameter_is_changed(const struct parameter *p); // against the source
void parameter_reset(struct parameter *p);
// The choice that is the value, choice_count when none is.
uint32_t parameter_choice(const struct parameter *p);
void parameter_choose(struct parameter *p, uint32_t choice);
// The nearest number of the range that is whole steps from its begin, as a slider gives it; without
// a range the number itself.
double parameter_snap(const struct parameter *p, double number);

// The value as text, as parameter sets hold it: a string as it is, all else as source. To be freed.
char *parameter_text(const struct parameter *p);
// The value from such a text. False, and nothing changes, when it is of another kind.
bool parameter_set(struct parameter *p, const char *text);

// Takes over what the user had changed when the source is read again, where name and kind are the
// same. What was changed last wins: where the source has another value than before, the source
// does.
void parameters_carry(struct parameters *now, const struct parameters *before);

// Texts about the values that differ from the source. To be freed; "" when none does.
char *parameter_definition(const struct parameter *p);     // of any: name=value, for openscad's -D
char *parameters_flags(const struct parameters *p);        // -D 'name=value' ..., for a shell
char *parameters_source_lines(const struct parameters *p); // name = value;
// All that are shown, as openscad -o x.param writes them: JSON. The title names the design.
char *parameters_json(const struct parameters *p, const char *title);
