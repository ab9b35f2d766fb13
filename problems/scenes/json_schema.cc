// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/scenes/json_schema.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "core/nearest_name.h"
#include "problems/output/text.h"

namespace phongpd {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kMaxNesting = 100;

std::string Dump(const Json& value) {
  return value.dump(-1, ' ', true, Json::error_handler_t::replace);
}

std::string QuotedJson(const std::string& text) { return Dump(Json(text)); }

class Validator {
 public:
  explicit Validator(const Json& root) : root_(root) {}

  void Check(const Json& value, const Json& unresolved,
             const JsonPlace& place) const {
    const Json& schema = Resolved(unresolved);
    if (schema.contains("anyOf")) {
      for (const Json& alternative : schema["anyOf"]) {
        if (IsOfType(value, alternative["type"])) {
          // Three angles are meant as something else than a cut-off matrix.
          if (value.is_array() && !MeetsLimits(value, alternative)) break;
          return Check(value, alternative, place);
        }
      }
      place.Fail(Described(schema), Shortened(value));
    }
    if (!MeetsLimits(value, schema)) {
      place.Fail(Described(schema), Shortened(value) + Nearest(value, schema));
    }
    if (value.is_object()) CheckObject(value, schema, place);
    if (value.is_array() && schema.contains("items")) {
      for (std::size_t i = 0; i < value.size(); ++i) {
        Check(value[i], schema["items"], place.Child(i));
      }
    }
  }

 private:
  const Json& Resolved(const Json& schema) const {
    if (!schema.contains("$ref")) return schema;
    const auto reference = schema["$ref"].get<std::string>();
    return Resolved(root_.at(Json::json_pointer(reference.substr(1))));
  }

  static bool IsOfType(const Json& value, const Json& type) {
    if (type.is_array()) {
      return std::any_of(type.begin(), type.end(),
                         [&](const Json& one) { return IsOfType(value, one); });
    }
    const auto name = type.get<std::string>();
    if (name == "integer" || name == "number") {
      if (!value.is_number()) return false;
      const double number = value.get<double>();
      if (!std::isfinite(number)) return false;
      return name == "number" || number == std::floor(number);
    }
    return name == value.type_name();
  }

  static bool MeetsLimits(const Json& value, const Json& schema) {
    if (schema.contains("type") && !IsOfType(value, schema["type"])) {
      return false;
    }
    if (schema.contains("enum")) {
      const Json& choices = schema["enum"];
      return std::find(choices.begin(), choices.end(), value) != choices.end();
    }
    if (value.is_number()) {
      const double x = value.get<double>();
      return !(schema.contains("minimum") && x < schema["minimum"]) &&
             !(schema.contains("maximum") && x > schema["maximum"]) &&
             !(schema.contains("exclusiveMinimum") &&
               x <= schema["exclusiveMinimum"]);
    }
    if (value.is_string()) {
      return value.get_ref<const std::string&>().size() >=
             schema.value("minLength", std::size_t{0});
    }
    if (value.is_array()) {
      return value.size() >= schema.value("minItems", std::size_t{0}) &&
             value.size() <= schema.value("maxItems", value.size());
    }
    return true;
  }

  void CheckObject(const Json& value, const Json& schema,
                   const JsonPlace& place) const {
    const Json none = Json::object();
    const Json& known =
        schema.contains("properties") ? schema["properties"] : none;
    const bool is_closed = schema.contains("additionalProperties") &&
                           schema["additionalProperties"].is_boolean();
    for (const auto& [key, item] : value.items()) {
      if (!known.contains(key) && is_closed) Refuse(key, known, place);
    }
    const auto require = [&](const Json& keys) {
      for (const Json& key : keys) {
        const auto name = key.get<std::string>();
        if (value.contains(name)) continue;
        place.Child(name).Fail(Described(known[name]), "nothing");
      }
    };
    if (schema.contains("required")) require(schema["required"]);
    if (schema.contains("oneOf")) RequireOne(value, schema["oneOf"], place);
    if (schema.contains("dependentRequired")) {
      for (const auto& [key, others] : schema["dependentRequired"].items()) {
        if (value.contains(key)) require(others);
      }
    }
    for (const auto& [key, item] : value.items()) {
      if (known.contains(key)) {
        Check(item, known[key], place.Child(key));
      } else if (schema.contains("additionalProperties")) {
        Check(item, schema["additionalProperties"], place.Child(key));
      }
    }
  }

  [[noreturn]] static void Refuse(const std::string& key, const Json& known,
                                  const JsonPlace& place) {
    std::vector<std::string> names;
    for (const auto& [name, schema] : known.items()) names.push_back(name);
    place.Fail("only the keys " + Joined(names),
               Shortened(Json(key)) + DidYouMean(key, names));
  }

  static void RequireOne(const Json& value, const Json& alternatives,
                         const JsonPlace& place) {
    std::string list, found;
    int count = 0;
    for (const Json& alternative : alternatives) {
      const auto key = alternative["required"][0].get<std::string>();
      list += (list.empty() ? "" : " or ") + QuotedJson(key);
      if (!value.contains(key)) continue;
      found += (count++ == 0 ? "" : " and ") + QuotedJson(key);
    }
    if (count == 1) return;
    place.Fail("either " + list, count == 0 ? "neither" : found);
  }

