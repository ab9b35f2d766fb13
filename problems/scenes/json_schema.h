// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/mesh/mesh_error.h"

// Checks of JSON documents whose messages tell a person what to change.
namespace phongpd {

// A document and a place in it, as messages name them: "FILE: /pointer".
struct JsonPlace {
  std::string file;
  std::string pointer;  // RFC 6901; empty: the whole document

  JsonPlace Child(const std::string& key) const;
  JsonPlace Child(std::size_t index) const;
  std::string Text() const;
  // Throws InputError "FILE: /pointer: expected EXPECTED, found FOUND".
  [[noreturn]] void Fail(const std::string& expected,
                         const std::string& found) const;
};

// `value` on one line, shortened to what a message can hold.
std::string Shortened(const nlohmann::ordered_json& value);

// Parses one JSON document; // and /* */ comments are allowed.  Throws
// InputError "FILE: ..." for anything else, for keys that occur twice in an
// object, and for nesting deeper than 100.
nlohmann::ordered_json ParseJson(const std::string& text,
                                 const std::string& file);

// Throws InputError at the first place where `value` is not what `schema`
// (JSON Schema draft 2020-12) asks for.  Understands $ref within the schema,
// type, enum, minimum, exclusiveMinimum, maximum, minLength, minItems,
// maxItems, items, properties, required, dependentRequired and
// additionalProperties; `anyOf` of alternatives that differ in type; `oneOf` of
// alternatives that are one required key each.  Numbers must be finite.
// Anything else is ignored.
void RequireSchema(const nlohmann::ordered_json& value,
                   const nlohmann::ordered_json& schema,
                   const std::string& file);

}  // namespace phongpd
