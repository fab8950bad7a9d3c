// number.h - numbers as text.
#pragma once

enum { NUMBER_TEXT = 32 };

// Of `least` digits or more, up to `most`, as few as read back as the same number; with a point in
// every locale. Returns the length.
int number_shortest(char out[NUMBER_TEXT], double number, int least, int most);
