// style.c - how pictures are taken, beyond what OpenSCAD knows.
#include "command/style.h"

#include "base/mem.h"
#include "command/flags.h"

#include <stdlib.h>
#include <string.h>

#define MARGIN 0.05 // where none is named

// Reads a number that is not negative and moves *text behind it.
static bool take_number(const char **text, double *out)
{
    char *end;
    *out = strtod(*text, &end);
    bool ok = end != *text && isfinite(*out) && *out >= 0;
    *text = end;
    return ok;
}

static bool set_fit(struct style *out, const struct given *given, struct error *err)
{
    if (!given->fit.count)
        return true;
    const char *text = given->fit.items[given->fit.count - 1], *at = text;
    out->fits = true;
    out->margin_is_share = true;
    out->margin = MARGIN;
    if (!*text)
        return true;
    if (take_number(&at, &out->margin)) {
        out->margin_is_share = *at == '%';
        if (out->margin_is_share) {
            out->margin /= 100;
            at++;
        }
        int shorter = given->size[0] < given->size[1] ? given->size[0] : given->size[1];
        if (!*at && 2 * style_margin(out, given->size[0], given->size[1]) <= shorter - 1)
            return true;
    }
    error_set(err, "--fit: expected pixels or percent that leave room in the picture, got '%s'",
              text);
    return false;
}

static bool set_shading(struct style *out, const char *text, struct error *err)
{
    static const struct flag_name all[] = {{"ao", EFFECT_OCCLUSION}, {"outline", EFFECT_OUTLINE}};
    return flags_parse(&out->shot.effects, text, all, array_count(all), "shading",
                       "ao, outline or ao,outline", err);
}

// "LEVELS" or "LEVELS,PERCENT%"
static bool set_threshold(struct style *out, const char *text, struct error *err)
{
    const char *at = text;
    double levels = 0, percent = 0;
    bool ok = take_number(&at, &levels) && levels <= 255 && levels == floor(levels);
    if (ok && *at == ',') {
        at++;
        ok = take_number(&at, &percent) && percent <= 100 && *at++ == '%';
    }
    if (!ok || *at) {
        error_set(err,
                  "--threshold: expected LEVELS or LEVELS,PERCENT%%, as 8 or 8,0.5%%, got '%s'",
                  text);
        return false;
    }
    out->levels = (int)levels;
    out->share = percent / 100;
    return true;
}

bool style_parse(struct style *out, const struct given *given, struct error *err)
{
    *out = (struct style){.shot = {.samples = given->samples, .transparent = given->no_background},
                          .reference = given->reference};
    if (given->views && given->camera) {
        error_set(err, "--views and --camera exclude each other");
        return false;
    }
    if (given->threshold && !given->reference) {
        error_set(err, "--threshold: nothing to compare with; give --reference FILE.png");
        return false;
    }
    return set_fit(out, given, err) && (!given->shading || set_shading(out, given->shading, err)) &&
           (!given->threshold || set_threshold(out, given->threshold, err)) &&
           (!given->views || views_parse(&out->views, given->views, err));
}

double style_margin(const struct style *s, int width, int height)
{
    return s->margin_is_share ? s->margin * (width < height ? width : height) : s->margin;
}
