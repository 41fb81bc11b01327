// A key of a scene and a section of keys. rows.hpp makes them.
#pragma once

#include "toml.hpp"

#include <geodrop/base/error.hpp>

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace geodrop {

enum class Kind {
  text,
  texts,
  name,
  names,
  choice,
  boolean,
  integer,
  real,
  reals,
  point,
  points,
  table,
  named_tables,
  table_list
};

/// What a value may be: words for the user, and the test of each number (of the length, for texts and lists of tables).
struct Range {
  std::string_view text;
  bool (*holds)(double) = nullptr;
  bool infinite = false;  ///< an infinite number is no mistake
};

/// Whether a key must be given, has a default (as TOML) or one that follows from other keys, or stands instead of
/// another key.
struct Need {
  enum class How { required, standard, derived, instead_of } how;
  std::string_view text = {};  ///< the default, what it follows from, or the other key
};

struct Section;

struct Key {
  std::string_view name;
  Kind kind;
  std::string_view unit;  ///< "" if it has none
  Need need;
  Range allowed;
  std::string_view meaning;
  /// Puts an accepted value into what its section fills.
  std::function<void(void* target, const toml::node& value)> fill = {};
  std::vector<std::string> words = {};  ///< of a choice
  std::vector<int> numbers = {};        ///< enumerators that the words stand for; empty if they stand for other values
  std::shared_ptr<Section> below = {};  ///< of tables
  /// Of tables: what the one table, the table of this name or the next one of the list fills.
  std::function<void*(void* target, const std::string& name)> enter = {};
  /// "" always; "type=box|ellipse": only if the neighbour `type` has one of these values; "points": only beside a
  /// neighbour `points`; "type=box&points": both
  std::string when = {};
  int dimension = 0;             ///< 2 or 3: only in scenes of this dimension; 0: in both
  std::string_view former = {};  ///< word that scenes had for it earlier; it still holds, with a note
  std::string section = {};      ///< path of the section that it is in

  Key only(std::string_view condition) && { return when = condition, std::move(*this); }
  Key in(int space) && { return dimension = space, std::move(*this); }
  Key formerly(std::string_view word) && { return former = word, std::move(*this); }
};

/// A table of the scene file: how it is written, what names one of several, and its rows in the order of the page. A
/// key that decides about others (type, model, drainage) stands before them; a name may occur more than once with
/// different conditions.
struct Section {
  std::string_view heading;
  std::string_view id_key;  ///< key that names an element of a list of tables
  std::string_view about;
  std::string_view example;  ///< TOML: a part of a scene in which the section occurs
  std::vector<Key> keys;
  std::function<void(void* target, SourceRef at)> place = {};  ///< notes where the table stands
  /// Fills what follows from several keys of the complete table.
  std::function<void(void* target, const toml::table& complete)> derive = {};
  std::string path = {};  ///< "" top level, "bodies.shape" the table `shape` of a body
};

/// Whether scenes of this dimension know the row.
inline bool applies_in(const Key& key, int dimension) { return key.dimension == 0 || key.dimension == dimension; }

/// "" + "grid" = "grid", "bodies" + "shape" = "bodies.shape".
std::string join_path(std::string_view parent, std::string_view child);

/// The parts of "a|b|c".
std::vector<std::string> split(std::string_view text, char separator);

}  // namespace geodrop
