// Rows of the tree of keys, each with the member that it fills:
//
//   constexpr RowsOf<MembraneSpec> key;
//   key("axial_stiffness", &MembraneSpec::axial_stiffness, "N/m", required, not_negative, "tension per strain")
//   key("interface", &MembraneSpec::interface, {{"mixture", Interface::mixture}, {"sharp", Interface::sharp}}, ...)
//
// The member's type says of which kind the value is. In place of a member stands any function (part, value) for a value
// that goes elsewhere, or Either of several members. A section may fill a variant: its choice has words that stand for
// alternatives, and a member of an alternative is filled if that is the one at hand.
#pragma once

#include "key.hpp"
#include "plain_values.hpp"

#include <geodrop/geometry/shape.hpp>

#include <cstdint>
#include <initializer_list>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>

namespace geodrop {

inline constexpr Need required{Need::How::required};
constexpr Need standard(std::string_view toml) { return {Need::How::standard, toml}; }
/// The member keeps its initial value, which says that none was given.
constexpr Need derived(std::string_view from) { return {Need::How::derived, from}; }
constexpr Need instead_of(std::string_view other) { return {Need::How::instead_of, other}; }

inline constexpr Range any{"any finite number", [](double) { return true; }};
inline constexpr Range positive{"> 0", [](double x) { return x > 0; }};
inline constexpr Range not_negative{">= 0", [](double x) { return x >= 0; }};
inline constexpr Range not_zero{"not 0", [](double x) { return x != 0; }};
inline constexpr Range fraction{"> 0 and < 1", [](double x) { return x > 0 && x < 1; }};
inline constexpr Range share{">= 0 and <= 1", [](double x) { return x >= 0 && x <= 1; }};
inline constexpr Range filled{"not empty", [](double length) { return length > 0; }};
inline constexpr Range free_text{"any text", [](double) { return true; }};
inline constexpr Range identifier{kIdentifierText, nullptr};
inline constexpr Range reference{"the name of one in the scene", nullptr};

/// A word of a choice and what it stands for.
template <class T>
struct Word {
  const char* text;
  T value;
};

/// A section whose rows fill an S.
template <class S>
struct SectionOf : Section {
  SectionOf(std::string_view title, std::string_view named_by, std::string_view text, std::string_view shown,
            std::vector<Key> rows, void (*derive_from)(S&, const toml::table&) = nullptr)
      : Section{title, named_by, text, shown, std::move(rows)} {
    if constexpr (requires(S s) { s.at; }) place = [](void* target, SourceRef at) { static_cast<S*>(target)->at = at; };
    if (derive_from)
      derive = [derive_from](void* target, const toml::table& complete) {
        derive_from(*static_cast<S*>(target), complete);
      };
  }
};

/// Members of several alternatives that one row fills.
template <class... Members>
struct Either {
  std::tuple<Members...> members;
  constexpr explicit Either(Members... each) : members(each...) {}
};

/// As the target of a choice of alternatives: the variant that the section fills.
template <class S>
void itself(S& variant, S alternative) {
  variant = std::move(alternative);
}

/// The value that a member or a function takes, and the part of the target that it is of.
template <class Function>
struct Taken : Taken<decltype(&Function::operator())> {};
template <class C, class T>
struct Taken<T C::*> {
  using Part = C;
  using Value = std::remove_cvref_t<T>;
};
template <class F, class C, class T>
struct Taken<void (F::*)(C&, T) const> {
  using Part = C;
  using Value = std::remove_cvref_t<T>;
};
template <class C, class T>
struct Taken<void (*)(C&, T)> {
  using Part = C;
  using Value = std::remove_cvref_t<T>;
};
template <class First, class... Rest>
struct Taken<Either<First, Rest...>> : Taken<First> {};
template <class Into>
using ValueOf = typename Taken<Into>::Value;

template <class T>
T read(const toml::node& node) {
  if constexpr (std::is_same_v<T, double>) {
    return to_number(node);
  } else if constexpr (std::is_integral_v<T> && !std::is_same_v<T, bool>) {
    return static_cast<T>(node.value_or(std::int64_t{0}));
  } else if constexpr (requires { typename T::allocator_type; } && !std::is_same_v<T, std::string>) {
    T list;
    for (const toml::node& element : *node.as_array()) list.push_back(read<typename T::value_type>(element));
    return list;
  } else {
    return node.value_or(T{});
  }
}

template <class T>
constexpr Kind kind_of(const Range& allowed) {
  const bool name = !allowed.holds;
  if constexpr (std::is_same_v<T, bool>) return Kind::boolean;
  if constexpr (std::is_integral_v<T>) return Kind::integer;
  if constexpr (std::is_same_v<T, double>) return Kind::real;
  if constexpr (std::is_same_v<T, Point>) return Kind::point;
  if constexpr (std::is_same_v<T, std::vector<Point>>) return Kind::points;
  if constexpr (std::is_same_v<T, std::string>) return name ? Kind::name : Kind::text;
  return name ? Kind::names : Kind::texts;
}

/// Makes the rows of a section that fills an S, of which `alternatives` is a member that is a variant.
template <class S, auto alternatives = nullptr>
class RowsOf {
  using View = std::string_view;

