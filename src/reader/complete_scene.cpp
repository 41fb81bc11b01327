#include "complete_scene.hpp"
#include "base/nearest_name.hpp"
#include "check_value.hpp"
#include "former_words.hpp"
#include "key_table.hpp"
#include "keys/plain_values.hpp"
#include "keys/to_text.hpp"

#include <algorithm>
#include <set>

namespace geodrop {
namespace {

/// Walks one table; elements of lists and sub-tables are walked by walkers of their own.
class TableWalker {
 public:
  /// `target` is what the rows of the section fill.
  TableWalker(const toml::table& written, const Section& section, void* target, std::string path, int dimension,
              Report& report)
      : written_(written),
        section_(section),
        target_(target),
        path_(std::move(path)),
        dimension_(dimension),
        report_(report) {}

  toml::table complete() {
    for (const Key& key : section_.keys) {
      const Condition condition = holds(key);
      if (condition == Condition::yes) take(key);
      if (condition == Condition::unknown) undecided_.insert(std::string(key.name));
    }
    report_strays();
    if (section_.place) section_.place(target_, report_.where(path_));
    if (section_.derive) section_.derive(target_, out_);
    return std::move(out_);
  }

 private:
  enum class Condition { yes, no, unknown };

  std::string path_of(std::string_view name) const { return join_path(path_, name); }

  /// `unknown` if the key that decides is itself wrong: then nothing is said about what depends on it.
  Condition holds(const Key& key) const {
    if (!applies_in(key, dimension_)) return Condition::no;
    if (key.when.empty()) return Condition::yes;
    Condition all = Condition::yes;
    for (const std::string& part : split(key.when, '&')) {
      const Condition one = holds_part(part);
      if (one == Condition::no) return one;
      if (one == Condition::unknown) all = one;
    }
    return all;
  }

  Condition holds_part(const std::string& part) const {
    const std::vector<std::string> sides = split(part, '=');
    if (undecided_.contains(sides[0])) return Condition::unknown;
    if (sides.size() == 1) return out_.contains(sides[0]) ? Condition::yes : Condition::no;
    const auto value = out_[sides[0]].value<std::string>();
    const std::vector<std::string> words = split(sides[1], '|');
    return value && std::find(words.begin(), words.end(), *value) != words.end() ? Condition::yes : Condition::no;
  }

  void take(const Key& key) {
    const std::string path = path_of(key.name);
    const toml::node* node = written_.get(key.name);
    if (node && key.need.how == Need::How::instead_of && written_.contains(key.need.text)) {
      report_.add_at(to_ref(*node), path, "both " + std::string(key.name) + " and " + std::string(key.need.text),
                     "exactly one of them");
      undecided_.insert(std::string(key.name));
      return;
    }
    if (node) {
      report_.place(path, to_ref(*node));
      if (!accept(key, *node, path)) undecided_.insert(std::string(key.name));
    } else {
      take_missing(key, path);
    }
  }

  void take_missing(const Key& key, const std::string& path) {
    if (key.need.how == Need::How::standard) {
      const toml::table parsed = toml::parse("x = " + std::string(key.need.text));
      accept(key, *parsed.get("x"), path);
      return;
    }
    if (key.need.how == Need::How::derived) return;
    if (key.need.how == Need::How::instead_of) {
      const std::string other(key.need.text);
      // Said once for the two, at the first of them in the table.
      if (written_.contains(other) || undecided_.contains(other)) return;
      undecided_.insert(std::string(key.name));
      report_.add(path, "neither " + std::string(key.name) + " nor " + other, "exactly one of them");
      return;
    }
    undecided_.insert(std::string(key.name));
    report_.add(path, "nothing: the key is missing", describe_allowed(key, dimension_));
  }

  bool accept(const Key& key, const toml::node& node, const std::string& path) {
    switch (key.kind) {
      case Kind::table:
        return accept_table(key, node, path);
      case Kind::named_tables:
        return accept_named(key, node, path);
      case Kind::table_list:
        return accept_list(key, node, path);
      default:
        break;
    }
    const ValueCheck check = check_value(key, node, dimension_);
    if (!check.ok) {
      report_.add(path, check.found, describe_allowed(key, dimension_));
      return false;
    }
    if (key.kind == Kind::points) place_points(*node.as_array(), path);
    node.visit([&](const auto& value) { out_.insert_or_assign(key.name, value); });
    key.fill(target_, node);
    return true;
  }

  /// Each point of a list can be complained about by itself, as "points.3".
  void place_points(const toml::array& points, const std::string& path) {
    for (std::size_t i = 0; i < points.size(); ++i)
      report_.place(join_path(path, std::to_string(i)), to_ref(*points.get(i)));
  }

