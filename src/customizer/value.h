// value.h - values of parameters: from literals and back to text.
#pragma once
#include "customizer/literal.h"
#include "customizer/parameters.h"

enum parameter_kind value_kind(const struct literal *literal); // of any but undef
// The value takes its text anew. False, and nothing changes, when the literal is of another kind.
bool value_from(struct parameter_value *value, enum parameter_kind kind,
                const struct literal *literal);
bool value_equal(enum parameter_kind kind, const struct parameter_value *a,
                 const struct parameter_value *b);
void value_copy(struct parameter_value *to, const struct parameter_value *from);
void value_say(struct words *out, enum parameter_kind kind, const struct parameter_value *value,
               bool quoted); // as source, or strings as they are
