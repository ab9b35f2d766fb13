// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/meshes/robot_link.h"

#include <tinyxml2.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <optional>
#include <sstream>
#include <utility>

#include "core/mesh/counted.h"
#include "core/mesh/input_file.h"
#include "core/mesh/mesh_error.h"
#include "problems/meshes/any_mesh.h"
#include "problems/meshes/assimp_mesh.h"
#include "problems/output/nearest_name.h"
#include "problems/output/text.h"
#include "problems/shapes/shapes.h"

namespace phongpd {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using tinyxml2::XMLElement;

constexpr std::uintmax_t kMaxBytes = std::uintmax_t{1} << 26;
constexpr std::size_t kMaxShapes = 1000;  // of a link

struct Place {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Vector3d position = Vector3d::Zero();
};

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

// One file and the link that is asked for.
class LinkReader {
 public:
  LinkReader(const std::string& file, const std::string& link,
             const std::string& root, std::vector<std::string>* warnings)
      : file_(file), link_(link), root_(root), warnings_(*warnings) {}

  TriangleMesh Read() {
    RequireBelow(file_, root_);
    const std::string bytes =
        ReadInputFile(file_, "a URDF or SDF file", kMaxBytes);
    tinyxml2::XMLDocument document;
    if (document.Parse(bytes.data(), bytes.size()) != tinyxml2::XML_SUCCESS) {
      Refuse("expected XML, found an error: " +
             std::string(document.ErrorStr()));
    }
    const XMLElement* const root = document.RootElement();
    const std::string kind = root == nullptr ? "" : root->Name();
    if (kind != "robot" && kind != "sdf") {
      Refuse("expected a <robot> or <sdf>, found <" + kind.substr(0, 40) + ">");
    }
    is_sdf_ = kind == "sdf";
    CollectLinks(*root);
    const XMLElement& link = Find();
    link_ = link.Attribute("name") == nullptr ? "" : link.Attribute("name");
    TriangleMesh mesh = Shapes(link);
    warnings_.push_back(
        file_ + ": " + Counted(shapes_, "collision shape") + " of link '" +
        link_ + "' in its own frame, metres; no joint or link pose is applied" +
        Roundness());
    return mesh;
  }

 private:
  [[noreturn]] void Refuse(const std::string& what) const {
    throw InputError(file_ + (link_.empty() ? "" : "#" + link_) + ": " + what);
  }

  // Links with shapes; SDF has them in models, in worlds or models again.
  void CollectLinks(const XMLElement& parent) {
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

  static std::string NameOf(const XMLElement& link) {
    const char* const name = link.Attribute("name");
    return name == nullptr ? "" : name;
  }

  const XMLElement& Find() const {
    std::vector<std::string> names;
    const XMLElement* found = nullptr;
    int count = 0;
    for (const XMLElement* const link : links_) {
      names.push_back(NameOf(*link));
      if (!link_.empty() && names.back() != link_) continue;
      found = link;
      ++count;
    }
    if (count == 1) return *found;
    std::string all = Joined(names);
    if (all.size() > 400) all.replace(400, std::string::npos, " ...");
    if (names.empty()) Refuse("expected links with <collision>, found none");
    if (count > 1 && !link_.empty()) {
      Refuse("expected one link of this name, found " + std::to_string(count));
    }
    Refuse((link_.empty() ? "expected FILE#link, found no link's name; "
                          : "expected a link with <collision>, found none of "
                            "this name; ") +
           ("there are: " + all) +
           (link_.empty() ? "" : DidYouMean(link_, names)));
  }

  TriangleMesh Shapes(const XMLElement& link) {
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
      const Place place = is_sdf_ ? SdfPlace(*at) : UrdfPlace(*at);
      all = Joined(all, Translated(Rotated(Shape(*shape), place.rotation),
                                   place.position));
    }
    return all;
  }

  Place UrdfPlace(const XMLElement& collision) const {
    const XMLElement* const origin = collision.FirstChildElement("origin");
    if (origin == nullptr) return {};
    const auto point = [&](const char* name) {
      const char* const text = origin->Attribute(name);
      const std::vector<double> x = Numbers(text == nullptr ? "0 0 0" : text,
                                            std::string("origin ") + name, 3);
      return Vector3d(x[0], x[1], x[2]);
    };
    return PlaceOf(point("xyz"), point("rpy"));
  }

  Place SdfPlace(const XMLElement& collision) const {
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

  std::vector<double> Numbers(const std::string& text, const std::string& what,
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
  std::optional<std::string> Value(const XMLElement& shape,
                                   const char* name) const {
    const XMLElement* const child = shape.FirstChildElement(name);
    const char* const text =
        is_sdf_ ? (child == nullptr ? nullptr : child->GetText())
                : shape.Attribute(name);
    return text == nullptr ? std::nullopt : std::optional<std::string>(text);
  }

  double Size(const XMLElement& shape, const char* name) const {
    const std::string what = std::string(shape.Name()) + " " + name;
    const std::optional<std::string> text = Value(shape, name);
    if (!text) Refuse(what + ": expected a length, found none");
    const double size = Numbers(*text, what, 1)[0];
    if (!(size > 0.0)) {
      Refuse(what + ": expected a length > 0, found " + *text);
    }
    return size;
  }

  TriangleMesh Shape(const XMLElement& shape) {
    const std::string kind = shape.Name();
    if (kind == "mesh") return MeshFile(shape);
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

  std::string Roundness() const {
    if (!has_round_) return "";
    return "; cylinders have " + std::to_string(kCylinderSides) +
           " sides and spheres 1280 triangles, within the true shape";
  }

  TriangleMesh MeshFile(const XMLElement& shape) {
    const std::optional<std::string> name =
        Value(shape, is_sdf_ ? "uri" : "filename");
    if (!name || name->empty()) Refuse("mesh: expected a file, found none");
    const std::string path = PathOf(*name);
    RequireBelow(path, root_);
    TriangleMesh mesh;
    std::string extension = fs::path(path).extension().string();
    for (char& c : extension) {
      c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    if (extension == ".dae") {
      ImportedMesh imported = ReadByAssimp(path);
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
  std::string PathOf(const std::string& name) const {
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

  std::string file_, link_, root_;
  std::vector<std::string>& warnings_;
  bool is_sdf_ = false, has_round_ = false;
  std::size_t shapes_ = 0;
  std::vector<const XMLElement*> links_;
};

}  // namespace

TriangleMesh ReadRobotLink(const std::string& path, const std::string& root,
                           std::vector<std::string>* warnings) {
  const std::size_t hash = path.rfind('#');
  const std::string file = path.substr(0, hash);
  const std::string link =
      hash == std::string::npos ? "" : path.substr(hash + 1);
  return LinkReader(file, link, root, warnings).Read();
}

}  // namespace phongpd