  // Which choice was meant, if one is near.
  static std::string Nearest(const Json& value, const Json& schema) {
    if (!schema.contains("enum") || !value.is_string()) return "";
    return DidYouMean(value.get<std::string>(),
                      schema["enum"].get<std::vector<std::string>>());
  }

  // What a schema asks for, in words.
  std::string Described(const Json& unresolved) const {
    const Json& schema = Resolved(unresolved);
    std::string text;
    if (schema.contains("anyOf")) {
      for (const Json& alternative : schema["anyOf"]) {
        text += (text.empty() ? "" : " or ") + Described(alternative);
      }
      return text;
    }
    if (schema.contains("enum")) {
      for (const Json& choice : schema["enum"]) {
        text += (text.empty() ? "one of " : ", ") + Dump(choice);
      }
      return text;
    }
    if (schema["type"].is_array()) {
      for (const Json& type : schema["type"]) {
        text += (text.empty() ? "" : " or ") + Described({{"type", type}});
      }
      return text;
    }
    const auto type = schema["type"].get<std::string>();
    if (type == "array") return DescribedArray(schema);
    if (type == "object") {
      if (!schema.contains("required")) return "an object";
      for (const Json& key : schema["required"]) {
        text += (text.empty() ? "an object with " : ", ") + Dump(key);
      }
      return text;
    }
    if (type == "boolean") return "true or false";
    if (type == "string") {
      return schema.contains("minLength") ? "a text that is not empty"
                                          : "a text";
    }
    text = type == "integer" ? "a whole number" : "a number";
    std::string joint = " ";
    const auto limit = [&](const char* key, const char* sign) {
      if (!schema.contains(key)) return;
      text += joint + sign + ' ' + FormatDouble(schema[key].get<double>());
      joint = " and ";
    };
    limit("minimum", ">=");
    limit("exclusiveMinimum", ">");
    limit("maximum", "<=");
    return text;
  }

  std::string DescribedArray(const Json& schema) const {
    const std::size_t least = schema.value("minItems", std::size_t{0});
    const bool is_exact = schema.value("maxItems", Json()) == least;
    const Json& items = Resolved(schema["items"]);
    const bool is_numeric = items.value("type", Json()) == "number";
    return std::string("an array of ") + (is_exact ? "" : "at least ") +
           std::to_string(least) + (is_numeric ? " numbers" : " items");
  }

  const Json& root_;
};

}  // namespace

JsonPlace JsonPlace::Child(const std::string& key) const {
  const std::string text = Shortened(Json(key));
  std::string escaped;
  for (const char c : text.substr(1, text.size() - 2)) {
    escaped += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
  }
  return {file, pointer + '/' + escaped};
}

JsonPlace JsonPlace::Child(std::size_t index) const {
  return {file, pointer + '/' + std::to_string(index)};
}

std::string JsonPlace::Text() const {
  return pointer.empty() ? file : file + ": " + pointer;
}

void JsonPlace::Fail(const std::string& expected,
                     const std::string& found) const {
  throw InputError(Text() + ": expected " + expected + ", found " + found);
}

std::string Shortened(const Json& value) {
  constexpr std::size_t kLongest = 60;
  if (value.is_number_float() && !std::isfinite(value.get<double>())) {
    return FormatDouble(value.get<double>());
  }
  const std::string text = Dump(value);
  if (text.size() <= kLongest) return text;
  return text.substr(0, kLongest) + "...";
}

namespace {

// Of the parser's own words, of which none says what to do.
std::string HowToMendJson(const std::string& what) {
  const auto says = [&what](const char* words) {
    return what.find(words) != std::string::npos;
  };
  if (says("unexpected end of input")) {
    return "; a } or ] is missing at the end";
  }
  if (says("; expected string literal")) {
    return "; keys stand in double quotes, and no comma before a }";
  }
  if (says("expected '}'") || says("expected ']'")) {
    return "; is a comma missing before it?";
  }
  return "";
}

}  // namespace

Json ParseJson(const std::string& text, const std::string& file) {
  std::vector<std::set<std::string>> keys;
  const auto watch = [&](int depth, Json::parse_event_t event, Json& parsed) {
    using Event = Json::parse_event_t;
    if (depth > kMaxNesting) {
      throw InputError(file + ": expected nesting of at most " +
                       std::to_string(kMaxNesting) + " levels, found more");
    }
    if (event == Event::object_start) keys.emplace_back();
    if (event == Event::object_end) keys.pop_back();
    if (event == Event::key && !keys.back().insert(parsed).second) {
      throw InputError(file + ": expected each key once, found " +
                       Shortened(parsed) + " twice in one object");
    }
    return true;
  };
  try {
    return Json::parse(text, watch, true, true);
  } catch (const Json::exception& error) {
    std::string what = error.what();
    what.erase(0, what.find("] ") + 2);
    // It repeats all of the text or number that it was reading.
    constexpr std::size_t kBegin = 160, kEnd = 80;
    if (what.size() > kBegin + kEnd) {
      what.replace(kBegin, what.size() - kBegin - kEnd, "...");
    }
    throw InputError(file + ": expected JSON, found a " + what +
                     HowToMendJson(what));
  }
}

void RequireSchema(const Json& value, const Json& schema,
                   const std::string& file) {
  Validator(schema).Check(value, schema, {file, ""});
}

}  // namespace phongpd
