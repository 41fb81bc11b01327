// The rows of a verification as text for the terminal, as CSV and as Markdown.
#pragma once

#include "judge.hpp"

#include <string>
#include <vector>

namespace geodrop {

/// The head of the table on the terminal, and a line of it.
std::string console_head();
std::string console_line(const VerifyRow& row);

/// How many targets are met, are met by a quick target only, are known misses within their guard, are missed;
/// regressions and controls apart.
std::string verify_totals(const std::vector<VerifyRow>& rows);
/// How many targets are loose, and how many no control has to miss.
std::string slack_totals(const std::vector<VerifyRow>& rows);

/// verification.csv, a line for each row; texts stand in quotes.
std::string rows_csv(const std::vector<VerifyRow>& rows);
/// verification_runs.csv, a line for each run of each row.
std::string runs_csv(const std::vector<VerifyRow>& rows);

/// The summary: one line for each case with its hardest measure (the worst verdict, then the largest error over
/// target), and a list of the known misses.
std::string cases_markdown(const std::vector<VerifyRow>& rows);
/// One line for each measure and control, and lists: loose targets, measures without a control.
std::string rows_markdown(const std::vector<VerifyRow>& rows);
/// The same as a page of its own in a directory below `page`, the name of the page with the summary.
std::string rows_page(const std::vector<VerifyRow>& rows, const std::string& page);

/// A page with the lines between "<!-- geodrop verify -->" and "<!-- end of geodrop verify -->" replaced. Throws
/// RunError if it does not have both.
std::string with_generated_part(const std::string& page, const std::string& generated);

}  // namespace geodrop
