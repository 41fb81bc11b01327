#include "scene_schema.hpp"

#include <algorithm>
#include <utility>

#include "base/json.hpp"
#include "key_table.hpp"

namespace geodrop {
namespace {

Json object_of(const Section& section);

Json list_of(Json items) { return {{"type", "array"}, {"items", std::move(items)}}; }

Json type_of(const Key& key) {
  Json text = {{"type", "string"}}, number = {{"type", "number"}};
  switch (key.kind) {
    case Kind::text:
    case Kind::name:
      return text;
    case Kind::choice:
      return {{"type", "string"}, {"enum", key.words}};
    case Kind::texts:
    case Kind::names:
      return list_of(std::move(text));
    case Kind::boolean:
      return {{"type", "boolean"}};
    case Kind::integer:
      return {{"type", "integer"}};
    case Kind::real:
      return number;
    case Kind::reals:
    case Kind::point:
      return list_of(std::move(number));
    case Kind::points:
      return list_of(list_of(std::move(number)));
    case Kind::table:
      return object_of(*key.below);
    case Kind::named_tables:
      return {{"type", "object"}, {"additionalProperties", object_of(*key.below)}};
    case Kind::table_list:
      return list_of(object_of(*key.below));
  }
  return {};
}

std::string description_of(const Key& key) {
  std::string text(key.meaning);
  if (!key.unit.empty()) text += " [" + std::string(key.unit) + "]";
  if (key.need.how == Need::How::standard) text += "; default " + std::string(key.need.text);
  if (key.need.how == Need::How::derived) text += "; default: " + std::string(key.need.text);
  return text;
}

/// Rows of one name with different conditions: any of their types.
void add(Json& properties, const Key& key) {
  const std::string name(key.name);
  Json row = type_of(key);
  row["description"] = description_of(key);
  if (!properties.contains(name)) {
    properties[name] = std::move(row);
    return;
  }
  Json& present = properties[name];
  if (present == row) return;
  if (!present.contains("anyOf")) present = Json{{"anyOf", Json::array({present})}};
  present["anyOf"].push_back(std::move(row));
}

Json object_of(const Section& section) {
  Json object = {{"type", "object"}, {"additionalProperties", false}, {"properties", Json::object()}};
  Json required = Json::array();
  for (const Key& key : section.keys) {
    add(object["properties"], key);
    if (!key.former.empty()) object["properties"][std::string(key.former)] = type_of(key);
    const bool always = key.need.how == Need::How::required && key.when.empty() && key.dimension == 0;
    if (always && std::ranges::find(required, Json(key.name)) == required.end()) required.push_back(key.name);
  }
  if (!required.empty()) object["required"] = required;
  return object;
}

}  // namespace

std::string scene_schema() {
  Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "geodrop scene"}};
  schema.update(object_of(scene_section()));
  return json_text(schema);
}

}  // namespace geodrop
