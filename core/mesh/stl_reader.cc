// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cstdint>
#include <map>

#include "core/mesh/finite.h"
#include "core/mesh/mesh_scanner.h"
#include "core/mesh/polygon_soup.h"

namespace phongpd::internal {
namespace {

constexpr std::size_t kHeaderBytes = 80;
constexpr std::size_t kTriangleBytes = 50;

// Joins vertices with equal coordinates.
class StlSoup {
 public:
  void AddCorner(const Eigen::Vector3d& p) {
    int index = static_cast<int>(soup_.points.size());
    // NaN is equal to nothing, and has no place in an order.
    if (IsFinite(p)) {
      index =
          index_.emplace(std::array{p.x(), p.y(), p.z()}, index).first->second;
    }
    if (index == static_cast<int>(soup_.points.size())) {
      soup_.points.push_back(p);
    }
    corners_.push_back(index);
  }

  // False unless three corners have been added.
  bool EndTriangle() {
    const bool is_triangle = corners_.size() == 3;
    soup_.polygons.push_back(std::move(corners_));
    corners_.clear();
    return is_triangle;
  }

  PolygonSoup Take() { return std::move(soup_); }
  std::size_t triangles() const { return soup_.polygons.size(); }

 private:
  PolygonSoup soup_;
  std::map<std::array<double, 3>, int> index_;
  std::vector<int> corners_;
};

PolygonSoup ReadText(MeshScanner scanner) {
  StlSoup soup;
  bool is_in_solid = false, is_complete = false;
  for (;;) {
    std::string_view word = TakeWord(&scanner.rest());
    if (word.empty()) break;
    if (word == "solid") {
      is_in_solid = true;
      TakeLine(&scanner.rest());  // its name
    } else if (word == "endsolid") {
      is_in_solid = false;
      is_complete = true;
      TakeLine(&scanner.rest());
    } else if (word == "facet") {
      const std::string place =
          "triangle " + std::to_string(soup.triangles() + 1);
      while ((word = TakeWord(&scanner.rest())) != "endfacet") {
        if (word.empty()) scanner.RefuseContent();
        if (word != "vertex") continue;
        Eigen::Vector3d p;
        for (double& x : p) {
          x = scanner.Real(TakeWord(&scanner.rest()), place);
        }
        soup.AddCorner(p);
      }
      if (!soup.EndTriangle()) {
        scanner.Refuse(place +
                       "; expected three vertices, found others; "
                       "export it again");
      }
    }
  }
  if (!is_complete || is_in_solid) scanner.RefuseContent();
  return soup.Take();
}

PolygonSoup ReadBinary(MeshScanner scanner) {
  scanner.rest().remove_prefix(kHeaderBytes);
  const auto count = scanner.Binary<std::uint32_t>(false);
  scanner.RequireRoom(count, kTriangleBytes, "triangles");
  StlSoup soup;
  for (std::uint32_t t = 0; t < count; ++t) {
    for (int k = 0; k < 3; ++k) scanner.Binary<float>(false);  // its normal
    for (int corner = 0; corner < 3; ++corner) {
      Eigen::Vector3d p;
      for (double& x : p) x = scanner.Binary<float>(false);
      soup.AddCorner(p);
    }
    scanner.Binary<std::uint16_t>(false);  // attributes
    soup.EndTriangle();
  }
  return soup.Take();
}

}  // namespace

PolygonSoup ReadStl(std::string_view bytes, const std::string& file) {
  const MeshScanner scanner(bytes, "STL", file);
  std::uint32_t count = 0;
  const bool has_count = bytes.size() >= kHeaderBytes + sizeof count;
  if (has_count) {
    std::memcpy(&count, bytes.data() + kHeaderBytes, sizeof count);
  }
  const bool is_long_enough =
      has_count &&
      count <= (bytes.size() - kHeaderBytes - sizeof count) / kTriangleBytes;
  // The headers of some binary files say solid too.
  std::string_view text = bytes;
  const bool says_solid = TakeWord(&text) == "solid";
  TakeLine(&text);
  const std::string_view next = TakeWord(&text);
  if (says_solid &&
      (!is_long_enough || next == "facet" || next == "endsolid")) {
    return ReadText(scanner);
  }
  if (!has_count) scanner.RefuseContent();
  return ReadBinary(scanner);
}

}  // namespace phongpd::internal
