// The little JSON that summary.json needs.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace geodrop {

/// In quotes, escaped; what is no UTF-8 as U+FFFD.
std::string json_text(const std::string& text);
/// Twelve digits; null where it is not finite, since JSON has no word for that.
std::string json_number(double value);

/// Members and items are JSON already. Each stands on a line of its own, what is inside them is moved in.
std::string json_object(const std::vector<std::pair<std::string, std::string>>& members);
std::string json_array(const std::vector<std::string>& items);
/// An array of texts.
std::string json_texts(const std::vector<std::string>& texts);
/// On one line.
std::string json_record(const std::vector<std::pair<std::string, std::string>>& members);

}  // namespace geodrop
