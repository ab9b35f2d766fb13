// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/scenes/scene_shapes.h"

#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/nearest_name.h"
#include "core/number_text.h"
#include "problems/scenes/json_schema.h"
#include "problems/shapes/shapes.h"

namespace phongpd {
namespace {

using Json = nlohmann::ordered_json;

// The parameters of one shape object, read by name.
class Parameters {
 public:
  Parameters(const Json& shape, const std::string& where)
      : shape_(shape), where_(where) {}

  double Length(const char* key) const {
    const Json& value = shape_[key];
    if (!value.is_number()) Fail(key, "expected a number", value);
    return value.get<double>();
  }

  int Count(const char* key) const {
    const Json& value = shape_[key];
    const double number = value.is_number() ? value.get<double>() : -1.0;
    if (number < 0.0 || number > std::numeric_limits<int>::max() ||
        number != std::floor(number)) {
      Fail(key, "expected a whole number", value);
    }
    return static_cast<int>(number);
  }

  Eigen::Vector3d Vector(const char* key) const {
    const Json& value = shape_[key];
    if (!value.is_array() || value.size() != 3 || !value[0].is_number() ||
        !value[1].is_number() || !value[2].is_number()) {
      Fail(key, "expected three numbers", value);
    }
    return {value[0].get<double>(), value[1].get<double>(),
            value[2].get<double>()};
  }

  std::vector<Eigen::Vector3d> Points(const char* key) const {
    const Json& value = shape_[key];
    std::vector<Eigen::Vector3d> points;
    for (const Json& item : value) {
      if (!value.is_array() || !item.is_array() || item.size() != 3 ||
          !item[0].is_number() || !item[1].is_number() ||
          !item[2].is_number()) {
        break;
      }
      points.emplace_back(item[0].get<double>(), item[1].get<double>(),
                          item[2].get<double>());
    }
    if (points.empty() || points.size() != value.size()) {
      Fail(key, "expected an array of points, three numbers each", value);
    }
    return points;
  }

  // Three each, of so many vertices.
  std::vector<Triangle> Corners(const char* key, std::size_t vertices) const {
    std::vector<Triangle> triangles;
    for (const Eigen::Vector3d& numbers : Points(key)) {
      Triangle triangle;
      for (std::size_t k = 0; k < 3; ++k) {
        const double number = numbers[static_cast<Eigen::Index>(k)];
        if (!(number >= 0.0 && number < static_cast<double>(vertices)) ||
            number != std::floor(number)) {
          Fail(key, "expected numbers of vertices, from 0 on", shape_[key]);
        }
        triangle[k] = static_cast<int>(number);
      }
      triangles.push_back(triangle);
    }
    return triangles;
  }

  std::vector<double> Numbers(const char* key) const {
    const Json& value = shape_[key];
    std::vector<double> numbers;
    for (const Json& item : value) {
      if (!value.is_array() || !item.is_number()) break;
      numbers.push_back(item.get<double>());
    }
    if (numbers.empty() || numbers.size() != value.size()) {
      Fail(key, "expected an array of numbers", value);
    }
    return numbers;
  }

  TriangleMesh Shape(const char* key) const {
    return MakeShape(shape_[key], where_ + "/" + key);
  }

  std::vector<std::vector<std::string>> Layers(const char* key) const {
    try {
      return shape_[key].get<std::vector<std::vector<std::string>>>();
    } catch (const Json::exception&) {
      Fail(key, "expected an array of layers, each an array of texts",
           shape_[key]);
    }
  }

  // Of the kind that a parameter of T is written as.
  template <typename T>
  T Get(const char* key) const {
    if constexpr (std::is_same_v<T, double>) {
      return Length(key);
    } else if constexpr (std::is_integral_v<T>) {
      return static_cast<T>(Count(key));
    } else if constexpr (std::is_same_v<T, Eigen::Vector3d>) {
      return Vector(key);
    } else if constexpr (std::is_same_v<T, std::vector<double>>) {
      return Numbers(key);
    } else if constexpr (std::is_same_v<T, TriangleMesh>) {
      return Shape(key);
    } else {
      return Layers(key);
    }
  }

  [[noreturn]] void Fail(const char* key, const char* expected,
                         const Json& found) const {
    throw InputError(where_ + "/" + key + ": " + expected + ", found " +
                     Shortened(found));
  }

  const Json& operator[](const char* key) const { return shape_[key]; }

