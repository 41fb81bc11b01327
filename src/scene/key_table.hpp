// The one table of all keys that a scene may have. Reading, checking, "nearest name", the scene as run and
// docs/scene.md all come from it.
#pragma once

#include <span>
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
  std::string_view text;  ///< of a choice: its words, parted by '|'
  bool (*holds)(double) = nullptr;
  bool infinite = false;  ///< an infinite number is no mistake
};

/// Whether a key must be given, has a default (as TOML), or stands instead of another key.
struct Need {
  enum class How { required, standard, instead_of } how;
  std::string_view text = {};  ///< the default, or the other key
};

struct Key {
  std::string_view section;  ///< "" top level, "bodies.shape" the table `shape` of a body
  std::string_view name;
  Kind kind;
  std::string_view unit;  ///< "" if it has none
  /// "" always; "type=box|ellipse": only if the neighbour `type` has one of these values; "points": only beside a
  /// neighbour `points`; "type=box&points": both
  std::string_view when;
  Need need;
  Range allowed;
  std::string_view meaning;
  int dimension = 0;  ///< 2 or 3: only in scenes of this dimension; 0: in both
};

/// A table of the scene file: how it is written, and what names one of several.
struct Section {
  std::string_view path;
  std::string_view heading;
  std::string_view id_key;  ///< key that names an element of a list of tables
  std::string_view about;
};

std::span<const Key> key_table();
std::span<const Section> section_table();
const Section& find_section(std::string_view path);

/// All keys of a section in the order of the table; a name may occur more than once with different conditions.
std::vector<const Key*> keys_of(std::string_view section);

/// Whether scenes of this dimension know the row.
inline bool applies_in(const Key& key, int dimension) { return key.dimension == 0 || key.dimension == dimension; }

/// "" + "grid" = "grid", "bodies" + "shape" = "bodies.shape".
std::string join_path(std::string_view parent, std::string_view child);

/// The word of a choice for one of its enumerators, which stand in the order of the words.
std::string word_of(std::string_view section, std::string_view name, std::size_t enumerator);

/// The parts of "a|b|c".
std::vector<std::string> split(std::string_view text, char separator);

}  // namespace geodrop
