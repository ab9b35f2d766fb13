// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/meshes/robot_file.h"

#include <tinyxml2.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <sstream>
#include <utility>

#include "core/mesh/counted.h"
#include "core/mesh/mesh_error.h"
#include "problems/meshes/any_mesh.h"
#include "problems/meshes/assimp_mesh.h"
#include "problems/meshes/robot_link.h"
#include "problems/output/text.h"
#include "problems/shapes/shapes.h"

namespace phongpd {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using tinyxml2::XMLElement;

constexpr std::size_t kMaxShapes = 1000;  // of what is read

// Angles about the fixed axes x, y, z, as both formats have them.
Place PlaceOf(const Vector3d& xyz, const Vector3d& rpy) {
  Place place;
  place.position = xyz;
  place.rotation = (Eigen::AngleAxisd(rpy[2], Vector3d::UnitZ()) *
                    Eigen::AngleAxisd(rpy[1], Vector3d::UnitY()) *
                    Eigen::AngleAxisd(rpy[0], Vector3d::UnitX()))
                       .toRotationMatrix();
  return place;
}

}  // namespace

RobotFile::RobotFile(std::string file, const std::string& bytes,
                     std::string root, std::vector<std::string>* warnings)
    : file_(std::move(file)),
      root_(std::move(root)),
      warnings_(*warnings),
      document_(std::make_unique<tinyxml2::XMLDocument>()) {
  if (document_->Parse(bytes.data(), bytes.size()) != tinyxml2::XML_SUCCESS) {
    Refuse("expected XML, found an error: " +
           std::string(document_->ErrorStr()));
  }
  const XMLElement* const top = document_->RootElement();
  const std::string kind = top == nullptr ? "" : top->Name();
  if (kind != "robot" && kind != "sdf") {
    Refuse("expected a <robot> or <sdf>, found <" + kind.substr(0, 40) + ">");
  }
  is_sdf_ = kind == "sdf";
  CollectLinks(*top);
}

RobotFile::~RobotFile() = default;

const XMLElement& RobotFile::robot() const { return *document_->RootElement(); }

void RobotFile::Refuse(const std::string& what) const {
  throw InputError(file_ + link_ + ": " + what);
}

void RobotFile::CollectLinks(const XMLElement& parent) {
  for (const XMLElement* at = parent.FirstChildElement(); at != nullptr;
       at = at->NextSiblingElement()) {
    const std::string name = at->Name();
    if (name == "link" && at->FirstChildElement("collision") != nullptr) {
      links_.push_back(at);
    } else if (is_sdf_ && (name == "model" || name == "world")) {
      CollectLinks(*at);
    }
  }
}

std::string Shortened(std::string names) {
  if (names.size() > 400) names.replace(400, std::string::npos, " ...");
  return names;
}

void AppendPlaced(const TriangleMesh& mesh, const Place& place,
                  TriangleMesh* all) {
  const int offset = static_cast<int>(all->vertices.size());
  for (const Vector3d& v : mesh.vertices) {
    all->vertices.push_back(place.rotation * v + place.position);
  }
  for (const auto& [i, j, k] : mesh.triangles) {
    all->triangles.push_back({i + offset, j + offset, k + offset});
  }
}

std::string RobotFile::NameOf(const XMLElement& element) {
  const char* const name = element.Attribute("name");
  return name == nullptr ? "" : name;
}

TriangleMesh RobotFile::ShapesOf(const XMLElement& link) {
  link_ = "#" + NameOf(link);
  TriangleMesh all;
  for (const XMLElement* at = link.FirstChildElement("collision");
       at != nullptr; at = at->NextSiblingElement("collision")) {
    if (++shapes_ > kMaxShapes) {
      Refuse("expected at most " + std::to_string(kMaxShapes) +
             " collision shapes, found more");
    }
    const XMLElement* const geometry = at->FirstChildElement("geometry");
    const XMLElement* const shape =
        geometry == nullptr ? nullptr : geometry->FirstChildElement();
    if (shape == nullptr) Refuse("expected a <geometry>, found none");
    const Place place = is_sdf_ ? SdfPlace(*at) : OriginOf(*at);
    AppendPlaced(Shape(*shape), place, &all);
  }
  link_.clear();
  return all;
}

Place RobotFile::OriginOf(const XMLElement& element) const {
  const XMLElement* const origin = element.FirstChildElement("origin");
  if (origin == nullptr) return {};
  const auto point = [&](const char* name) {
    const char* const text = origin->Attribute(name);
    const std::vector<double> x = Numbers(text == nullptr ? "0 0 0" : text,
                                          std::string("origin ") + name, 3);
    return Vector3d(x[0], x[1], x[2]);
  };
  return PlaceOf(point("xyz"), point("rpy"));
}

Place RobotFile::SdfPlace(const XMLElement& collision) const {
  const XMLElement* const pose = collision.FirstChildElement("pose");
  if (pose == nullptr || pose->GetText() == nullptr) return {};
  for (const char* other : {"relative_to", "rotation_format", "degrees"}) {
    if (pose->Attribute(other) != nullptr &&
        std::string(pose->Attribute(other)) != "" &&
        std::string(pose->Attribute(other)) != "false") {
      Refuse(
          "expected a <pose> x y z roll pitch yaw in the link's frame, "
          "found the attribute " +
          std::string(other));
    }
  }
  const std::vector<double> x = Numbers(pose->GetText(), "pose", 6);
  return PlaceOf({x[0], x[1], x[2]}, {x[3], x[4], x[5]});
}