 public:
  /// A number, or a point of numbers.
  template <class Into>
  Key operator()(View name, Into into, View unit, Need need, Range allowed, View meaning) const {
    return {name, kind_of<ValueOf<Into>>(allowed), unit, need, allowed, meaning, filling(into)};
  }
  /// A text or a name.
  template <class Into>
  Key operator()(View name, Into into, Need need, Range allowed, View meaning) const {
    return (*this)(name, into, "", need, allowed, meaning);
  }
  /// True or false.
  template <class Into>
  Key operator()(View name, Into into, Need need, View meaning) const {
    return (*this)(name, into, "", need, {"true or false"}, meaning);
  }
  /// A choice.
  template <class Into>
  Key operator()(View name, Into into, std::initializer_list<Word<ValueOf<Into>>> words, Need need,
                 View meaning) const {
    return choice<ValueOf<Into>>(name, into, {words.begin(), words.end()}, need, meaning);
  }
  template <class T, class Into>
  Key choice(View name, Into into, std::vector<Word<T>> words, Need need, View meaning) const {
    Key key{name, Kind::choice, "", need, {"one of its words"}, meaning};
    for (const Word<T>& word : words) {
      key.words.emplace_back(word.text);
      if constexpr (std::is_enum_v<T> || std::is_integral_v<T>) key.numbers.push_back(static_cast<int>(word.value));
    }
    key.fill = [into, words = std::move(words)](void* target, const toml::node& node) {
      for (const Word<T>& word : words)
        if (node.value_or(View{}) == word.text) put(*static_cast<S*>(target), into, word.value);
    };
    return key;
  }
  /// A choice that only decides which other keys there are.
  Key decides(View name, std::vector<std::string> words, Need need, View meaning) const {
    Key key{name, Kind::choice, "", need, {"one of its words"}, meaning, [](void*, const toml::node&) {}};
    key.words = std::move(words);
    return key;
  }
  /// A number that the section derives others from.
  Key given(View name, View unit, Need need, Range allowed, View meaning) const {
    return {name, Kind::real, unit, need, allowed, meaning, [](void*, const toml::node&) {}};
  }
  /// A list of numbers of any length.
  template <class Into>
  Key reals(View name, Into into, View unit, Need need, Range allowed, View meaning) const {
    return {name, Kind::reals, unit, need, allowed, meaning, filling(into)};
  }

  template <class Sub>
  Key table(View name, Sub S::*into, SectionOf<Sub> below, Need need, View meaning) const {
    return holding(name, Kind::table, std::move(below), need, {"a table"}, meaning,
                   [into](S& target, const std::string&) -> void* { return &(target.*into); });
  }
  /// A table whose rows fill the same S.
  Key table(View name, SectionOf<S> below, Need need, View meaning) const {
    return holding(name, Kind::table, std::move(below), need, {"a table"}, meaning,
                   [](S& target, const std::string&) -> void* { return &target; });
  }
  template <class Sub>
  Key list(View name, std::vector<Sub> S::*into, SectionOf<Sub> below, Need need, View meaning) const {
    const Range some{"at least one", [](double length) { return length > 0; }};
    const Range maybe_none{"may be empty", [](double) { return true; }};
    return holding(name, Kind::table_list, std::move(below), need, need.how == Need::How::required ? some : maybe_none,
                   meaning, [into](S& target, const std::string&) -> void* { return &(target.*into).emplace_back(); });
  }
  /// Tables by name, which the elements have as a member.
  template <class Sub>
  Key named(View name, std::vector<Sub> S::*into, SectionOf<Sub> below, View meaning) const {
    return holding(name, Kind::named_tables, std::move(below), required, {"at least one"}, meaning,
                   [into](S& target, const std::string& word) -> void* {
                     Sub& element = (target.*into).emplace_back();
                     element.name = word;
                     return &element;
                   });
  }

 private:
  /// Null if the variant holds another alternative.
  template <class C>
  static C* part_of(S& target) {
    if constexpr (std::is_same_v<C, S>)
      return &target;
    else if constexpr (std::is_null_pointer_v<decltype(alternatives)>)
      return std::get_if<C>(&target);
    else
      return std::get_if<C>(&(target.*alternatives));
  }

  template <class Into>
  static void put(S& target, const Into& into, const ValueOf<Into>& value) {
    auto* part = part_of<typename Taken<Into>::Part>(target);
    if (!part) return;
    if constexpr (std::is_member_object_pointer_v<Into>)
      part->*into = value;
    else
      into(*part, value);
  }
  template <class... Members>
  static void put(S& target, const Either<Members...>& either, const ValueOf<Either<Members...>>& value) {
    std::apply([&](const auto&... member) { (put(target, member, value), ...); }, either.members);
  }

  template <class Into>
  static std::function<void(void*, const toml::node&)> filling(Into into) {
    return [into](void* target, const toml::node& node) {
      put(*static_cast<S*>(target), into, read<ValueOf<Into>>(node));
    };
  }

  template <class Enter>
  static Key holding(View name, Kind kind, Section below, Need need, Range allowed, View meaning, Enter enter) {
    Key key{name, kind, "", need, allowed, meaning};
    key.below = std::make_shared<Section>(std::move(below));
    key.enter = [enter](void* target, const std::string& word) { return enter(*static_cast<S*>(target), word); };
    return key;
  }
};

}  // namespace geodrop
