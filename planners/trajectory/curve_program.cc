// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/curve_program.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "planners/trajectory/curve_interior_point.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// Clearance that a round leaves: this share of what there is, but no less than
// so much of D, below which most of it is kept.
constexpr double kKept = 0.1;
constexpr double kFloor = 1e-6;
constexpr double kKeptBelow = 0.9;
constexpr double kSlowest = -0.6;   // of t
constexpr double kPriceOfT = 20.0;  // where the pace is kept
// The price of the mean of (η_i − η_{i−1})², times σ², where pieces are
// trusted.
constexpr double kCaution = 0.05;
// A limit that is not there is replaced in the jerk's term by so many times
// the largest that there is.
constexpr double kNoLimit = 1e100;

// What makes derivatives of differences of order k of points.
constexpr std::array<double, 4> kFactor = {1.0, 5.0, 20.0, 60.0};

class Builder {
 public:
  Builder(const KnotCurve& now, const std::vector<PieceCells>& cells,
          const CurveProgramOptions& options)
      : now_(now), cells_(cells), options_(options) {}

  CurveProgram Build() {
    const int n = now_.pieces();
    const double total = now_.Duration();
    CurveProgram program;
    program.pieces.resize(n);
    const Vector3d jerk = options_.jerk_scale.isZero(0.0)
                              ? JerkScale(now_, options_.limits)
                              : options_.jerk_scale;
    for (int k = 0; k <= n; ++k) {
      const double before = now_.durations[std::max(k - 1, 0)];
      const double after = now_.durations[std::min(k, n - 1)];
      program.pace.push_back(0.5 * (before + after));
    }
    for (int i = 0; i < n; ++i) {
      CurveProgram::Piece& piece = program.pieces[i];
      const double h = now_.durations[i];
      piece.before = h / program.pace[i];
      piece.after = h / program.pace[i + 1];
      piece.share = h / total;
      const KnotCurve::Points b = now_.PointsOf(i);
      const KnotCurve::State& s0 = now_.knots[i];
      const KnotCurve::State& s1 = now_.knots[i + 1];
      piece.by_eta.setZero();
      piece.by_eta.col(1) = (h / 5.0) * s0.v;
      piece.by_eta.col(2) = (2.0 * h / 5.0) * s0.v + (h * h / 10.0) * s0.a;
      piece.by_eta.col(3) = -(2.0 * h / 5.0) * s1.v + (h * h / 10.0) * s1.a;
      piece.by_eta.col(4) = -(h / 5.0) * s1.v;
      piece.by_eta /= options_.trust;
      piece.rows.reserve(RowsAtMost(cells_[i]));
      AddLimits(i, b, h, &piece);
      AddClearance(cells_[i], &piece);
      AddTrust(&piece);
      const double trusted =
          options_.caution.empty() ? 1.0 : options_.caution[i];
      piece.caution =
          kCaution / (n * trusted * options_.sigma * options_.sigma);
      AddJerk(b, h, jerk, &piece);
      piece.log_duration = std::log(h);
    }
    for (const ViaKnot& via : options_.via) AddVia(via, &program);
    CurveProgram::Row slowest;
    slowest.t = -1.0;
    slowest.constant = options_.keeps_pace ? 0.0 : kSlowest;
    program.pieces[0].rows.push_back(slowest);
    if (options_.keeps_pace) program.t = kPriceOfT;
    program.evenness = options_.weights.evenness / n;
    program.missing = options_.margin > 0.0
                          ? options_.weights.missing * options_.trust /
                                (options_.diagonal * n)
                          : 0.0;
    return program;
  }

 private:
  // Each clearance once kept, once wished for; norms, and the rest.
  static std::size_t RowsAtMost(const PieceCells& cells) {
    return 2 * cells.rows.size() + 16;
  }

  void AddLimits(int i, const KnotCurve::Points& b, double h,
                 CurveProgram::Piece* piece) const {
    const PieceDerivatives of(b, h);
    const MotionLimits& limits = options_.limits;
    AddLimit(i, 1, h, of.velocity, limits.velocity, piece);
    AddLimit(i, 2, h, of.acceleration, limits.acceleration, piece);
    AddLimit(i, 3, h, of.jerk, limits.jerk, piece);
  }

