// report.h - results as rows for programs and as tables for people.
#pragma once
#include "opponent.h"
#include "result.h"

// "scene metric median min n", tabs between. Heading first.
void report_heading(FILE *tsv);
void report_rows(FILE *tsv, const struct result *r);
void report_process_row(FILE *tsv, const struct process_result *p);

void report_gl_rows(FILE *tsv, const struct result *r);

// Tables in Markdown.
void report_tables(FILE *out, const struct result *results, uint32_t count);
// The figures of the HCSG paper for the scenes that it has, and ours.
void report_paper_table(FILE *out, const struct result *results, uint32_t count);
void report_gl_tables(FILE *out, const struct result *results, uint32_t count);
void report_process_table(FILE *out, const struct process_result *results, uint32_t count);
