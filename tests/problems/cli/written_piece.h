// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

// Pieces of a motion as files have them, evaluated by other code than ours.
namespace phongpd {

// A Bézier piece as the file has it.
struct Piece {
  double duration = 0.0;
  std::vector<Eigen::Vector3d> points;
};

// De Casteljau.
inline Eigen::Vector3d PointAt(std::vector<Eigen::Vector3d> points, double s) {
  while (points.size() > 1) {
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      points[i] += s * (points[i + 1] - points[i]);
    }
    points.pop_back();
  }
  return points.front();
}

// By time, of order 1, 2, ...
inline Piece DerivativeOf(Piece piece, int order) {
  for (; order > 0; --order) {
    const double n = static_cast<double>(piece.points.size()) - 1.0;
    for (std::size_t i = 0; i + 1 < piece.points.size(); ++i) {
      piece.points[i] =
          (piece.points[i + 1] - piece.points[i]) * (n / piece.duration);
    }
    piece.points.pop_back();
  }
  return piece;
}

inline Eigen::Vector3d At(const Piece& piece, int order, double s) {
  return PointAt(DerivativeOf(piece, order).points, s);
}

}  // namespace phongpd
