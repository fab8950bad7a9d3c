// json.c - all parameters as JSON, as newer versions of OpenSCAD list them.
#include "base/locale.h"
#include "customizer/literal.h"
#include "customizer/parameters.h"

#include <cjson/cJSON.h>

static cJSON *value_json(const struct parameter *p)
{
    switch (p->kind) {
    case PARAMETER_BOOL:
        return cJSON_CreateBool(p->initial.boolean);
    case PARAMETER_NUMBER:
        return cJSON_CreateNumber(p->initial.numbers[0]);
    case PARAMETER_VECTOR:
        return cJSON_CreateDoubleArray(p->initial.numbers, (int)p->initial.count);
    case PARAMETER_STRING:
    case PARAMETER_SOURCE:
        break;
    }
    return cJSON_CreateString(p->initial.text);
}

static cJSON *choices_json(const struct parameter *p)
{
    cJSON *list = cJSON_CreateArray();
    for (uint32_t i = 0; i < p->choice_count; i++) {
        cJSON *one = cJSON_CreateObject();
        cJSON_AddStringToObject(one, "name", p->choices[i].label);
        if (p->kind == PARAMETER_NUMBER)
            cJSON_AddNumberToObject(one, "value", p->choices[i].number);
        else
            cJSON_AddStringToObject(one, "value", p->choices[i].text);
        cJSON_AddItemToArray(list, one);
    }
    return list;
}

static cJSON *parameter_json(const struct parameter *p)
{
    static const char *const types[] = {[PARAMETER_BOOL] = "boolean",
                                        [PARAMETER_NUMBER] = "number",
                                        [PARAMETER_STRING] = "string",
                                        [PARAMETER_VECTOR] = "number"};
    cJSON *one = cJSON_CreateObject();
    if (*p->description)
        cJSON_AddStringToObject(one, "caption", p->description);
    cJSON_AddStringToObject(one, "group", p->group);
    cJSON_AddItemToObject(one, "initial", value_json(p));
    if (p->ranged) {
        cJSON_AddNumberToObject(one, "max", p->max);
        cJSON_AddNumberToObject(one, "min", p->min);
    }
    if (p->length_most)
        cJSON_AddNumberToObject(one, "maxLength", p->length_most);
    cJSON_AddStringToObject(one, "name", p->name);
    if (p->choice_count)
        cJSON_AddItemToObject(one, "options", choices_json(p));
    if (p->ranged)
        cJSON_AddNumberToObject(one, "step", p->step);
    cJSON_AddStringToObject(one, "type", types[p->kind]);
    return one;
}

char *parameters_json(const struct parameters *p, const char *title)
{
    struct own_locale own = locale_enter();
    cJSON *root = cJSON_CreateObject();
    cJSON *list = cJSON_AddArrayToObject(root, "parameters");
    for (uint32_t i = 0; i < p->count; i++)
        if (!p->items[i].hidden && p->items[i].kind != PARAMETER_SOURCE)
            cJSON_AddItemToArray(list, parameter_json(&p->items[i]));
    cJSON_AddStringToObject(root, "title", title);
    char *printed = cJSON_Print(root);
    struct words text = {0};
    words_say(&text, printed);
    words_say(&text, "\n");
    cJSON_free(printed);
    cJSON_Delete(root);
    locale_leave(&own);
    return text.data;
}
