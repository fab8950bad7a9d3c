/* csg.y - grammar of exported .csg files: calls, blocks, modifiers and values; no node names. */

%require "3.8"
%define api.pure full
%define api.prefix {csg_yy}
%define parse.error custom
%expect 0
%parse-param {void *scanner} {struct csg_parser *p}
%lex-param {void *scanner}

%code requires {
#include "csg/parser.h"
}

%code {
/* Symbols on the stack, which lives on the heap: 2 for each level of blocks, 3 of vectors. */
#define YYMAXDEPTH 8000000

int csg_yylex(CSG_YYSTYPE *value, void *scanner);
static void csg_yyerror(void *scanner, struct csg_parser *p, const char *text);
static bool negate(struct csg_parser *p, const char *sign, struct csg_value *value);
}

%union {
    struct csg_value value;
    struct csg_name name;
    struct csg_list list;
    struct csg_node *node;
    const char *place;
    uint32_t count;
    uint8_t modifiers;
}

%token <value> NUMBER "a number" VECTOR "a vector" STRING "a string" BOOL "true or false"
%token <value> UNDEF "undef"
%token <name> NAME "a name"
%token <modifiers> MODIFIERS "a modifier"
%token OPERATOR "an operator"
%token OPEN "{" CLOSE "}" SEMICOLON ";" EQUALS "=" COMMA "," COLON ":" PLUS "+" MINUS "-"
%token LEFT "(" RIGHT ")" BEGIN_VECTOR "[" END_VECTOR "]"

%type <value> value vector range
%type <count> elements
%type <list> items statements statement block
%type <node> call plain_call node open
%type <modifiers> modifiers
%type <place> minus

%%

file:
    items                       { p->tree.first = $items.first; }
;
items:
    %empty                      { $$ = (struct csg_list){0}; }
  | items statement             { $$ = csg_append($1, $2); }
  | items "}"                   { csg_error(p, p->token, "this '}' closes nothing"); $$ = $1; }
  | items error "}"             { csg_recovered(p); yyerrok; $$ = $1; }
;
statements:
    %empty                      { $$ = (struct csg_list){0}; }
  | statements statement        { $$ = csg_append($1, $2); }
;
statement:
    ";"                         { $$ = (struct csg_list){0}; }
  | node                        { $$ = (struct csg_list){$1, $1}; }
  | block
  | NAME "=" value ";"          {
                                    struct csg_name name = {p->assign, $1.line, $1.column};
                                    csg_push_argument(p, $1.text, $3);
                                    $$.first = $$.last = csg_node_new(p, name, 0);
                                }
  | error ";"                   { csg_recovered(p); yyerrok; $$ = (struct csg_list){0}; }
  | lost statements close       { $$ = (struct csg_list){0}; }
;
block:
    brace statements close      { $$ = $2; }
;
node:
    call ";"                    { $$ = $1; }
  | call node                   { $$ = $1; $$->child = $2; }
  | open statements close       { $$ = $1; $$->child = $2.first; }
;
open:
    call brace                  { $$ = $1; $$->block = true; }
;
brace:
    "{"                         { csg_open_brace(p); }
;
lost:
    error "{"                   { csg_recovered(p); yyerrok; csg_open_brace(p); }
;
close:
    "}"                         { csg_close_brace(p); }
  | error "}"                   { csg_recovered(p); yyerrok; csg_close_brace(p); }
;
call:
    plain_call
  | modifiers plain_call        { $$ = $2; $$->modifiers = $1; }
;
modifiers:
    MODIFIERS
  | modifiers MODIFIERS         { $$ = $1 | $2; }
;
plain_call:
    NAME "(" arguments ")"      { $$ = csg_node_new(p, $1, 0); }
;
arguments:
    %empty
  | argument_list
  | argument_list commas
;
argument_list:
    argument
  | argument_list commas argument
;
commas:
    ","
  | commas ","
;
argument:
    value                       { csg_push_argument(p, NULL, $1); }
  | NAME "=" value              { csg_push_argument(p, $1.text, $3); }
