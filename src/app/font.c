// font.c - the file of the desktop's font for text in windows.
#include "app/font.h"

#include "base/file.h"
#include "base/mem.h"

#include <fontconfig/fontconfig.h>
#include <stdlib.h>
#include <string.h>

static char *font_file(void)
{
    char *file = NULL;
    FcPattern *wanted =
        FcNameParse((const FcChar8 *)"sans-serif:scalable=true:fontformat=TrueType");
    FcConfigSubstitute(NULL, wanted, FcMatchPattern);
    FcDefaultSubstitute(wanted);
    FcResult result;
    FcPattern *found = FcFontMatch(NULL, wanted, &result);
    FcChar8 *name, *format;
    if (found && FcPatternGetString(found, FC_FILE, 0, &name) == FcResultMatch &&
        FcPatternGetString(found, FC_FONTFORMAT, 0, &format) == FcResultMatch &&
        strcmp((const char *)format, "TrueType") == 0)
        file = mem_strdup((const char *)name);
    if (found)
        FcPatternDestroy(found);
    FcPatternDestroy(wanted);
    return file;
}

bool font_read(void **data, int *size)
{
    enum { LIMIT = 1 << 26 };
    char *file = font_file(), *content;
    size_t length;
    bool ok = file && file_read(file, LIMIT, &content, &length, NULL);
    if (ok) {
        *data = content;
        *size = (int)length;
    }
    free(file);
    return ok;
}
