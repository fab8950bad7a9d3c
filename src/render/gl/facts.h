// facts.h - what a driver can do, asked for inside of its context.
#pragma once
#include "render/gl/context.h"

void gl_facts_ask(struct gl_facts *facts); // all but `found`
