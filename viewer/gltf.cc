// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/gltf.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <type_traits>
#include <vector>

#include "core/mesh/mesh_error.h"
#include "problems/output/json_text.h"
#include "problems/output/text.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using Json = nlohmann::ordered_json;

// Constants of the specification.
constexpr int kFloat = 5126, kUnsignedInt = 5125;
constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963;
constexpr int kLineStrip = 3, kTriangles = 4;
constexpr std::uint32_t kMagic = 0x46546C67, kVersion = 2;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;

enum Material {
  kObstacleMaterial,
  kMeshMaterial,
  kContactMaterial,
  kRobotMaterial,
  kMarkMaterial,
  kFirstPath
};

// Colours that are told apart without red and green (Okabe and Ito), linear.
constexpr double kPathColors[][3] = {
    {0.000, 0.168, 0.445}, {0.665, 0.112, 0.000}, {0.000, 0.342, 0.171},
    {0.604, 0.191, 0.386}, {0.791, 0.347, 0.000}, {0.093, 0.456, 0.815}};
constexpr std::size_t kPathMaterials = std::size(kPathColors);

Json MaterialJson(const char* name, const std::vector<double>& color) {
  Json json = {{"name", name},
               {"pbrMetallicRoughness",
                {{"baseColorFactor", color},
                 {"metallicFactor", 0.0},
                 {"roughnessFactor", 0.8}}},
               {"doubleSided", true}};
  if (color[3] < 1.0) json["alphaMode"] = "BLEND";
  return json;
}

template <typename Number>
void Append(std::string* bytes, Number number) {
  char raw[sizeof number];
  std::memcpy(raw, &number, sizeof number);
  bytes->append(raw, sizeof number);
}

