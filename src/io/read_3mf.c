// read_3mf.c - 3MF packages.
#include "io/read_3mf.h"
