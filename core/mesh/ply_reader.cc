// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/mesh/mesh_scanner.h"
#include "core/mesh/polygon_soup.h"

namespace phongpd::internal {
namespace {

enum class Type {
  kInt8,
  kUint8,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kFloat,
  kDouble
};

struct TypeName {
  const char* name;
  const char* sized_name;
  Type type;
  std::size_t bytes;
};
constexpr TypeName kTypes[] = {{"char", "int8", Type::kInt8, 1},
                               {"uchar", "uint8", Type::kUint8, 1},
                               {"short", "int16", Type::kInt16, 2},
                               {"ushort", "uint16", Type::kUint16, 2},
                               {"int", "int32", Type::kInt32, 4},
                               {"uint", "uint32", Type::kUint32, 4},
                               {"float", "float32", Type::kFloat, 4},
                               {"double", "float64", Type::kDouble, 8}};

// 0, 1, ... `most`; a text may spell any number, or NaN.
bool IsWhole(double x, double most) {
  return std::isgreaterequal(x, 0.0) && std::islessequal(x, most) &&
         x == std::floor(x);
}

bool IsReal(Type type) { return type == Type::kFloat || type == Type::kDouble; }

// What a property means to us: x, y, z of a vertex, corners of a face.
enum class Role { kX, kY, kZ, kCorners, kNone };

struct Property {
  Role role = Role::kNone;
  bool is_list = false;
  const TypeName* count = nullptr;  // of a list
  const TypeName* type = nullptr;
};

struct Element {
  enum Kind { kVertex, kFace, kOther } kind = kOther;
  std::string name;
  unsigned long long count = 0;
  std::vector<Property> properties;
};

class PlyReader {
 public:
  PlyReader(std::string_view bytes, const std::string& file)
      : scanner_(bytes, "PLY", file) {}

  PolygonSoup Read() {
    ReadHeader();
    for (const Element& element : elements_) {
      if (element.properties.empty()) continue;  // takes no bytes
      scanner_.RequireRoom(element.count, LeastBytes(element), element.name);
      for (unsigned long long i = 0; i < element.count; ++i) ReadItem(element);
    }
    return std::move(soup_);
  }

 private:
  void ReadHeader() {
    std::string_view line = TakeLine(&scanner_.rest());
    if (TakeWord(&line) != "ply") scanner_.RefuseContent();
    bool has_format = false;
    for (;;) {
      if (scanner_.AtEnd()) scanner_.RefuseContent();
      line = TakeLine(&scanner_.rest());
      const std::string_view keyword = TakeWord(&line);
      if (keyword == "format") {
        ReadFormat(TakeWord(&line));
        has_format = true;
      } else if (keyword == "element") {
        ReadElement(line);
      } else if (keyword == "property") {
        ReadProperty(line);
      } else if (keyword == "end_header") {
        break;
      }  // else a comment
    }
    if (!has_format) scanner_.RefuseContent();
    RequireCoordinates();
  }

  void ReadFormat(std::string_view name) {
    is_text_ = name == "ascii";
    is_big_endian_ = name == "binary_big_endian";
    if (!is_text_ && !is_big_endian_ && name != "binary_little_endian") {
      scanner_.RefuseContent();
    }
  }

  void ReadElement(std::string_view line) {
    Element element;
    const std::string_view name = TakeWord(&line);
    long long count = -1;
    if (!ParseInteger(TakeWord(&line), &count) || count < 0) {
      scanner_.Refuse("PLY header; expected a count of " + Quoted(name) +
                      ", found none; export it again");
    }
    element.count = static_cast<unsigned long long>(count);
    if (name == "vertex" || name == "vertices") element.kind = Element::kVertex;
    if (name == "face" || name == "faces") element.kind = Element::kFace;
    element.name = element.kind == Element::kOther ? Quoted(name) : name;
    elements_.push_back(std::move(element));
  }

  const TypeName* FindType(std::string_view name) const {
    for (const TypeName& type : kTypes) {
      if (name == type.name || name == type.sized_name) return &type;
    }
    scanner_.Refuse("PLY header; expected a type such as int or float, found " +
                    Quoted(name) + "; export it again");
  }

  void ReadProperty(std::string_view line) {
    if (elements_.empty()) scanner_.RefuseContent();
    Element& element = elements_.back();
    Property property;
    std::string_view word = TakeWord(&line);
    property.is_list = word == "list";
    if (property.is_list) {
      property.count = FindType(TakeWord(&line));
      if (IsReal(property.count->type)) scanner_.RefuseContent();
      word = TakeWord(&line);
    }
    property.type = FindType(word);
    const std::string_view name = TakeWord(&line);
    if (element.kind == Element::kVertex && !property.is_list) {
      const std::size_t axis = name.size() == 1 ? name[0] - 'x' : 3u;
      if (axis < 3) property.role = static_cast<Role>(axis);
    } else if (element.kind == Element::kFace && property.is_list &&
               (name == "vertex_indices" || name == "vertex_index")) {
      property.role = Role::kCorners;
    }
    RequireUsable(property, name);
    element.properties.push_back(property);
  }

