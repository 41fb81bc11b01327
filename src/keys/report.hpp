// What reading a scene finds out beside its values: where each key stands, and what is wrong.
#pragma once

#include "toml.hpp"

#include <geodrop/base/error.hpp>

#include <map>
#include <string>
#include <vector>

namespace geodrop {

/// The source path that marks TOML given by --set.
inline constexpr const char* kOverrideSource = "--set";

SourceRef to_ref(const toml::source_region& region);
/// A list of which one element was given by --set counts as given by --set.
SourceRef to_ref(const toml::node& node);

class Report {
 public:
  void place(const std::string& key, SourceRef at) { places_[key] = at; }
  /// Where a key stands; if it does not stand in the file, where its table does.
  SourceRef where(std::string key) const;
  /// Whether a key stands in the file (or --set), not only its default.
  bool is_given(const std::string& key) const { return places_.contains(key); }

  /// The full keys of the elements of a list of tables, e.g. "bodies.water", in order.
  void add_element(const std::string& list, const std::string& key) { elements_[list].push_back(key); }
  const std::string& element(const std::string& list, std::size_t index) const { return elements_.at(list).at(index); }

  void add(const std::string& key, std::string found, std::string allowed) {
    add_at(where(key), key, std::move(found), std::move(allowed));
  }
  void add_at(SourceRef at, const std::string& key, std::string found, std::string allowed);

  /// The former word still holds.
  void note(SourceRef at, const std::string& former, const std::string& present) {
    notes_.push_back({at, '"' + former + "\" is called \"" + present + "\" now"});
  }
  struct Note {
    SourceRef at;
    std::string text;
  };
  const std::vector<Note>& notes() const { return notes_; }

  /// No problem so far with the key or anything below it.
  bool healthy(const std::string& key) const;

  /// All problems in the order of the file, those of --set first.
  std::vector<SceneProblem> problems() const;

 private:
  std::map<std::string, SourceRef> places_;
  std::map<std::string, std::vector<std::string>> elements_;
  std::vector<SceneProblem> problems_;
  std::vector<Note> notes_;
};

}  // namespace geodrop
