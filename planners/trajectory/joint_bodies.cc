// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/joint_bodies.h"

#include <algorithm>
#include <cmath>

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;
using Weights = Eigen::Matrix<double, 6, 6>;  // a part's point by row

// Of clearances: a round keeps so much of one, or of the margin.
constexpr double kKeptDistance = 0.999, kKeptMargin = 0.99;
// A part of a piece that is so short, as a share, is none.
constexpr double kShortest = 1e-9;

// De Casteljau's, of the part before s.
Weights Before(double s) {
  Weights part = Weights::Zero();
  part(0, 0) = 1.0;
  for (int i = 1; i < 6; ++i) {
    for (int k = 0; k <= i; ++k) {
      part(i, k) =
          (1.0 - s) * part(i - 1, k) + (k > 0 ? s * part(i - 1, k - 1) : 0.0);
    }
  }
  return part;
}

Weights Between(double from, double to) {
  const Weights after = Before(1.0 - from / to).reverse();
  return after * Before(to);
}

// As it is just after `t`, or just before; at rest once it has ended.
Trajectory::Sample BodyAt(const Trajectory& motion, double t, bool before) {
  if (motion.duration() < t || (!before && motion.duration() <= t)) {
    Trajectory::Sample rest;
    rest.position = motion.pieces().back().back();
    return rest;
  }
  return motion.At(t);
}

// Its points between two times, with nothing of its pieces ending between.
KnotCurve::Points BodyPoints(const Trajectory& motion, double from, double to) {
  // Off the ends, where At tells of the piece after.
  const double inside = kShortest * (to - from);
  const Trajectory::Sample a = BodyAt(motion, from, false);
  const Trajectory::Sample b = BodyAt(motion, to - inside, true);
  KnotCurve curve;
  curve.knots = {{a.position, a.velocity, a.acceleration},
                 {b.position, b.velocity, b.acceleration}};
  curve.durations = {to - from};
  return curve.PointsOf(0);
}

class Rows {
 public:
  Rows(const MovingBody& body, const KnotCurve& curve, int index, double trust,
       double margin, bool follows_t)
      : body_(body),
        curve_(curve),
        index_(index),
        trust_(trust),
        margin_(margin),
        total_(curve.Duration()),
        follows_t_(follows_t) {}

  std::vector<JointProgram::Row> Run() {
    double begin = 0.0;
    for (int i = 0; i < curve_.pieces(); ++i) {
      const double h = curve_.durations[i];
      double from = 0.0;
      for (std::size_t k = 1; k <= body_.motion.pieces().size(); ++k) {
        const double s = (body_.motion.StartOf(k) - begin) / h;
        if (s <= from + kShortest || s >= 1.0 - kShortest) continue;
        AddPart(i, begin, from, s);
        from = s;
      }
      AddPart(i, begin, from, 1.0);
      begin += h;
    }
    return std::move(rows_);
  }

 private:
  void AddPart(int piece, double begin, double from, double to) {
    const double h = curve_.durations[piece];
    const Weights part = Between(from, to);
    const KnotCurve::Points relative =
        curve_.PointsOf(piece) * part.transpose() -
        BodyPoints(body_.motion, begin + from * h, begin + to * h);
    // Moved by τ itself; the body by τ for each of the two that times change
    // by.
    const PieceCells cells =
        FindCells(*body_.space, relative, 3.0 * trust_, margin_);
    for (const ClearanceRow& one : cells.rows) {
      JointProgram::Row row;
      row.piece = piece;
      row.first = index_;
      row.weight = part.transpose() * one.weight;
      row.from = 0;
      row.to = 5;
      row.direction = -one.normal;
      row.constant = JointRowConstant(one, margin_) / trust_;
      // When the row's point comes, as a share of the piece.
      double s = 0.0;
      for (int j = 0; j < 6; ++j) {
        s += one.weight[j] * (from + (to - from) * j / 5.0);
      }
      const double time = begin + s * h;
      const Vector3d velocity = BodyAt(body_.motion, time, true).velocity;
      const double speed = one.normal.dot(velocity) / trust_;
      row.eta = speed * s * h;
      row.theta = speed * total_ / curve_.pieces();
      if (follows_t_) row.t = speed * time;
      rows_.push_back(row);
    }
  }

  const MovingBody& body_;
  const KnotCurve& curve_;
  const int index_;
  const double trust_, margin_, total_;
  const bool follows_t_;
  std::vector<JointProgram::Row> rows_;
};

}  // namespace

double JointRowConstant(const ClearanceRow& row, double margin) {
  return std::min(kKeptDistance * row.distance, kKeptMargin * margin) - row.gap;
}

double LargestSpeed(const std::vector<MovingBody>& bodies) {
  double largest = 0.0;
  for (const MovingBody& body : bodies) {
    for (const CurvePiece& piece : body.motion.pieces()) {
      const CurvePiece velocity = piece.Derivative();
      for (int j = 0; j <= velocity.degree(); ++j) {
        largest = std::max(largest, velocity.point(j).norm());
      }
    }
  }
  return largest;
}

std::vector<JointProgram::Row> RowsAgainst(const MovingBody& body,
                                           const KnotCurve& curve, int index,
                                           double trust, double margin,
                                           bool follows_t) {
  return Rows(body, curve, index, trust, margin, follows_t).Run();
}

std::vector<JointProgram::Row> RowsOfTimes(const KnotCurve& curve, double speed,
                                           double trust, bool follows_t) {
  std::vector<JointProgram::Row> rows;
  if (!(speed > 0.0)) return rows;
  const double by = curve.Duration() * speed / trust;
  JointProgram::Row row;
  row.constant = -1.0;
  if (follows_t) {
    row.t = -by;
    rows.push_back(row);
    row.t = 0.0;
  }
  for (row.piece = 1; row.piece < curve.pieces(); ++row.piece) {
    for (const double sign : {1.0, -1.0}) {
      row.theta = sign * by / curve.pieces();
      rows.push_back(row);
    }
  }
  return rows;
}

}  // namespace phongpd::internal