  // Points of derivatives that are what an end in motion says: they may be at
  // the limit.
  bool IsGiven(int i, int order, int j) const {
    const auto is_given = [&](const KnotCurve::State& end, int from_end) {
      return order < 3 && !(end.v.isZero(0.0) && end.a.isZero(0.0)) &&
             from_end <= (order == 1 && end.a.isZero(0.0) ? 1 : 0);
    };
    return (i == 0 && is_given(now_.knots.front(), j)) ||
           (i + 1 == now_.pieces() &&
            is_given(now_.knots.back(), 5 - order - j));
  }

  void AddLimit(int i, int order, double h,
                const Eigen::Ref<const Eigen::Matrix3Xd>& of,
                const Vector3d& limit, CurveProgram::Piece* piece) const {
    int first = 0, last = 5 - order;
    while (first <= last && IsGiven(i, order, first)) ++first;
    while (first <= last && IsGiven(i, order, last)) --last;
    const double scale = kFactor[order] / std::pow(h, order) * options_.trust;
    if (options_.limits.by_norm) {
      if (limit[0] > kNoLimit) return;
      for (int j = first; j <= last; ++j) {
        piece->rows.push_back(NormRow(order, j, scale, of.col(j), limit[0]));
      }
      return;
    }
    CurveProgram::Bounds bounds;
    bounds.order = order;
    bounds.first = first;
    bounds.last = last;
    bounds.most = 1.0 - options_.spare;
    for (int axis = 0; axis < 3; ++axis) {
      if (limit[axis] > kNoLimit) continue;
      bounds.scale[axis] = scale / limit[axis];
      bounds.value.row(axis).head(6 - order) = of.row(axis) / limit[axis];
      bounds.t[axis] = -order;
    }
    if (!bounds.t.isZero(0.0)) piece->bounds.push_back(bounds);
  }

  CurveProgram::Row NormRow(int order, int j, double scale,
                            const Vector3d& value, double limit) const {
    CurveProgram::Row row;
    row.kind = CurveProgram::Row::kNorm;
    row.first = j;
    row.last = j + order;
    for (int k = 0; k <= order; ++k) {
      row.weight[j + k] = scale / limit * kDifferences[order][k];
    }
    row.value = value / limit;
    row.eta = -order;
    row.t = -order;
    row.constant = options_.spare - 1.0;
    return row;
  }

  void AddVia(const ViaKnot& via, CurveProgram* program) const {
    CurveProgram::Row row;
    row.kind = CurveProgram::Row::kNorm;
    row.first = row.last = 0;
    row.weight[0] = options_.trust / via.tolerance;
    row.value = (now_.knots[via.knot].p - via.point) / via.tolerance;
    row.constant = -1.0;
    program->pieces[via.knot].rows.push_back(row);
  }

  void AddClearance(const PieceCells& cells, CurveProgram::Piece* piece) const {
    const double tau = options_.trust;
    for (const ClearanceRow& one : cells.rows) {
      CurveProgram::Row row;
      row.kind = CurveProgram::Row::kDirection;
      row.first = one.first;
      row.last = one.last;
      row.weight = one.weight;
      row.direction = -one.normal;
      const double floor = kFloor * options_.diagonal;
      const double kept = one.distance > floor ? std::max(kKept * one.distance,
                                                          kKeptBelow * floor)
                                               : kKeptBelow * one.distance;
      row.constant = (kept - one.gap) / tau;
      piece->rows.push_back(row);
      if (options_.margin > kept) {
        row.constant = (options_.margin - one.gap) / tau;
        row.missing = -1.0;
        row.repeats = true;
        piece->rows.push_back(row);
        piece->missing =
            std::max(piece->missing, (options_.margin - one.gap) / tau);
      }
    }
    CurveProgram::Row row;
    row.kind = CurveProgram::Row::kScalar;
    row.missing = -1.0;
    if (options_.margin > 0.0) piece->rows.push_back(row);
  }

  void AddTrust(CurveProgram::Piece* piece) const {
    CurveProgram::Bounds points;
    points.last = 5;
    points.scale.setOnes();
    piece->bounds.push_back(points);
    CurveProgram::Row eta;
    eta.kind = CurveProgram::Row::kScalar;
    eta.constant = -1.0;
    for (const double sign : {1.0, -1.0}) {
      eta.eta = sign / options_.sigma;
      piece->rows.push_back(eta);
    }
  }

