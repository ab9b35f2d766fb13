// SPDX-License-Identifier: GPL-3.0-or-later
#include <limits>

#include "core/mesh/mesh_scanner.h"
#include "core/mesh/polygon_soup.h"

namespace phongpd::internal {
namespace {

// Vertices and faces; every other statement is left out.
class ObjReader {
 public:
  ObjReader(std::string_view bytes, const std::string& file)
      : scanner_(bytes, "OBJ", file) {}

  PolygonSoup Read() {
    while (!scanner_.AtEnd()) {
      std::string_view line = Statement();
      const std::string_view keyword = TakeWord(&line);
      if (keyword == "v") ReadVertex(line);
      if (keyword == "f") ReadFace(line);
    }
    return std::move(soup_);
  }

 private:
  // A line, joined with those that continue it.
  std::string_view Statement() {
    std::string_view line = TakeLine(&scanner_.rest());
    if (line.empty() || line.back() != '\\') return line;
    joined_.assign(line);
    while (!joined_.empty() && joined_.back() == '\\' && !scanner_.AtEnd()) {
      joined_.back() = ' ';
      joined_ += TakeLine(&scanner_.rest());
    }
    return joined_;
  }

  void ReadVertex(std::string_view line) {
    const std::string place =
        "vertex " + std::to_string(soup_.points.size() + 1);
    Eigen::Vector3d point;
    for (double& x : point) x = scanner_.Real(TakeWord(&line), place);
    soup_.points.push_back(point);
  }

  void ReadFace(std::string_view line) {
    std::vector<int> polygon;
    for (;;) {
      const std::string_view corner = TakeWord(&line);
      if (corner.empty() || corner.front() == '#') break;
      polygon.push_back(Index(corner));
    }
    soup_.polygons.push_back(std::move(polygon));
  }

  // Of "v", "v/vt", "v//vn" or "v/vt/vn"; negative ones count back from the
  // last vertex so far.
  int Index(std::string_view corner) const {
    const std::string_view word = corner.substr(0, corner.find('/'));
    long long index = 0;
    const bool is_integer = ParseInteger(word, &index);
    if (!is_integer || index > std::numeric_limits<int>::max() ||
        index < std::numeric_limits<int>::min()) {
      scanner_.Refuse("face " + std::to_string(soup_.polygons.size() + 1) +
                      "; expected vertex indices, each a 32-bit integer, "
                      "found " +
                      Quoted(corner) + "; export it again");
    }
    if (index > 0) return static_cast<int>(index - 1);
    if (index == 0) return -1;
    return static_cast<int>(static_cast<long long>(soup_.points.size()) +
                            index);
  }

  MeshScanner scanner_;
  PolygonSoup soup_;
  std::string joined_;
};

}  // namespace

PolygonSoup ReadObj(std::string_view bytes, const std::string& file) {
  return ObjReader(bytes, file).Read();
}

}  // namespace phongpd::internal
