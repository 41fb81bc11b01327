// How a calculator refuses options: by their names, what was found, what is allowed.
#pragma once

#include <geodrop/base/error.hpp>

#include <optional>
#include <string>
#include <vector>

namespace geodrop {

enum class Given { none, all };

struct Option {
  const char* name;
  const std::optional<double>& value;
};

/// Prints those that are not empty as warnings.
void tell_doubts(const std::vector<std::string>& doubts);

struct OptionErrors {
  const char* command;  ///< "geodrop release"

  /// Throws SceneError.
  [[noreturn]] void refuse(const std::string& option, const std::string& found, const std::string& allowed) const;

  /// Of options that make sense only together; refuses some of them.
  Given all_or_none(const std::vector<Option>& options) const;

  /// What the library refuses by the name of a quantity was an option here.
  template <class Function>
  auto with_option_names(const Function& call) const {
    try {
      return call();
    } catch (const SceneError& error) {
      refuse_by_option(error);
    }
  }

 private:
  [[noreturn]] void refuse_by_option(const SceneError& error) const;
};

}  // namespace geodrop
