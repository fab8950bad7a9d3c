// scan.h - the scanners and parsers that flex and bison make, at the end of the .l files.
#pragma once
#include "customizer/parser.h"

// Call the functions of parser.h. False when the text does not parse.
bool scad_parse(struct scad_parser *p);
bool annotation_parse(struct annotation_parser *p, const char *text, size_t size);
