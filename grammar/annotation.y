/* annotation.y - grammar of the comments behind parameters. */

%require "3.8"
%define api.pure full
%define api.prefix {annotation_yy}
%define api.value.type {struct literal}
%expect 0
%parse-param {void *scanner} {struct annotation_parser *p}
%lex-param {void *scanner}

%code requires {
#include "customizer/parser.h"
}

%code {
int annotation_yylex(ANNOTATION_YYSTYPE *value, void *scanner);
static void annotation_yyerror(void *scanner, struct annotation_parser *p, const char *text);
}

%token NUMBER WORD BEGIN_LIST "[" END_LIST "]" COMMA "," COLON ":"

%%

annotation:
    item                        { p->result = $1; }
  | "[" entries "]"             { if (!annotation_list(p, &p->result)) YYABORT; }
;
entries:
    entry
  | entries "," entry
;
entry:
    item                        { annotation_entry(p, (struct literal[]){$1}, 1); }
  | item ":" item               { annotation_entry(p, (struct literal[]){$1, $3}, 2); }
  | item ":" item ":" item      { annotation_entry(p, (struct literal[]){$1, $3, $5}, 3); }
;
item:
    NUMBER
  | words                       { $$ = annotation_words(p); }
;
/* One word at least: numbers alone are not joined. */
words:
    WORD                        { annotation_word(p, $1); }
  | numbers WORD                { annotation_word(p, $2); }
  | words WORD                  { annotation_word(p, $2); }
  | words NUMBER                { annotation_word(p, $2); }
;
numbers:
    NUMBER                      { annotation_word(p, $1); }
  | numbers NUMBER              { annotation_word(p, $2); }
;

%%

/* What does not parse is no annotation. */
static void annotation_yyerror(void *scanner, struct annotation_parser *p, const char *text)
{
    (void)scanner;
    (void)p;
    (void)text;
}
