// xml.h - the elements of an XML file that a format knows, as they come, through expat.
#pragma once
#include "base/error.h"

#include <stddef.h>

// Where the reader is: the element it is in, numbered by the format. 0 is outside of all.
struct xml_element {
    int parent;
    const char *name; // without its namespace
    int id;           // not 0
};

struct xml;

// The elements of a format, each in its place; whatever else stands in a file is passed over, with
// all that is in it. The functions return false when the file is wrong, after xml_error.
struct xml_format {
    const char *xmlns; // of all elements, or NULL: any
    const struct xml_element *elements;
    size_t element_count;
    // `attributes`: names and values by turns, then NULL; xml_attribute finds one.
    bool (*open)(void *user, struct xml *x, int id, const char **attributes);
    // `text`: what stood in it outside of further elements; nothing when that is more than
    // XML_TEXT_MOST bytes.
    bool (*close)(void *user, struct xml *x, int id, const char *text);
};

enum { XML_TEXT_MOST = 120 };

struct xml *xml_new(const char *path, const struct xml_format *format, void *user,
                    struct error *err);
void xml_delete(struct xml *x);
// The next part of the file. Refuses files that declare entities.
bool xml_push(struct xml *x, const char *data, size_t size);
bool xml_finish(struct xml *x);

void xml_error(struct xml *x, const char *format, ...) __attribute__((format(printf, 2, 3)));

// The value of an attribute, or NULL. With a namespace: its address, XML_SEPARATOR, the name.
#define XML_SEPARATOR "\n"
const char *xml_attribute(const char **attributes, const char *name);
// The whole text, without blanks around it, as a finite number or a whole one.
bool xml_number(const struct xml *x, const char *text, double *out);
bool xml_next_number(const struct xml *x, const char **text, double *out); // of several
bool xml_is_blank(const char *text);
bool xml_count(const char *text, uint32_t *out);