std::vector<double> RobotFile::Numbers(const std::string& text,
                                       const std::string& what,
                                       std::size_t count) const {
  std::vector<double> numbers;
  std::istringstream words(text);
  for (std::string word; words >> word && numbers.size() <= count;) {
    numbers.push_back(ParseDouble(word, file_ + ": " + what));
  }
  if (numbers.size() != count) {
    Refuse(what + ": expected " + Counted(count, "number") + ", found '" +
           text.substr(0, 80) + "'");
  }
  return numbers;
}

// An attribute of URDF is an element of SDF.
std::optional<std::string> RobotFile::Value(const XMLElement& shape,
                                            const char* name) const {
  const XMLElement* const child = shape.FirstChildElement(name);
  const char* const text = is_sdf_
                               ? (child == nullptr ? nullptr : child->GetText())
                               : shape.Attribute(name);
  return text == nullptr ? std::nullopt : std::optional<std::string>(text);
}

double RobotFile::Size(const XMLElement& shape, const char* name) const {
  const std::string what = std::string(shape.Name()) + " " + name;
  const std::optional<std::string> text = Value(shape, name);
  if (!text) Refuse(what + ": expected a length, found none");
  const double size = Numbers(*text, what, 1)[0];
  if (!(size > 0.0)) {
    Refuse(what + ": expected a length > 0, found " + *text);
  }
  return size;
}

TriangleMesh RobotFile::Shape(const XMLElement& shape) {
  if (std::string(shape.Name()) == "mesh") return MeshFile(shape);
  try {
    return PlainShape(shape);
  } catch (const InputError& error) {
    // Of a size that shapes cannot have: they do not know the file.
    if (std::string(error.what()).rfind(file_, 0) == 0) throw;
    Refuse(error.what());
  }
}

TriangleMesh RobotFile::PlainShape(const XMLElement& shape) {
  const std::string kind = shape.Name();
  if (kind == "box") {
    const std::optional<std::string> text = Value(shape, "size");
    if (!text) Refuse("box size: expected three lengths, found none");
    const std::vector<double> x = Numbers(*text, "box size", 3);
    const Vector3d half = 0.5 * Vector3d(x[0], x[1], x[2]);
    if (!(half.minCoeff() > 0.0)) {
      Refuse("box size: expected lengths > 0, found " + *text);
    }
    return MakeBox(-half, half);
  }
  if (kind == "sphere") {
    has_round_ = true;
    return MakeIcoBall(Size(shape, "radius"), kSphereLevels);
  }
  if (kind == "cylinder") {
    has_round_ = true;
    return MakePrism(Size(shape, "radius"), Size(shape, "length"),
                     kCylinderSides);
  }
  Refuse("expected a mesh, box, cylinder or sphere, found <" +
         kind.substr(0, 40) + ">");
}

std::string RobotFile::Roundness() const {
  if (!has_round_) return "";
  return "; cylinders have " + std::to_string(kCylinderSides) +
         " sides and spheres 1280 triangles, within the true shape";
}

TriangleMesh RobotFile::MeshFile(const XMLElement& shape) {
  const std::optional<std::string> name =
      Value(shape, is_sdf_ ? "uri" : "filename");
  if (!name || name->empty()) Refuse("mesh: expected a file, found none");
  const std::string path = PathOf(*name);
  TriangleMesh mesh;
  // A robot in a robot would have no end.
  std::string extension =
      fs::path(path.substr(0, FilePartOf(path))).extension().string();
  for (char& c : extension) {
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  if (extension == ".dae") {
    ImportedMesh imported = ReadByAssimp(path, root_);
    mesh = Scaled(std::move(imported.mesh), imported.metres);
    warnings_.push_back(path + ": " + imported.note +
                        "; then by its unit "
                        "to metres");
  } else if (extension == ".urdf" || extension == ".sdf") {
    Refuse("expected a mesh file, found " + *name);
  } else {
    mesh = ReadAnyMesh(path, &warnings_, root_);
  }
  if (const std::optional<std::string> scale = Value(shape, "scale")) {
    const std::vector<double> x = Numbers(*scale, "mesh scale", 3);
    for (Vector3d& v : mesh.vertices) {
      v = v.cwiseProduct(Vector3d(x[0], x[1], x[2]));
    }
    if (x[0] * x[1] * x[2] < 0.0) mesh = Reversed(std::move(mesh));
  }
  return mesh;
}

// Where a mesh lies: beside the file, or, for package://NAME/..., in the
// next folder NAME on the way up from it.
std::string RobotFile::PathOf(const std::string& name) const {
  const fs::path here = fs::absolute(fs::path(file_)).parent_path();
  const std::size_t scheme = name.find("://");
  if (scheme == std::string::npos) return (here / name).string();
  const std::string kind = name.substr(0, scheme);
  const fs::path rest = name.substr(scheme + 3);
  if (kind == "file") return rest.string();
  if (kind == "package" || kind == "model") {
    std::error_code error;
    for (fs::path folder = here;; folder = folder.parent_path()) {
      if (folder.filename() == *rest.begin()) {
        const fs::path found = folder.parent_path() / rest;
        if (fs::exists(found, error)) return found.string();
      }
      if (fs::exists(folder / rest, error)) return (folder / rest).string();
      if (folder == folder.parent_path()) break;
    }
    Refuse("expected the mesh " + name +
           " in a folder on the way up from "
           "the file, found none; name it relative to the file");
  }
  Refuse("expected a file, package:// or model://, found " +
         name.substr(0, 80));
}

}  // namespace phongpd
