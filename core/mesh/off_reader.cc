// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <cstdint>

#include "core/mesh/mesh_scanner.h"
#include "core/mesh/polygon_soup.h"

namespace phongpd::internal {
namespace {

// [ST][C][N][4]OFF, then BINARY or not, then the counts of vertices, faces and
// edges.  Text: a vertex or face on each line, what follows its numbers is
// ignored.  Binary: big-endian, as CGAL and Geomview write it.
class OffReader {
 public:
  OffReader(std::string_view bytes, const std::string& file)
      : scanner_(bytes, "OFF", file) {}

  PolygonSoup Read() {
    ReadHeader();
    scanner_.RequireRoom(vertices_, is_binary_ ? 12 : 6, "vertices");
    soup_.points.reserve(vertices_);
    for (std::size_t i = 0; i < vertices_; ++i) ReadVertex();
    scanner_.RequireRoom(faces_, is_binary_ ? 8 : 1, "faces");
    soup_.polygons.reserve(faces_);
    for (std::size_t i = 0; i < faces_; ++i) {
      is_binary_ ? ReadBinaryFace() : ReadFace();
    }
    return std::move(soup_);
  }

 private:
  // The next line with something else than a comment; empty at the end.
  std::string_view ContentLine() {
    while (!scanner_.AtEnd()) {
      std::string_view line = TakeLine(&scanner_.rest());
      line = line.substr(0, line.find('#'));
      std::string_view copy = line;
      if (!TakeWord(&copy).empty()) return line;
    }
    return {};
  }

  void ReadHeader() {
    std::string_view line = ContentLine();
    ReadKeyword(TakeWord(&line));
    std::string_view word = TakeWord(&line);
    if (word == "BINARY") {
      is_binary_ = true;
      // The bytes begin behind this line.
      vertices_ = Count(scanner_.Binary<std::int32_t>(true));
      faces_ = Count(scanner_.Binary<std::int32_t>(true));
      scanner_.Binary<std::int32_t>(true);  // edges
      return;
    }
    for (std::size_t* count : {&vertices_, &faces_}) {
      if (word.empty()) {
        line = ContentLine();
        word = TakeWord(&line);
      }
      long long value = -1;
      if (!ParseInteger(word, &value)) scanner_.RefuseContent();
      *count = Count(value);
      word = TakeWord(&line);
    }
  }

  void ReadKeyword(std::string_view word) {
    const auto take = [&word](std::string_view prefix) {
      const bool is_there = word.substr(0, prefix.size()) == prefix;
      if (is_there) word.remove_prefix(prefix.size());
      return is_there;
    };
    has_textures_ = take("ST");
    has_colors_ = take("C");
    has_normals_ = take("N");
    is_homogeneous_ = take("4");
    if (take("n")) {
      scanner_.Refuse("nOFF header; expected points in three dimensions");
    }
    if (word != "OFF") scanner_.RefuseContent();
  }

  std::size_t Count(long long value) const {
    if (value < 0) scanner_.RefuseContent();
    return static_cast<std::size_t>(value);
  }

  void ReadVertex() {
    const int numbers = is_homogeneous_ ? 4 : 3;
    const auto place = [this] {
      return "vertex " + std::to_string(soup_.points.size() + 1);
    };
    double x[4] = {0, 0, 0, 1};
    if (is_binary_) {
      for (int k = 0; k < numbers; ++k) x[k] = scanner_.Binary<float>(true);
      if (has_normals_) Skip(numbers);
      if (has_colors_) Skip(ColorCount());
      if (has_textures_) Skip(is_homogeneous_ ? 3 : 2);
    } else {
      std::string_view line = ContentLine();
      const std::string text_place = place();
      for (int k = 0; k < numbers; ++k) {
        x[k] = scanner_.Real(TakeWord(&line), text_place);
      }
    }
    if (x[3] == 0.0 || !std::isfinite(x[3])) {
      scanner_.Refuse(place() +
                      "; expected a finite fourth coordinate other than 0, "
                      "found " +
                      (x[3] == 0.0 ? "0" : "NaN or infinity") +
                      "; export it again");
    }
    soup_.points.emplace_back(x[0] / x[3], x[1] / x[3], x[2] / x[3]);
  }

  void ReadFace() {
    std::string_view line = ContentLine();
    long long corners = -1;
    if (!ParseInteger(TakeWord(&line), &corners) || corners < 0) RefuseFace();
    std::vector<int> polygon;
    for (long long j = 0; j < corners; ++j) {
      long long index = -1;
      // The line ends what its count only claims.
      if (!ParseInteger(TakeWord(&line), &index)) RefuseFace();
      polygon.push_back(Index(index));
    }
    soup_.polygons.push_back(std::move(polygon));
  }

  void ReadBinaryFace() {
    const auto corners = scanner_.Binary<std::int32_t>(true);
    if (corners < 0) RefuseFace();
    scanner_.RequireRoom(static_cast<unsigned>(corners), 4, "corners");
    std::vector<int> polygon;
    for (int j = 0; j < corners; ++j) {
      polygon.push_back(Index(scanner_.Binary<std::int32_t>(true)));
    }
    soup_.polygons.push_back(std::move(polygon));
    Skip(ColorCount());
  }

  int Index(long long index) const {
    if (index < 0 || index >= static_cast<long long>(soup_.points.size())) {
      RefuseFace();
    }
    return static_cast<int>(index);
  }

  int ColorCount() {
    const auto count = scanner_.Binary<std::int32_t>(true);
    if (count < 0 || count > 4) scanner_.RefuseContent();
    return count;
  }

  void Skip(int floats) {
    for (int i = 0; i < floats; ++i) scanner_.Binary<float>(true);
  }

  [[noreturn]] void RefuseFace() const {
    scanner_.Refuse("face " + std::to_string(soup_.polygons.size() + 1) +
                    " of " + std::to_string(faces_) +
                    "; expected its number of corners and as many indices "
                    "below " +
                    std::to_string(soup_.points.size()) +
                    ", found another or no line; export it again");
  }

  MeshScanner scanner_;
  PolygonSoup soup_;
  std::size_t vertices_ = 0, faces_ = 0;
  bool is_binary_ = false, is_homogeneous_ = false;
  bool has_textures_ = false, has_colors_ = false, has_normals_ = false;
};

}  // namespace

PolygonSoup ReadOff(std::string_view bytes, const std::string& file) {
  return OffReader(bytes, file).Read();
}

}  // namespace phongpd::internal
