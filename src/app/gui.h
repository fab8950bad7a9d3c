// gui.h - text and controls over the picture: what the panels need of Dear ImGui, none of whose
// types show. There is one window's worth of it, as in the library. Lengths are in GLFW's units of
// the window, from its upper left; names are unique within a window.
#pragma once
#include <stdbool.h>
#include <stddef.h>

struct GLFWwindow;

// For the window whose context is current. Its callbacks go on being called.
void gui_start(struct GLFWwindow *window);
void gui_stop(void); // before the window goes; harmless without gui_start

// After an event a frame finds its layout within this many.
enum { GUI_SETTLES = 3 };
void gui_begin(void);
void gui_end(void); // paints over what the framebuffer holds

bool gui_is_over(double x, double y); // whether a window, but no strip, is there
bool gui_is_typed_into(void);         // the characters are a control's
bool gui_is_steered(void);            // a control has the focus: arrows, space, Escape are its own

struct gui_box {
    float x, y, width, height;
};
float gui_density(void); // pixels of the framebuffer for each unit
float gui_em(void);      // the height of a text: the measure of all
float gui_strip(void);   // height of a GUI_STRIP of one row
struct gui_box gui_window_size(void);

enum gui_frame {
    GUI_STRIP, // one row without a frame, which the pointer goes through
    GUI_DOCK,  // fills the box
    GUI_FLOAT, // as large as its content, up to the box, in its middle
};
// Draw the content when true; gui_window_end in any case. *open, unless NULL, becomes false when
// the window is closed by its button.
bool gui_window(const char *title, enum gui_frame frame, const struct gui_box *box, bool *open);
void gui_window_end(void);

enum gui_tone { GUI_PLAIN, GUI_DIM, GUI_KEY, GUI_WARNING, GUI_ERROR };
void gui_text(enum gui_tone tone, const char *utf8);
void gui_wrapped(enum gui_tone tone, const char *utf8);
float gui_text_width(const char *utf8);
void gui_gap(void);
void gui_beside(
    float x); // the next one stands in the same row, so far from the left; 0: behind the last
void gui_hint(const char *utf8);                    // shows while the pointer is over the last one
bool gui_row(enum gui_tone tone, const char *utf8); // a text that can be clicked; wraps
// Names within count apart from those of other numbers.
void gui_scope_begin(unsigned number);
void gui_scope_end(void);

// What stands between counts as one, of which others can stand beside.
void gui_group_begin(void);
void gui_group_end(void);

// Controls say what they are named for after "##" is not shown; true when the value was changed.
bool gui_check(const char *label, bool *value);
bool gui_number(const char *label, double *value, double step); // step 0: without buttons
bool gui_slider(const char *label, double *value, double min, double max);
bool gui_input(const char *label, const char *hint, char *text, size_t size);
bool gui_button(const char *label);
bool gui_small_button(const char *label); // as high as a text
bool gui_section(const char *label);      // open at first; draw what it holds when true
void gui_fill_width(float but);           // the next control takes the rest of the row, but this
// Call gui_choice for each while true, then the end.
bool gui_choices_begin(const char *label, const char *shown);
bool gui_choice(const char *label, bool chosen); // true when it is taken now
void gui_choices_end(void);

void gui_copy(const char *utf8);
const char *gui_pasted(void); // "" for none; good until the next call
