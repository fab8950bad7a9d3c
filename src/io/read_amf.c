// read_amf.c - AMF meshes, plain or zipped.
#include "io/read_amf.h"
