// The rows of a verification as text for the terminal, as CSV and as Markdown.
#pragma once

#include "judge.hpp"

#include <string>
#include <vector>

namespace geodrop {

/// The head of the table on the terminal, and a line of it.
std::string console_head();
std::string console_line(const VerifyRow& row);

/// "31 of 35 targets met, 3 misses are known, 1 is not; 12 of 12 controls fail as they must".
std::string verify_totals(const std::vector<VerifyRow>& rows);

/// verification.csv, a line for each row; texts stand in quotes.
std::string rows_csv(const std::vector<VerifyRow>& rows);
/// verification_runs.csv, a line for each run of each row.
std::string runs_csv(const std::vector<VerifyRow>& rows);

/// The table and the list of shortfalls for the page.
std::string rows_markdown(const std::vector<VerifyRow>& rows);

/// A page with the lines between "<!-- geodrop verify -->" and "<!-- end of geodrop verify -->" replaced. Throws
/// RunError if it does not have both.
std::string with_generated_part(const std::string& page, const std::string& generated);

}  // namespace geodrop