 private:
  const Json& shape_;
  const std::string& where_;
};

TriangleMesh MakeBall(const Parameters& p) {
  const int triangles = p.Count("triangles");
  int levels = 0;
  long long size = 20;
  while (size < triangles) {
    size *= 4;
    ++levels;
  }
  if (size != triangles) {
    p.Fail("triangles", "expected 20, 80, 320, 1280, ... (20·4^k)",
           p["triangles"]);
  }
  return MakeIcoBall(p.Length("radius"), levels);
}

struct ShapeType {
  const char* name;
  std::vector<const char*> keys;
  std::function<TriangleMesh(const Parameters&)> make;
};

template <typename... Values, std::size_t... Index>
TriangleMesh Call(TriangleMesh (*make)(Values...),
                  const std::vector<const char*>& keys, const Parameters& p,
                  std::index_sequence<Index...>) {
  // Read from left to right: the first that is wrong is told.
  std::tuple<std::decay_t<Values>...> values{
      p.Get<std::decay_t<Values>>(keys[Index])...};
  return std::apply(make, std::move(values));
}

// Its keys are the parameters of `make`, in their order.
template <typename... Values>
ShapeType Direct(const char* name, TriangleMesh (*make)(Values...),
                 const std::vector<const char*>& keys) {
  return {name, keys, [make, keys](const Parameters& p) {
            return Call(make, keys, p, std::index_sequence_for<Values...>());
          }};
}

TriangleMesh MakeCentredBox(const Parameters& p) {
  const Eigen::Vector3d half = 0.5 * p.Vector("size");
  return MakeBox(-half, half);
}

TriangleMesh MakeUsualWrench(const Parameters& p) {
  return MakeWrench(p.Length("scale"));
}

TriangleMesh MakeUprightTube(const Parameters& p) {
  return MakeTube(p.Points("path"), p.Length("radius"), p.Count("sides"));
}

TriangleMesh MakeOfTriangles(const Parameters& p) {
  TriangleMesh mesh;
  mesh.vertices = p.Points("vertices");
  mesh.triangles = p.Corners("triangles", mesh.vertices.size());
  return mesh;
}

const std::vector<ShapeType>& ShapeTypes() {
  static const std::vector<ShapeType> types = {
      {"ball", {"radius", "triangles"}, MakeBall},
      Direct("uv_ball", MakeUvBall, {"radius", "meridians", "parallels"}),
      {"box", {"size"}, MakeCentredBox},
      Direct("box_shell", MakeBoxShell, {"min", "max", "thickness"}),
      Direct("cells", MakeCells, {"x", "y", "z", "layers"}),
      Direct("cone", MakeCone, {"radius", "height", "sides"}),
      Direct("axes", MakeAxes, {"half_length", "half_width"}),
      {"wrench", {"scale"}, MakeUsualWrench},
      Direct("torus", MakeTorus,
             {"major_radius", "minor_radius", "around", "across"}),
      Direct("l", MakeL, {"size", "width", "height"}),
      Direct("u", MakeU, {"size", "wall", "height"}),
      Direct("plate_hole", MakePlateWithHole, {"side", "thickness", "hole"}),
      Direct("plate_round_hole", MakePlateWithRoundHole,
             {"side", "thickness", "radius", "sides"}),
      Direct("prism", MakePrism, {"radius", "height", "sides"}),
      Direct("vessel", MakeVessel, {"outer", "inner", "window"}),
      Direct("star", MakeStar, {"inner_radius", "outer_radius"}),
      Direct("knot", MakeKnot, {"size", "tube", "around", "across"}),
      {"tube", {"path", "radius", "sides"}, MakeUprightTube},
      {"triangles", {"vertices", "triangles"}, MakeOfTriangles},
      Direct("scan", MakeScan, {"of", "edge", "noise", "seed"}),
  };
  return types;
}

const ShapeType& FindType(const Json& shape, const std::string& where) {
  if (!shape.is_object() || !shape.contains("type") ||
      !shape["type"].is_string()) {
    throw InputError(where + ": expected an object with a \"type\", found " +
                     Shortened(shape));
  }
  std::vector<std::string> known;
  for (const ShapeType& type : ShapeTypes()) {
    if (shape["type"] == type.name) return type;
    known.emplace_back(type.name);
  }
  throw InputError(where + "/type: expected one of " + Joined(known) +
                   ", found " + Shortened(shape["type"]) +
                   DidYouMean(shape["type"].get<std::string>(), known));
}

}  // namespace

TriangleMesh MakeShape(const Json& shape, const std::string& where) {
  const ShapeType& type = FindType(shape, where);
  for (const auto& [key, value] : shape.items()) {
    bool known = key == "type";
    for (const char* name : type.keys) known = known || key == name;
    if (!known) {
      throw InputError(where + ": a " + type.name + " has no parameter " +
                       Shortened(Json(key)) +
                       DidYouMean(key, {type.keys.begin(), type.keys.end()}));
    }
  }
  for (const char* key : type.keys) {
    if (!shape.contains(key)) {
      throw InputError(where + ": a " + type.name + " needs \"" + key +
                       "\", found " + Shortened(shape));
    }
  }
  const Parameters parameters(shape, where);
  try {
    return type.make(parameters);
  } catch (const InputError& error) {
    const std::string message = error.what();
    if (message.rfind(where, 0) == 0) throw;
    throw InputError(where + ": " + message);
  }
}

}  // namespace phongpd