class GlbWriter {
 public:
  explicit GlbWriter(const View& view)
      : view_(view), center_(ViewBounds(view).Center()) {
    const BoundingBox box = ViewBounds(view);
    const double largest =
        std::max(box.min.cwiseAbs().maxCoeff(), box.max.cwiseAbs().maxCoeff());
    if (largest > 1e30 || box.Diagonal() < 1e-30) {
      throw InputError(
          "glTF: expected coordinates up to 1e30 and a size from 1e-30, which "
          "single precision holds, found " +
          FormatDouble(largest) + " and " + FormatDouble(box.Diagonal()));
    }
    gltf_ = {{"asset", {{"version", "2.0"}, {"generator", "phongpd"}}},
             {"scene", 0},
             {"scenes", {{{"name", view.title}, {"nodes", {0}}}}},
             {"nodes",
              {{{"name", "z up"},
                {"rotation", {-std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5)}},
                {"children", {1}}},
               {{"name", "center"},
                {"translation", {center_.x(), center_.y(), center_.z()}},
                {"children", Json::array()}}}},
             {"materials",
              {MaterialJson("obstacle", {0.42, 0.45, 0.5, 1.0}),
               MaterialJson("mesh", {0.55, 0.52, 0.46, 1.0}),
               MaterialJson("contact space", {0.05, 0.28, 0.63, 0.25}),
               MaterialJson("robot", {0.0, 0.168, 0.445, 1.0}),
               MaterialJson("mark", {0.02, 0.02, 0.03, 1.0})}},
             {"meshes", Json::array()},
             {"accessors", Json::array()},
             {"bufferViews", Json::array()}};
    for (std::size_t i = 0; i < kPathMaterials; ++i) {
      const double* const c = kPathColors[i];
      gltf_["materials"].push_back(MaterialJson(
          ("path " + std::to_string(i + 1)).c_str(), {c[0], c[1], c[2], 1.0}));
    }
  }

  std::string Write() {
    for (const ViewMesh& mesh : view_.meshes) {
      if (mesh.mesh.triangles.empty()) continue;
      const Material material =
          mesh.role == ViewRole::kObstacle       ? kObstacleMaterial
          : mesh.role == ViewRole::kContactSpace ? kContactMaterial
                                                 : kMeshMaterial;
      AddNode(mesh.name, AddMesh(mesh.name, mesh.mesh, center_, material));
    }
    for (std::size_t i = 0; i < view_.paths.size(); ++i) {
      const NamedPath& path = view_.paths[i];
      if (path.points.size() < 2) continue;
      AddNode(path.name,
              AddLine(path.name, path.points,
                      kFirstPath + static_cast<int>(i % kPathMaterials)));
    }
    if (view_.motion.positions.size() > 1) {
      AddNode("motion",
              AddLine("motion", view_.motion.positions, kMarkMaterial));
    }
    AddRobot();
    return Packed();
  }

 private:
  // Components of a vector or indices: appends them, returns the accessor.
  template <typename Number>
  int AddAccessor(const std::vector<Number>& numbers, std::size_t components,
                  const char* type, int target) {
    const std::size_t offset = bytes_.size();
    for (const Number number : numbers) Append(&bytes_, number);
    Json buffer = {{"buffer", 0},
                   {"byteOffset", offset},
                   {"byteLength", bytes_.size() - offset}};
    if (target != 0) buffer["target"] = target;
    gltf_["bufferViews"].push_back(buffer);
    std::vector<Number> least(components, std::numeric_limits<Number>::max());
    std::vector<Number> most(components, std::numeric_limits<Number>::lowest());
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      Number& low = least[i % components];
      Number& high = most[i % components];
      low = std::min(low, numbers[i]);
      high = std::max(high, numbers[i]);
    }
    gltf_["accessors"].push_back(
        {{"bufferView", gltf_["bufferViews"].size() - 1},
         {"componentType",
          std::is_same_v<Number, float> ? kFloat : kUnsignedInt},
         {"count", numbers.size() / components},
         {"type", type},
         {"min", least},
         {"max", most}});
    return static_cast<int>(gltf_["accessors"].size()) - 1;
  }

  int AddPoints(const std::vector<Vector3d>& points, const Vector3d& origin,
                int target) {
    std::vector<float> numbers;
    for (const Vector3d& p : points) {
      for (int k = 0; k < 3; ++k) {
        numbers.push_back(static_cast<float>(p[k] - origin[k]));
      }
    }
    return AddAccessor(numbers, 3, "VEC3", target);
  }

  int AddPrimitive(const std::string& name, const Json& primitive) {
    gltf_["meshes"].push_back(
        {{"name", name}, {"primitives", Json::array({primitive})}});
    return static_cast<int>(gltf_["meshes"].size()) - 1;
  }

  // Without normals, which asks viewers for flat ones.
  int AddMesh(const std::string& name, const TriangleMesh& mesh,
              const Vector3d& origin, Material material) {
    std::vector<std::uint32_t> indices;
    for (const Triangle& t : mesh.triangles) {
      for (const int v : t) indices.push_back(static_cast<std::uint32_t>(v));
    }
    const int points = AddPoints(mesh.vertices, origin, kArrayBuffer);
    return AddPrimitive(
        name,
        {{"attributes", {{"POSITION", points}}},
         {"indices", AddAccessor(indices, 1, "SCALAR", kElementArrayBuffer)},
         {"material", static_cast<int>(material)},
         {"mode", kTriangles}});
  }

  int AddLine(const std::string& name, const std::vector<Vector3d>& points,
              int material) {
    return AddPrimitive(
        name, {{"attributes",
                {{"POSITION", AddPoints(points, center_, kArrayBuffer)}}},
               {"material", material},
               {"mode", kLineStrip}});
  }

  int AddNode(const std::string& name, int mesh) {
    gltf_["nodes"].push_back({{"name", name}, {"mesh", mesh}});
    const int node = static_cast<int>(gltf_["nodes"].size()) - 1;
    gltf_["nodes"][1]["children"].push_back(node);
    return node;
  }

  // Without a mesh of it, a small octahedron shows where it is.
  TriangleMesh RobotMesh() const {
    if (!view_.robot.triangles.empty()) return view_.robot;
    TriangleMesh mesh;
    const double r = 0.01 * ViewBounds(view_).Diagonal();
    for (int k = 0; k < 6; ++k) {
      Vector3d v = Vector3d::Zero();
      v[k / 2] = k % 2 == 0 ? r : -r;
      mesh.vertices.push_back(v);
    }
    mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                      {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    return mesh;
  }

  void AddRobot() {
    const std::vector<Vector3d> way = FirstWay(view_);
    if (view_.robot.triangles.empty() && way.empty()) return;
    const int node = AddNode(
        "robot",
        AddMesh("robot", RobotMesh(), Vector3d::Zero(), kRobotMaterial));
    const Vector3d rest =
        !way.empty() ? way.front() : view_.start.value_or(Vector3d::Zero());
    const Vector3d at = rest - center_;
    gltf_["nodes"][static_cast<std::size_t>(node)]["translation"] = {
        at.x(), at.y(), at.z()};
    for (const NamedPath& path : view_.paths) {
      if (path.points.size() < 2) continue;
      Animate(path.name, node, path.points,
              path.pace.duration > 0.0
                  ? EvenTimes(path.points.size(), path.pace.duration)
                  : LengthTimes(path.points),
              {});
    }
    const std::vector<Vector3d>& frames = view_.motion.positions;
    if (frames.size() > 1) {
      Animate("motion", node, frames, EvenTimes(frames.size()), {});
    }
    std::vector<Vector3d> poses;
    for (const ViewAnswer& answer : view_.answers) {
      poses.push_back(answer.position);
    }
    if (poses.size() == 1) {
      const Eigen::Quaterniond& q = view_.answers[0].orientation;
      gltf_["nodes"][static_cast<std::size_t>(node)]["rotation"] = {
          q.x(), q.y(), q.z(), q.w()};
    } else if (poses.size() > 1) {
      Animate("poses", node, poses, EvenTimes(poses.size()), view_.answers);
    }
  }

  static std::vector<float> EvenTimes(std::size_t count,
                                      double seconds = kGltfSeconds) {
    std::vector<float> times;
    for (std::size_t i = 0; i < count; ++i) {
      times.push_back(static_cast<float>(seconds * static_cast<double>(i) /
                                         static_cast<double>(count - 1)));
    }
    return times;
  }

  // glTF asks for times that increase strictly, so none is less than the next
  // float.
  static std::vector<float> LengthTimes(const std::vector<Vector3d>& points) {
    std::vector<double> travelled = {0.0};
    for (std::size_t i = 1; i < points.size(); ++i) {
      travelled.push_back(travelled.back() +
                          (points[i] - points[i - 1]).norm());
    }
    if (!(travelled.back() > 0.0)) return EvenTimes(points.size());
    std::vector<float> times = {0.0F};
    for (std::size_t i = 1; i < points.size(); ++i) {
      times.push_back(std::max(
          static_cast<float>(kGltfSeconds * travelled[i] / travelled.back()),
          std::nextafter(times.back(), std::numeric_limits<float>::max())));
    }
    return times;
  }

  void Animate(const std::string& name, int node,
               const std::vector<Vector3d>& points,
               const std::vector<float>& times,
               const std::vector<ViewAnswer>& turns) {
    const int input = AddAccessor(times, 1, "SCALAR", 0);
    const char* const between = turns.empty() ? "LINEAR" : "STEP";
    Json animation = {{"name", name},
                      {"channels", Json::array()},
                      {"samplers", Json::array()}};
    const auto add = [&](const char* what, int output) {
      animation["channels"].push_back(
          {{"sampler", animation["samplers"].size()},
           {"target", {{"node", node}, {"path", what}}}});
      animation["samplers"].push_back(
          {{"input", input}, {"interpolation", between}, {"output", output}});
    };
    add("translation", AddPoints(points, center_, 0));
    if (!turns.empty()) {
      std::vector<float> numbers;
      for (const ViewAnswer& answer : turns) {
        const Eigen::Quaterniond& q = answer.orientation;
        for (const double x : {q.x(), q.y(), q.z(), q.w()}) {
          numbers.push_back(static_cast<float>(x));
        }
      }
      add("rotation", AddAccessor(numbers, 4, "VEC4", 0));
    }
    gltf_["animations"].push_back(animation);
  }

  static void Pad(std::string* bytes, char with) {
    while (bytes->size() % 4 != 0) *bytes += with;
  }

  std::string Packed() {
    // The specification allows no empty arrays.
    for (const char* const key : {"meshes", "accessors", "bufferViews"}) {
      if (gltf_[key].empty()) gltf_.erase(key);
    }
    Json& children = gltf_["nodes"][1]["children"];
    if (children.empty()) gltf_["nodes"][1].erase("children");
    Pad(&bytes_, '\0');
    if (!bytes_.empty()) {
      gltf_["buffers"] = {{{"byteLength", bytes_.size()}}};
    }
    std::string json = JsonText(gltf_);
    Pad(&json, ' ');
    std::string glb;
    const auto number = [&glb](std::uint64_t value) {
      if (value > std::numeric_limits<std::uint32_t>::max()) {
        throw InputError("glTF: expected at most 4 GiB, found " +
                         std::to_string(value) + " bytes");
      }
      Append(&glb, static_cast<std::uint32_t>(value));
    };
    const std::size_t binary = bytes_.empty() ? 0 : 8 + bytes_.size();
    number(kMagic);
    number(kVersion);
    number(12 + 8 + json.size() + binary);
    number(json.size());
    number(kJsonChunk);
    glb += json;
    if (binary > 0) {
      number(bytes_.size());
      number(kBinaryChunk);
      glb += bytes_;
    }
    return glb;
  }

  const View& view_;
  const Vector3d center_;
  Json gltf_;
  std::string bytes_;
};

}  // namespace

std::string ViewGlb(const View& view) { return GlbWriter(view).Write(); }

}  // namespace phongpd
