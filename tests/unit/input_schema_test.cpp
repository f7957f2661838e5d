#include "crampon/input/schema.hpp"

#include <algorithm>
#include <stdexcept>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "crampon/contact/laws/frictionless.hpp"
#include "crampon/input/reference.hpp"
#include "unit/input_samples.hpp"

namespace crampon {
namespace {

// A law made up here. Nothing but its declaration and its name in the family is said.
struct ToyContact {
  double stickiness = 0.25;
};
using ToyLaw = std::variant<FrictionlessContact, ToyContact>;
const Declaration<ToyContact>& toy_declaration() {
  static const auto d = Declaration<ToyContact>("toy", "Glue that a test made up.")
                            .quantity("stickiness", &ToyContact::stickiness, "Pa", Bounds::between(0, 1e9), "how much it sticks");
  return d;
}

struct ToyMaterial {
  double E = 0, density = 0;
};

TEST(ToyLaw, IsSeenByParserSchemaReferenceAndResolvedInput) {
  // Materials may be added at run time; the toy borrows the engine side of an existing law.
  static const auto declaration =
      Declaration<ToyMaterial>("toy_putty", "Putty that a test made up.")
          .quantity("E", &ToyMaterial::E, "Pa", Bounds::positive(), "stiffness of the putty", Presence::required)
          .quantity("density", &ToyMaterial::density, "kg/m3", Bounds::positive(), "mass per initial volume", Presence::required);
  MaterialSpec existing = read_problem_text(base_input(), "in.toml").materials[0].law;
  materials().add(declaration, [existing](ToyMaterial m) -> MaterialSpec {
    if (m.E > 1e9) throw std::invalid_argument("that is no putty");
    return existing;
  });

  std::string text = replaced(base_input(), "\"neo_hookean\"", "\"toy_putty\"");
  EXPECT_EQ(errors_of(text),
            Lines{"in.toml:11:1: material[0].nu: unknown key (material has no such key); choose from: name, law, E, density"});
  text = replaced(text, "nu = 0.3\n", "");
  const Problem p = read_problem_text(text, "in.toml");
  EXPECT_EQ(p.materials[0].law, existing);
  EXPECT_NE(write_resolved(p).find("law = \"toy_putty\"\nE = 1000000.0  # Pa\n"), std::string::npos);
  EXPECT_EQ(errors_of(replaced(text, "\"1 MPa\"", "\"2 GPa\"")),
            Lines{"in.toml:9:7: material[0].law: that is no putty (Putty that a test made up); correct the parameters"});
  EXPECT_NE(errors_of(replaced(base_input(), "\"neo_hookean\"", "\"toy_puty\""))[0].find("did you mean \"toy_putty\"?"), std::string::npos);
  EXPECT_NE(json_schema().find("\"toy_putty\""), std::string::npos);
  EXPECT_NE(json_schema().find("stiffness of the putty [Pa]"), std::string::npos);
  EXPECT_NE(reference_page().find("### toy_putty\n\nPutty that a test made up."), std::string::npos);
  EXPECT_NE(reference_page().find("| `E` | quantity | Pa | **required** | > 0 | stiffness of the putty |"), std::string::npos);
}

struct ToyInput {
  ToyLaw law = ToyContact{};
};

TEST(ToyLaw, FamiliesOfVariantsNeedNoMoreThanTheirDeclarations) {
  static const auto family =
      Family<ToyLaw>("toy law", "law", "Laws of a test.").add(FrictionlessContact::declaration()).add(toy_declaration());
  const auto record = Declaration<ToyInput>("toy input", "An input of a test.")
                          .one_of(
                              "contact", &ToyInput::law, []() -> const Family<ToyLaw>& { return family; }, "a law");
  const std::string page = reference_page(record);
  EXPECT_NE(page.find("| `contact` | [toy law](#toy-law-family) |  | `\"toy\"` |  | a law |"), std::string::npos) << page;
  EXPECT_NE(page.find("| `stickiness` | quantity | Pa | `0.25` | >= 0 and <= 1000000000 | how much it sticks |"), std::string::npos)
      << page;
  const auto schema = nlohmann::json::parse(json_schema(record));
  EXPECT_EQ(schema["definitions"]["toy_law"]["anyOf"][1]["properties"]["stickiness"]["default"], 0.25);
}

// What of a schema the tests need: does `value` satisfy it? Draft 4, the keywords that json_schema() writes.
bool satisfies(const nlohmann::json& value, const nlohmann::json& schema, const nlohmann::json& root) {
  if (schema.contains("$ref"))
    return satisfies(value, root.at(nlohmann::json::json_pointer(schema["$ref"].get<std::string>().substr(1))), root);
  const auto any = [&](const char* key) {
    return std::count_if(schema[key].begin(), schema[key].end(), [&](const auto& s) { return satisfies(value, s, root); });
  };
  if (schema.contains("anyOf") && any("anyOf") == 0) return false;
  if (schema.contains("oneOf") && any("oneOf") != 1) return false;
  if (schema.contains("allOf") && any("allOf") != std::ptrdiff_t(schema["allOf"].size())) return false;
  if (schema.contains("not") && satisfies(value, schema["not"], root)) return false;
  if (schema.contains("enum") && std::find(schema["enum"].begin(), schema["enum"].end(), value) == schema["enum"].end()) return false;
  const std::string type = schema.value("type", "");
  if ((type == "number" && !value.is_number()) || (type == "integer" && !value.is_number_integer()) ||
      (type == "string" && !value.is_string()) || (type == "boolean" && !value.is_boolean()) || (type == "array" && !value.is_array()) ||
      (type == "object" && !value.is_object()))
    return false;
  if (value.is_number() && schema.contains("minimum")) {
    const double low = schema["minimum"], x = value;
    if (x < low || (x == low && schema.value("exclusiveMinimum", false))) return false;
  }
  if (value.is_array()) {
    if (value.size() < schema.value("minItems", 0u) || value.size() > schema.value("maxItems", std::size_t(-1))) return false;
    for (const auto& item : value)
      if (schema.contains("items") && !satisfies(item, schema["items"], root)) return false;
  }
  if (value.is_object()) {
    for (const auto& key : schema.value("required", nlohmann::json::array()))
      if (!value.contains(key.get<std::string>())) return false;
    for (const auto& [key, item] : value.items()) {
      const bool known = schema.contains("properties") && schema["properties"].contains(key);
      if (!known && schema.contains("additionalProperties")) return false;
      if (known && !satisfies(item, schema["properties"][key], root)) return false;
    }
  }
  return true;
}

TEST(Schema, AcceptsASampleAndRefusesWhatIsWrong) {
  const auto schema = nlohmann::json::parse(json_schema());
  EXPECT_EQ(schema["$schema"], "http://json-schema.org/draft-04/schema#");
  EXPECT_EQ(schema["required"], (nlohmann::json{"grid", "time", "material", "body"}));
  EXPECT_EQ(schema["properties"]["grid"]["properties"]["cell"]["description"], "cell size; one for all axes or one per axis [m]");
  EXPECT_EQ(schema["properties"]["time"]["properties"]["courant"]["default"], 0.4);
  auto sample = nlohmann::json::parse(R"({
    "grid": {"origin": [0, 0], "size": ["100 mm", 0.05], "cell": "5 mm"},
    "time": {"end": "1 ms"},
    "method": {"damping": {"times": [0, 1], "values": [0, "30 1/s"]}},
    "material": [{"name": "soft", "law": "neo_hookean", "E": "1 MPa", "nu": 0.3, "density": 1500}],
    "body": [{"name": "b", "material": "soft", "shape": {"kind": "union", "of": [{"kind": "disk", "centre": [0, 0], "radius": 1}]}}],
    "crack": [{"points": [[0, 0], ["1 mm", 0]], "contact": "bonded"},
              {"points": [[0, 0], [1, 0]], "contact": {"law": "coulomb", "friction": 0.1}}]
  })");
  EXPECT_TRUE(satisfies(sample, schema, schema));
  const auto refuses = [&](const char* pointer, const nlohmann::json& value) {
    auto changed = sample;
    changed[nlohmann::json::json_pointer(pointer)] = value;
    return !satisfies(changed, schema, schema);
  };
  EXPECT_TRUE(refuses("/gird", 1));
  EXPECT_TRUE(refuses("/time/steps", 3));
  EXPECT_TRUE(refuses("/grid/cell", 0));
  EXPECT_TRUE(refuses("/grid/cell", true));
  EXPECT_TRUE(refuses("/grid/origin", {1}));
  EXPECT_TRUE(refuses("/material/0/law", "neo"));
  EXPECT_TRUE(refuses("/material/0/friction", 0.1));
  EXPECT_TRUE(refuses("/body/0/shape/of/0/kind", "disc"));
  EXPECT_TRUE(refuses("/crack/0/contact", "coulomb"));
  EXPECT_TRUE(refuses("/material", nlohmann::json::array()));
  EXPECT_FALSE(refuses("/title", "a"));
}

TEST(Reference, NamesEveryKeyOfEveryTable) {
  const std::string page = reference_page();
  EXPECT_NE(
      page.find("| `cell` | list of quantities | m | **required** | > 0; 1 to 3 values | cell size; one for all axes or one per axis |"),
      std::string::npos);
  EXPECT_NE(page.find("not together with `end` |"), std::string::npos);
  EXPECT_NE(page.find("| N or Pa by `kind` | **required** |"), std::string::npos);
  for (const Entry& table : problem_declaration().entries()) {
    EXPECT_NE(page.find("| `" + table.key + "` |"), std::string::npos) << table.key;
    if (table.record) {
      for (const Entry& entry : table.record().entries()) EXPECT_NE(page.find("| `" + entry.key + "` |"), std::string::npos) << entry.key;
    }
  }
  for (const Alternative& a : contact_laws().alternatives())
    EXPECT_NE(page.find("### " + a.name() + "\n\n" + a.record->help()), std::string::npos);
}

}  // namespace
}  // namespace crampon
