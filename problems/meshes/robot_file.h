// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace tinyxml2 {
class XMLDocument;
class XMLElement;
}  // namespace tinyxml2

namespace phongpd {

// Where something stands in the frame of something else: x ↦ R x + p, metres.
struct Place {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d position = Eigen::Vector3d::Zero();

  Place operator*(const Place& inner) const {
    return {rotation * inner.rotation, rotation * inner.position + position};
  }
};

// Adds a mesh, placed.
void AppendPlaced(const TriangleMesh& mesh, const Place& place,
                  TriangleMesh* all);

// For messages: the first 400 characters.
std::string Shortened(std::string names);

// A URDF or SDF file that is read: its links, and their collision shapes.
// Everything throws InputError, "FILE: what, expected, found".
class RobotFile {
 public:
  // Of its bytes.  Mesh files must lie below `root` if it is not empty; what is
  // to be known of them is appended to *warnings, which outlives this.
  RobotFile(std::string file, const std::string& bytes, std::string root,
            std::vector<std::string>* warnings);
  ~RobotFile();

  const std::string& file() const { return file_; }
  bool IsSdf() const { return is_sdf_; }
  const tinyxml2::XMLElement& robot() const;  // the root element

  // Links with shapes, in the order of the file; SDF has them in models, in
  // worlds or models again.
  const std::vector<const tinyxml2::XMLElement*>& links() const {
    return links_;
  }
  static std::string NameOf(const tinyxml2::XMLElement& element);

  // The collision shapes of a link as one mesh, in its frame.
  TriangleMesh ShapesOf(const tinyxml2::XMLElement& link);
  // Of all links so far.
  std::size_t shape_count() const { return shapes_; }
  // "; cylinders have ..." if there were any, for what is told of the mesh.
  std::string Roundness() const;

  // The origin of an element of URDF; angles about the fixed axes x, y, z.
  Place OriginOf(const tinyxml2::XMLElement& element) const;
  // `count` numbers out of a text.
  std::vector<double> Numbers(const std::string& text, const std::string& what,
                              std::size_t count) const;

  [[noreturn]] void Refuse(const std::string& what) const;

 private:
  void CollectLinks(const tinyxml2::XMLElement& parent);
  Place SdfPlace(const tinyxml2::XMLElement& collision) const;
  std::optional<std::string> Value(const tinyxml2::XMLElement& shape,
                                   const char* name) const;
  double Size(const tinyxml2::XMLElement& shape, const char* name) const;
  TriangleMesh Shape(const tinyxml2::XMLElement& shape);
  TriangleMesh PlainShape(const tinyxml2::XMLElement& shape);
  TriangleMesh MeshFile(const tinyxml2::XMLElement& shape);
  std::string PathOf(const std::string& name) const;

  std::string file_, root_;
  std::string link_;  // "#link" while its shapes are read
  std::vector<std::string>& warnings_;
  std::unique_ptr<tinyxml2::XMLDocument> document_;
  bool is_sdf_ = false, has_round_ = false;
  std::size_t shapes_ = 0;
  std::vector<const tinyxml2::XMLElement*> links_;
};

}  // namespace phongpd
