#include "json.hpp"

namespace geodrop {

std::string json_text(const Json& json) {
  constexpr int spaces = 2;
  return json.dump(spaces, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace geodrop
