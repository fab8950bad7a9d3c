// shared.h - what C and the shaders agree on: constants, numbers of bindings, layouts of records.
// Compiled as both. Records hold only uint, int, float, double and arrays of them, whose places are the
// same in C and std430; constants are #define.
#pragma once
#ifndef GL_core_profile
#include <stdint.h>
#define uint uint32_t
#endif

#define GROUP_SIZE 256 // invocations of a work group, where nothing else is said

#ifndef GL_core_profile
#undef uint
#endif