  bool accept_table(const Key& key, const toml::node& node, const std::string& path) {
    const toml::table* table = node.as_table();
    if (!table) return wrong_form(key, node, path);
    out_.insert_or_assign(key.name, complete_below(key, *table, std::string(key.name), path));
    return true;
  }

  bool accept_named(const Key& key, const toml::node& node, const std::string& path) {
    const toml::table* tables = node.as_table();
    const bool needs_one = key.need.how == Need::How::required;
    if (!tables || (needs_one && tables->empty())) return wrong_form(key, node, path);
    toml::table named;
    for (const auto& [name, element] : *tables) {
      const std::string element_path = join_path(path, name.str());
      report_.place(element_path, to_ref(element));
      if (!is_identifier(name.str())) {
        report_.add_at(to_ref(name.source()), element_path, '"' + std::string(name.str()) + '"',
                       "a name of " + std::string(kIdentifierText));
      } else if (const toml::table* table = element.as_table()) {
        named.insert_or_assign(name.str(), complete_below(key, *table, std::string(name.str()), element_path));
      } else {
        wrong_form(key, element, element_path);
      }
    }
    out_.insert_or_assign(key.name, std::move(named));
    return true;
  }

  bool accept_list(const Key& key, const toml::node& node, const std::string& path) {
    const toml::array* list = node.as_array();
    const auto is_table = [](const toml::node& element) { return element.is_table(); };
    if (!list || !std::all_of(list->begin(), list->end(), is_table) ||
        !key.allowed.holds(static_cast<double>(list->size()))) {
      return wrong_form(key, node, path);
    }
    toml::array completed;
    std::set<std::string> names;
    for (std::size_t i = 0; i < list->size(); ++i) {
      const toml::table& table = *list->get(i)->as_table();
      const std::string element_path = join_path(path, element_name(*key.below, table, i, names));
      report_.place(element_path, to_ref(table));
      report_.add_element(path, element_path);
      completed.push_back(complete_below(key, table, {}, element_path));
    }
    out_.insert_or_assign(key.name, std::move(completed));
    return true;
  }

  /// The element's own name if it has one that no element before it has, else its index.
  static std::string element_name(const Section& section, const toml::table& table, std::size_t index,
                                  std::set<std::string>& names) {
    const auto name = table[section.id_key].value<std::string>();
    return name && is_identifier(*name) && names.insert(*name).second ? *name : std::to_string(index);
  }

  toml::table complete_below(const Key& key, const toml::table& table, const std::string& name,
                             const std::string& path) {
    return TableWalker(table, *key.below, key.enter(target_, name), path, dimension_, report_).complete();
  }

  bool wrong_form(const Key& key, const toml::node& node, const std::string& path) {
    report_.add(path, to_text(node), describe_allowed(key, dimension_));
    return false;
  }

  void report_strays() {
    for (const auto& [name, node] : written_) {
      if (out_.contains(name.str()) || undecided_.contains(std::string(name.str()))) continue;
      std::vector<std::string> known;
      std::string uses;
      for (const Key& key : section_.keys) {
        if (holds(key) != Condition::no && (known.empty() || known.back() != key.name)) known.emplace_back(key.name);
        if (key.name == name.str()) uses += (uses.empty() ? "" : " or ") + readable_condition(key);
      }
      const SourceRef at =
          to_ref(node.source().path && *node.source().path == kOverrideSource ? node.source() : name.source());
      const std::string path = path_of(name.str());
      if (const std::string_view instead = gone_word(section_.path, name.str()); !instead.empty()) {
        report_.add_at(at, path, "a key of earlier versions", std::string(instead));
      } else if (uses.empty()) {
        report_.add_at(at, path, "an unknown key", name_advice(name.str(), known, "keys here"));
      } else {
        report_.add_at(at, path, "a key that does not apply here", "only with " + uses);
      }
    }
  }

  const toml::table& written_;
  const Section& section_;
  void* target_;
  std::string path_;
  int dimension_;
  Report& report_;
  toml::table out_;
  std::set<std::string> undecided_;  ///< keys that are wrong, or depend on one that is
};

}  // namespace

toml::table complete_scene(const toml::table& written, Scene& scene, Report& report) {
  report.place("", {1, 1});
  // Points are judged by the dimension that the scene asks for or, if that is none, by the length of its gravity.
  const auto asked = written["dimension"].value_or<std::int64_t>(written.contains("dimension") ? 0 : 2);
  const toml::array* gravity = written["gravity"].as_array();
  const int dimension = asked == 3 || (asked != 2 && gravity && gravity->size() == 3) ? 3 : 2;
  return TableWalker(written, scene_section(), &scene, "", dimension, report).complete();
}

}  // namespace geodrop
