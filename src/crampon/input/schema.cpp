#include "crampon/input/schema.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "crampon/input/problem.hpp"

namespace crampon {
namespace {

using Json = nlohmann::ordered_json;
using Kind = Entry::Kind;

Json number_schema(const char* type, const Bounds& bounds) {
  Json schema = {{"type", type}};
  if (std::isfinite(bounds.low)) {
    schema["minimum"] = bounds.low;
    if (bounds.low_open) schema["exclusiveMinimum"] = true;
  }
  if (std::isfinite(bounds.high)) {
    schema["maximum"] = bounds.high;
    if (bounds.high_open) schema["exclusiveMaximum"] = true;
  }
  return schema;
}

// A number in SI, or text that starts with a number and names a unit.
Json quantity_schema(const Bounds& bounds) {
  Json text = {{"type", "string"}, {"pattern", "^\\s*[-+]?[0-9.]"}};
  return {{"anyOf", Json::array({number_schema("number", bounds), std::move(text)})}};
}

Json array_schema(Json items, const Length& length) {
  Json schema = {{"type", "array"}, {"items", std::move(items)}};
  if (length.least > 0) schema["minItems"] = length.least;
  if (length.most != Length{}.most) schema["maxItems"] = length.most;
  return schema;
}

// One value alone stands for an array of one.
Json one_or_array(const Json& item, const Length& length) {
  if (!length.contains(1)) return array_schema(item, length);
  return {{"anyOf", Json::array({item, array_schema(item, length)})}};
}

// null where JSON or a single number cannot say it.
struct DefaultToJson {
  Json operator()(std::monostate) const { return nullptr; }
  Json operator()(const ValueFunction& f) const {
    return f.depends_on_time() || f.depends_on_position() ? Json(nullptr) : Json(f(0, Vec<3>{}));
  }
  Json operator()(const std::vector<ValueFunction>&) const { return nullptr; }
  Json operator()(double x) const { return std::isfinite(x) ? Json(x) : Json(nullptr); }
  template <class V>
  Json operator()(const V& x) const {
    return Json(x);
  }
};

class SchemaWriter {
 public:
  explicit SchemaWriter(const KnownWords& known) : known_(known) {}

  Json write(const Record& root) {
    Json schema = {{"$schema", "http://json-schema.org/draft-04/schema#"}, {"title", "Crampon input"}};
    schema.update(record_schema(root));
    schema["definitions"] = Json::object();
    schema["definitions"]["function"] = function_schema();
    for (const auto& [name, definition] : definitions_) schema["definitions"][name] = definition;
    return schema;
  }

 private:
  const KnownWords& known_;
  std::map<std::string, Json> definitions_;

  Json text_schema(const Entry& entry) const {
    Json text = {{"type", "string"}};
    const auto words = known_.find(entry.words);
    if (words == known_.end()) return text;
    return {{"anyOf", Json::array({Json{{"enum", words->second}}, std::move(text)})}};
  }

  static Json function_schema() {
    Json table = {{"type", "object"}, {"additionalProperties", false}};
    table["properties"] = {{"expression", {{"type", "string"}, {"description", "formula of t, x, y, z and pi in SI"}}},
                           {"unit", {{"type", "string"}, {"description", "unit of the formula or of the file's values"}}},
                           {"scale", {{"type", "number"}, {"description", "factor to SI, in place of the unit"}}},
                           {"times", array_schema(quantity_schema({}), Length::at_least(1))},
                           {"values", array_schema(quantity_schema({}), Length::at_least(1))},
                           {"file", {{"type", "string"}, {"description", "CSV file with the columns time and value"}}}};
    Json schema = quantity_schema({});
    schema["anyOf"].push_back(std::move(table));
    return schema;
  }

  static Json reference(const std::string& id) { return Json::object({{"$ref", "#/definitions/" + id}}); }

  // Entries of one record into an object schema under construction.
  void add_entries(Json& schema, const Record& record) {
    const std::shared_ptr<void> defaults = record.create();
    for (const Entry& entry : record.entries()) {
      if (entry.kind == Kind::inline_one_of) continue;
      Json property = entry_schema(entry);
      property["description"] = describe(entry);
      if (entry.plain() && entry.presence == Presence::optional) {
        const Json value = std::visit(DefaultToJson{}, entry.get(defaults.get()));
        if (!value.is_null() && !(value.is_array() && value.empty())) property["default"] = value;
      }
      schema["properties"][entry.key] = std::move(property);
      if (entry.presence == Presence::required) schema["required"].push_back(entry.key);
      for (const std::string& other : entry.excludes)
        schema["allOf"].push_back(Json{{"not", {{"required", Json::array({entry.key, other})}}}});
    }
  }