  // weight · share · ∫ |(J + ΔJ)/scale|² ds.
  void AddJerk(const KnotCurve::Points& b, double h, const Vector3d& scale,
               CurveProgram::Piece* piece) const {
    const PieceDerivatives of(b, h);
    for (int axis = 0; axis < 3; ++axis) {
      const double by = kFactor[3] / (h * h * h) * options_.trust / scale[axis];
      for (int j = 0; j < 3; ++j) {
        auto row = piece->jerk[axis].row(j);
        row.setZero();
        for (int k = 0; k <= 3; ++k) row[j + k] = by * kDifferences[3][k];
        row[6] = -3.0 * of.jerk(axis, j) / scale[axis];
        row[7] = of.jerk(axis, j) / scale[axis];
      }
    }
    piece->jerk_weight = options_.weights.jerk * piece->share;
  }

  const KnotCurve& now_;
  const std::vector<PieceCells>& cells_;
  const CurveProgramOptions& options_;
};

}  // namespace

Vector3d JerkScale(const KnotCurve& curve, const MotionLimits& limits) {
  Vector3d largest = Vector3d::Zero();
  for (int i = 0; i < curve.pieces(); ++i) {
    const PieceDerivatives of(curve.PointsOf(i), curve.durations[i]);
    largest = largest.cwiseMax(of.jerk.cwiseAbs().rowwise().maxCoeff());
  }
  const Vector3d limit =
      limits.by_norm ? Vector3d::Constant(limits.jerk[0]) : limits.jerk;
  const double most = largest.maxCoeff();
  for (int axis = 0; axis < 3; ++axis) {
    largest[axis] = limit[axis] < kNoLimit ? limit[axis] : most;
  }
  return largest;
}

double MeanSquaredJerk(const KnotCurve& curve, const Vector3d& scale) {
  double sum = 0.0;
  for (int i = 0; i < curve.pieces(); ++i) {
    const double h = curve.durations[i];
    const Eigen::Matrix3d jerk = scale.cwiseInverse().asDiagonal() *
                                 PieceDerivatives(curve.PointsOf(i), h).jerk;
    // ∫ of products of the quadratic Bernstein polynomials: 1/5, 1/10, 1/30;
    // 2/15.
    const Vector3d a = jerk.col(0), b = jerk.col(1), c = jerk.col(2);
    sum += h *
           (6.0 * (a.dot(a) + a.dot(b) + b.dot(c) + c.dot(c)) + 4.0 * b.dot(b) +
            2.0 * a.dot(c)) /
           30.0;
  }
  return sum / curve.Duration();
}

CurveProgram BuildCurveProgram(const KnotCurve& now,
                               const std::vector<PieceCells>& cells,
                               const CurveProgramOptions& options) {
  return Builder(now, cells, options).Build();
}

CurveStep SolveCurveProgram(const KnotCurve& now,
                            const std::vector<PieceCells>& cells,
                            const CurveProgramOptions& options) {
  const CurveProgram program = BuildCurveProgram(now, cells, options);
  CurveInteriorPoint solver(program);
  const CurveInteriorPoint::Result result = solver.Solve();

  CurveStep step;
  step.iterations = result.iterations;
  step.rows = result.rows;
  const int n = now.pieces();
  step.change.knots.resize(n + 1);
  double total = 0.0;
  for (int k = 0; k < n; ++k) {
    const auto x =
        result.x.segment<BlockTridiagonal::kSize>(BlockTridiagonal::kSize * k);
    const double pace = program.pace[k], tau = options.trust;
    if (k > 0) {
      step.change.knots[k] = {tau * x.segment<3>(0),
                              (5.0 * tau / pace) * x.segment<3>(3),
                              (20.0 * tau / (pace * pace)) * x.segment<3>(6)};
    }
    step.change.durations.push_back(x[9]);
    total += now.durations[k] * std::exp(x[9]);
  }
  const double t = options.keeps_pace ? 0.0 : result.x[result.x.size() - 1];
  step.pace = 1.0 + t;
  step.predicted = 1.0 - total * step.pace / now.Duration();
  return step;
}

}  // namespace phongpd::internal
