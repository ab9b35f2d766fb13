// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nanobind/nanobind.h>

#include <nlohmann/json.hpp>
#include <string>

namespace phongpd::python {

// A row as Python's own dicts, lists, texts and numbers.
inline nanobind::object ToObject(const nlohmann::ordered_json& json) {
  namespace nb = nanobind;
  if (json.is_object()) {
    nb::dict object;
    for (const auto& [key, value] : json.items()) {
      object[key.c_str()] = ToObject(value);
    }
    return object;
  }
  if (json.is_array()) {
    nb::list list;
    for (const auto& value : json) list.append(ToObject(value));
    return list;
  }
  if (json.is_null()) return nb::none();
  if (json.is_boolean()) return nb::bool_(json.get<bool>());
  if (json.is_number_unsigned()) {
    return nb::int_(json.get<unsigned long long>());
  }
  if (json.is_number_integer()) return nb::int_(json.get<long long>());
  if (json.is_number()) return nb::float_(json.get<double>());
  const auto& text = json.get_ref<const std::string&>();
  return nb::str(text.data(), text.size());
}

}  // namespace phongpd::python