  static Json object_schema(const std::string& title, const std::string& help) {
    Json schema = Json::object();
    if (!title.empty()) schema["title"] = title;
    schema["description"] = help;
    schema["type"] = "object";
    schema["additionalProperties"] = false;
    schema["properties"] = Json::object();
    return schema;
  }

  Json record_schema(const Record& record) {
    const auto choice =
        std::find_if(record.entries().begin(), record.entries().end(), [](const Entry& e) { return e.kind == Kind::inline_one_of; });
    if (choice == record.entries().end()) {
      Json schema = object_schema("", record.help());
      add_entries(schema, record);
      return schema;
    }
    // One complete object for each alternative: Draft 4 cannot forbid further keys across combined schemas.
    Json schema = {{"description", record.help()}, {"oneOf", Json::array()}};
    for (const Alternative& alternative : choice->family().alternatives()) {
      Json object = object_schema(alternative.name(), alternative.record->help());
      add_entries(object, record);
      add_tag(object, choice->key, alternative.name(), choice->help);
      add_entries(object, *alternative.record);
      schema["oneOf"].push_back(std::move(object));
    }
    return schema;
  }

  static void add_tag(Json& schema, const std::string& key, const std::string& name, const std::string& help) {
    schema["properties"][key] = {{"enum", Json::array({name})}, {"description", help}};
    schema["required"].push_back(key);
  }

  Json family_reference(const AnyFamily& family) {
    std::string id = family.name();
    std::replace(id.begin(), id.end(), ' ', '_');
    if (!definitions_.contains(id)) {
      definitions_[id] = nullptr;  // a family may contain itself
      Json schema = {{"description", family.help()}, {"anyOf", Json::array()}};
      Json words = Json::array();
      for (const Alternative& alternative : family.alternatives()) {
        Json object = object_schema(alternative.name(), alternative.record->help());
        add_tag(object, family.tag_key(), alternative.name(), family.help());
        add_entries(object, *alternative.record);
        if (object["required"].size() == 1) words.push_back(alternative.name());
        schema["anyOf"].push_back(std::move(object));
      }
      if (!words.empty()) schema["anyOf"].push_back(Json{{"enum", std::move(words)}});
      definitions_[id] = std::move(schema);
    }
    return reference(id);
  }

  Json entry_schema(const Entry& entry) {
    switch (entry.kind) {
      case Kind::quantity:
        return quantity_schema(entry.bounds);
      case Kind::quantities:
        return one_or_array(quantity_schema(entry.bounds), entry.length);
      case Kind::points:
        return array_schema(array_schema(quantity_schema(entry.bounds), entry.length), {});
      case Kind::integer:
        return number_schema("integer", entry.bounds);
      case Kind::integers:
        return one_or_array(number_schema("integer", entry.bounds), entry.length);
      case Kind::flag:
        return {{"type", "boolean"}};
      case Kind::text:
        return text_schema(entry);
      case Kind::texts:
        return one_or_array(text_schema(entry), entry.length);
      case Kind::choice:
        return {{"enum", entry.choices}};
      // A $ref must stand alone in Draft 4; allOf lets a description stand beside it.
      case Kind::function:
        return {{"allOf", Json::array({reference("function")})}};
      case Kind::functions:
        return one_or_array(reference("function"), entry.length);
      case Kind::record:
        return record_schema(entry.record());
      case Kind::records: {
        const Length length = entry.presence == Presence::required ? Length::at_least(1) : Length{};
        return array_schema(record_schema(entry.record()), length);
      }
      case Kind::one_of:
        return {{"allOf", Json::array({family_reference(entry.family())})}};
      case Kind::one_of_list:
        return array_schema(family_reference(entry.family()), entry.length);
      case Kind::inline_one_of:
        break;
    }
    return Json::object();
  }

  static std::string describe(const Entry& entry) {
    std::string text = entry.help;
    if (!entry.units.empty()) {
      for (std::size_t k = 0; k < entry.units.size(); ++k)
        text += fmt::format("{}{} for {}", k ? ", " : " [", entry.units[k].second, entry.units[k].first);
      text += "]";
    } else if (!entry.unit.empty() && entry.unit != "1" && entry.unit != "any") {
      text += fmt::format(" [{}]", entry.unit);
    }
    return text;
  }
};

}  // namespace

std::string json_schema(const KnownWords& known) { return json_schema(problem_declaration(), known); }
std::string json_schema(const Record& root, const KnownWords& known) { return SchemaWriter(known).write(root).dump(2) + "\n"; }

}  // namespace crampon