;
value:
    NUMBER
  | VECTOR
  | STRING
  | BOOL
  | UNDEF
  | vector
  | range
  | "(" value ")"               { $$ = $2; }
  | "+" value                   { $$ = $2; }
  | minus value                 { $$ = $2; if (!negate(p, $1, &$$)) YYERROR; }
  | NAME                        { csg_error_name(p, $1); YYABORT; }
;
minus:
    "-"                         { $$ = p->token; }
;
vector:
    "[" elements "]"            { $$ = csg_vector(p, $2); }
  | "[" elements commas "]"     { $$ = csg_vector(p, $2); }
  | "[" "]"                     { $$ = csg_vector(p, 0); }
;
elements:
    value                       { csg_push_value(p, $1); $$ = 1; }
  | elements commas value       { csg_push_value(p, $3); $$ = $1 + 1; }
;
range:
    "[" value ":" value "]"     {
                                    struct csg_value one = {CSG_NUMBER, .number = 1};
                                    if (!csg_range(p, $2, one, $4, &$$)) YYERROR;
                                }
  | "[" value ":" value ":" value "]" { if (!csg_range(p, $2, $4, $6, &$$)) YYERROR; }
;

%%

static bool negate(struct csg_parser *p, const char *sign, struct csg_value *value)
{
    if (value->kind != CSG_NUMBER) {
        csg_error(p, sign, "'-' needs a number");
        return false;
    }
    value->number = -value->number;
    return true;
}

/* The stack is all that fails apart from syntax. */
static void csg_yyerror(void *scanner, struct csg_parser *p, const char *text)
{
    (void)scanner;
    (void)text;
    csg_error(p, p->token, "nested too deeply");
}

/* What may stand here, in words: "')' or ','". Empty where that is too much to be of help. */
static void describe_expected(const bool *expected, char *out, size_t size)
{
    static const yysymbol_kind_t order[] = {
        YYSYMBOL_COMMA, YYSYMBOL_RIGHT,  YYSYMBOL_END_VECTOR, YYSYMBOL_LEFT,
        YYSYMBOL_EQUALS, YYSYMBOL_SEMICOLON, YYSYMBOL_OPEN,
    };
    size_t used = 0;
    bool value = expected[YYSYMBOL_STRING];

    *out = 0;
    if (expected[YYSYMBOL_CLOSE] || expected[YYSYMBOL_YYEOF])
        return; /* between statements: nearly anything */
    if (value)
        used = (size_t)snprintf(out, size, "a value");
    else if (expected[YYSYMBOL_NAME] && !expected[YYSYMBOL_SEMICOLON])
        used = (size_t)snprintf(out, size, "a name");
    for (size_t i = 0; i < array_count(order) && used < size; i++)
        if (expected[order[i]] && !(value && (order[i] == YYSYMBOL_COMMA ||
                                              order[i] == YYSYMBOL_LEFT)))
            used += (size_t)snprintf(out + used, size - used, "%s'%s'", used ? " or " : "",
                                     yysymbol_name(order[i]));
}

static int yyreport_syntax_error(const yypcontext_t *context, void *scanner, struct csg_parser *p)
{
    yysymbol_kind_t kinds[YYNTOKENS], token = yypcontext_token(context);
    bool expected[YYNTOKENS] = {false};
    char words[200];
    int n = yypcontext_expected_tokens(context, kinds, YYNTOKENS);

    (void)scanner;
    for (int i = 0; i < n; i++)
        expected[kinds[i]] = true;
    describe_expected(expected, words, sizeof words);
    if (token == YYSYMBOL_YYEOF && expected[YYSYMBOL_CLOSE] && p->brace_count)
        csg_error(p, p->braces[p->brace_count - 1], "this '{' is never closed: '}' is missing");
    else if (!expected[YYSYMBOL_NAME] &&
             (token == YYSYMBOL_OPERATOR || token == YYSYMBOL_MODIFIERS ||
              token == YYSYMBOL_PLUS || token == YYSYMBOL_MINUS))
        csg_error_scad(p, p->token, "a calculation");
    else
        csg_error_token(p, words);
    return 0;
}