  void RequireUsable(const Property& property, std::string_view name) const {
    if (property.role == Role::kNone) return;
    const bool is_corners = property.role == Role::kCorners;
    if (IsReal(property.type->type) == !is_corners) return;
    scanner_.Refuse((is_corners ? "face property " : "vertex property ") +
                    std::string(name) + "; expected " +
                    (is_corners ? "an integer type" : "float or double") +
                    ", found " + property.type->name + "; export it again");
  }

  void RequireCoordinates() const {
    int found[3] = {0, 0, 0};
    for (const Element& element : elements_) {
      for (const Property& p : element.properties) {
        if (p.role <= Role::kZ) ++found[static_cast<int>(p.role)];
      }
    }
    if (found[0] == 1 && found[1] == 1 && found[2] == 1) return;
    scanner_.Refuse(
        "PLY header; expected vertex properties x, y and z, each once, found " +
        std::to_string(found[0] + found[1] + found[2]) +
        " of them; export it again");
  }

  // Of one item; in text, every value is a digit and what ends it.
  std::size_t LeastBytes(const Element& element) const {
    std::size_t bytes = 0;
    for (const Property& p : element.properties) {
      bytes += is_text_ ? 2 : p.is_list ? p.count->bytes : p.type->bytes;
    }
    return bytes;
  }

  void ReadItem(const Element& element) {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    std::vector<int> polygon;
    for (const Property& p : element.properties) {
      if (!p.is_list) {
        const double value = Value(*p.type, element, p.role != Role::kNone);
        if (p.role <= Role::kZ) point[static_cast<int>(p.role)] = value;
        continue;
      }
      const double count = Value(*p.count, element, true);
      if (!IsWhole(count, std::numeric_limits<std::uint32_t>::max())) {
        Refuse(element, count);
      }
      const auto corners = static_cast<std::uint32_t>(count);
      scanner_.RequireRoom(corners, is_text_ ? 2 : p.type->bytes,
                           "values in a list of a " + element.name);
      const bool is_kept = p.role == Role::kCorners;
      polygon.reserve(is_kept ? corners : 0);
      for (std::uint32_t i = 0; i < corners; ++i) {
        const double index = Value(*p.type, element, is_kept);
        if (is_kept) polygon.push_back(Index(index));
      }
    }
    if (element.kind == Element::kVertex) soup_.points.push_back(point);
    if (element.kind == Element::kFace) {
      soup_.polygons.push_back(std::move(polygon));
    }
  }

  [[noreturn]] void Refuse(const Element& element, double count) const {
    scanner_.Refuse("a list of a " + element.name +
                    "; expected its number of values, found " +
                    std::to_string(count) + "; export it again");
  }

  // An index that is none becomes −1, which is out of range.
  static int Index(double value) {
    return IsWhole(value, std::numeric_limits<int>::max())
               ? static_cast<int>(value)
               : -1;
  }

  // All types but float have their values among the doubles.
  double Value(const TypeName& type, const Element& element, bool is_used) {
    if (is_text_) {
      const std::string_view word = TakeWord(&scanner_.rest());
      if (word.empty()) scanner_.RefuseContent();
      return is_used ? scanner_.Real(word, element.name) : 0.0;
    }
    switch (type.type) {
      case Type::kInt8:
        return scanner_.Binary<std::int8_t>(is_big_endian_);
      case Type::kUint8:
        return scanner_.Binary<std::uint8_t>(is_big_endian_);
      case Type::kInt16:
        return scanner_.Binary<std::int16_t>(is_big_endian_);
      case Type::kUint16:
        return scanner_.Binary<std::uint16_t>(is_big_endian_);
      case Type::kInt32:
        return scanner_.Binary<std::int32_t>(is_big_endian_);
      case Type::kUint32:
        return scanner_.Binary<std::uint32_t>(is_big_endian_);
      case Type::kFloat:
        return scanner_.Binary<float>(is_big_endian_);
      default:
        return scanner_.Binary<double>(is_big_endian_);
    }
  }

  MeshScanner scanner_;
  PolygonSoup soup_;
  std::vector<Element> elements_;
  bool is_text_ = true, is_big_endian_ = false;
};

}  // namespace

PolygonSoup ReadPly(std::string_view bytes, const std::string& file) {
  return PlyReader(bytes, file).Read();
}

}  // namespace phongpd::internal
