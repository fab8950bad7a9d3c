/* scad.y - grammar of what is assigned at the top level of a .scad program. All statements but
   assignments of literals are errors here, from which it recovers at their end. */

%require "3.8"
%define api.pure full
%define api.prefix {scad_yy}
%expect 0
%parse-param {void *scanner} {struct scad_parser *p}
%lex-param {void *scanner}

%code requires {
#include "customizer/parser.h"
}

%code {
int scad_yylex(SCAD_YYSTYPE *value, void *scanner);
static void scad_yyerror(void *scanner, struct scad_parser *p, const char *text);
}

%union {
    struct literal value;
    struct scad_name name;
    struct slice signs;
    uint32_t count;
}

%token <value> VALUE
%token <name> NAME
%token <signs> SIGNS
%token SEMICOLON ";" EQUALS "=" COMMA "," COLON ":" LEFT "(" RIGHT ")"
%token BEGIN_VECTOR "[" END_VECTOR "]"
%token BLOCK OTHER ONE_LITERAL

%type <value> value
%type <count> elements

%%

file:
    statements
  | ONE_LITERAL value           { p->result = $value; }
;
statements:
    %empty
  | statements statement
;
statement:
    end
  | NAME "=" value ";"          { scad_assigned(p, $1, &$value); }
  | NAME "=" error end          { yyerrok; scad_assigned(p, $1, NULL); }
  | error end                   { yyerrok; p->value_count = 0; }
;
end:
    ";"
  | BLOCK
;
value:
    VALUE
  | SIGNS value                 { $$ = literal_sign($1.text, $1.size, $2); }
  | "(" value ")"               { $$ = $2; }
  | "[" "]"                     { $$ = scad_pop(p, LITERAL_VECTOR, 0); }
  | "[" elements commas "]"     { $$ = scad_pop(p, LITERAL_VECTOR, $2); }
  | "[" elements "]"            { $$ = scad_pop(p, LITERAL_VECTOR, $2); }
  | "[" value ":" value "]"     {
                                    scad_push(p, $2);
                                    scad_push(p, $4);
                                    $$ = scad_pop(p, LITERAL_RANGE, 2);
                                }
  | "[" value ":" value ":" value "]" {
                                    scad_push(p, $2);
                                    scad_push(p, $4);
                                    scad_push(p, $6);
                                    $$ = scad_pop(p, LITERAL_RANGE, 3);
                                }
;
elements:
    value                       { scad_push(p, $1); $$ = 1; }
  | elements commas value       { scad_push(p, $3); $$ = $1 + 1; }
;
commas:
    ","
  | commas ","
;

%%

/* Nearly everything in a program is an error here. */
static void scad_yyerror(void *scanner, struct scad_parser *p, const char *text)
{
    (void)scanner;
    (void)p;
    (void)text;
}
