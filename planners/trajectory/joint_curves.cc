// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/joint_curves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "constraints/curve_judge.h"
#include "core/stopwatch.h"
#include "planners/trajectory/curve_program.h"
#include "planners/trajectory/joint_interior_point.h"
#include "planners/trajectory/knot_curve.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;
using Curves = std::vector<KnotCurve>;

// Pieces of all curves; twice as many until what is between the knots is free.
constexpr int kFirstPieces = 20, kMostPieces = 160;
constexpr double kTrust = 0.05;  // τ, of D
constexpr double kSigma = 0.1;   // σ of the first round
constexpr double kLargestSigma = 0.5, kSmallestSigma = 1e-4;
// So much of a step was taken, and what σ and τ change by then.
struct Taken {
  double share, of_sigma, of_trust;
  double gain = 0.0;  // what the time fell by, a share
};
constexpr std::array<Taken, 3> kShares = {
    {{1.0, 1.5, 1.0}, {0.5, 0.8, 0.9}, {0.2, 0.5, 0.7}}};
constexpr Taken kNoStep = {0.0, 0.3, 0.5};
constexpr int kMaxRounds = 40;  // of a size of pieces
constexpr int kSmallGains = 3;
constexpr double kSmallGain = 2e-3;
// Of clearances: a round keeps so much of one, or of the margin.
constexpr double kKept = 0.999, kKeptMargin = 0.99;
constexpr double kAboveLimit = 0x1p-48;

// Knots at even times; at rest after its end.
KnotCurve TakenAt(const JointRobot& robot, double duration, int pieces) {
  KnotCurve curve;
  for (int k = 0; k <= pieces; ++k) {
    const Trajectory::Sample at =
        robot.motion.At(k == pieces ? duration : duration * k / pieces);
    const bool rests = k == 0 || k == pieces || robot.stays ||
                       duration * k / pieces >= robot.motion.duration();
    curve.knots.push_back(
        {at.position, rests ? Vector3d(Vector3d::Zero()) : at.velocity,
         rests ? Vector3d(Vector3d::Zero()) : at.acceleration});
    if (k < pieces) curve.durations.push_back(duration / pieces);
  }
  return curve;
}

KnotCurve::Points Difference(const Curves& curves, const JointPair& pair,
                             int piece) {
  return curves[static_cast<std::size_t>(pair.first)].PointsOf(piece) -
         curves[static_cast<std::size_t>(pair.second)].PointsOf(piece);
}

Trajectory DifferenceOf(const Curves& curves, const JointPair& pair) {
  std::vector<CurvePiece> pieces;
  std::vector<Vector3d> points(6);
  for (int i = 0; i < curves[0].pieces(); ++i) {
    const KnotCurve::Points all = Difference(curves, pair, i);
    for (int j = 0; j < 6; ++j) points[j] = all.col(j);
    pieces.emplace_back(points, curves[0].durations[i]);
  }
  return Trajectory(std::move(pieces));
}

class Together {
 public:
  explicit Together(const JointTask& task) : task_(task) {
    for (const JointRobot& robot : task.robots) {
      first_ = std::max(first_, robot.motion.duration());
      diagonal_ = std::max(diagonal_, robot.diagonal);
    }
  }

  JointMotions Run() {
    JointMotions result;
    if (!Begin()) return result;
    RunRounds(&result.rounds);
    for (int i = 0; i < task_.halvings && Halve(); ++i) {
      RunRounds(&result.rounds);
    }
    if (now_[0].Duration() < first_) result.motions = Within();
    return result;
  }

 private:
  bool MustEnd() const {
    return stopwatch_.Seconds() > task_.time_limit ||
           (task_.is_interrupted && task_.is_interrupted());
  }

  // Until it gains little, of one size of pieces.
  void RunRounds(int* rounds) {
    int small_gains = 0;
    double sigma = kSigma, trust = kTrust * diagonal_;
    for (int i = 0; i < kMaxRounds && small_gains < kSmallGains &&
                    sigma > kSmallestSigma &&
                    now_[0].Duration() > task_.wanted && !MustEnd();
         ++i) {
      ++*rounds;
      const Taken taken = Round(trust, sigma);
      sigma = std::min(taken.of_sigma * sigma, kLargestSigma);
      trust *= taken.of_trust;
      if (taken.gain < kSmallGain) ++small_gains;
      if (taken.gain > kSmallGain) small_gains = 0;
    }
  }

  bool Halve() {
    Curves halved;
    for (const KnotCurve& curve : now_) halved.push_back(curve.Halved());
    Slow(&halved);
    if (MustEnd() || !IsFree(halved)) return false;
    now_ = std::move(halved);
    return true;
  }

  bool IsFree(const Curves& curves) const {
    for (std::size_t c = 0; c < curves.size(); ++c) {
      if (task_.robots[c].stays) continue;
      if (!CheckCurve(*task_.robots[c].fixed, curves[c].ToTrajectory())
               .IsFree()) {
        return false;
      }
    }
    return std::all_of(
        task_.pairs.begin(), task_.pairs.end(), [&](const JointPair& pair) {
          return CheckCurve(*pair.space, DifferenceOf(curves, pair)).IsFree();
        });
  }

  void Slow(Curves* curves) const {
    double factor = 0.0;
    for (std::size_t c = 0; c < curves->size(); ++c) {
      factor =
          std::max(factor, SlowingOf((*curves)[c], task_.robots[c].limits));
    }
    for (KnotCurve& curve : *curves) curve.Slow(factor);
  }

  bool Begin() {
    for (int pieces = kFirstPieces; pieces <= kMostPieces; pieces *= 2) {
      now_.clear();
      for (const JointRobot& robot : task_.robots) {
        now_.push_back(TakenAt(robot, first_, pieces));
      }
      if (MustEnd()) return false;
      if (!IsFree(now_)) continue;
      Slow(&now_);
      return true;
    }
    return false;
  }

  // Rows keep what there is of the clearances, but for what is above margins.
  static double RowConstant(const ClearanceRow& row, double margin) {
    return std::min(kKept * row.distance, kKeptMargin * margin) - row.gap;
  }

  double PairMargin(const JointPair& pair) const {
    return std::min(task_.robots[static_cast<std::size_t>(pair.first)].margin,
                    task_.robots[static_cast<std::size_t>(pair.second)].margin);
  }

  CurveProgram ProgramOf(std::size_t c, double trust, double sigma) const {
    const JointRobot& robot = task_.robots[c];
    CurveProgramOptions options;
    options.limits = robot.limits;
    options.diagonal = diagonal_;
    options.trust = trust;
    options.sigma = sigma;
    const std::vector<PieceCells> none(now_[c].durations.size());
    CurveProgram program = BuildCurveProgram(now_[c], none, options);
    for (int i = 0; !robot.stays && i < now_[c].pieces(); ++i) {
      const PieceCells cells =
          FindCells(*robot.fixed, now_[c].PointsOf(i), trust, robot.margin);
      for (const ClearanceRow& one : cells.rows) {
        CurveProgram::Row row;
        row.kind = CurveProgram::Row::kDirection;
        row.first = one.first;
        row.last = one.last;
        row.weight = one.weight;
        row.direction = -one.normal;
        row.constant = RowConstant(one, robot.margin) / trust;
        program.pieces[i].rows.push_back(row);
      }
    }
    return program;
  }

  JointProgram Program(double trust, double sigma) const {
    JointProgram program;
    for (std::size_t c = 0; c < now_.size(); ++c) {
      program.curves.push_back(ProgramOf(c, trust, sigma));
      program.stays.push_back(task_.robots[c].stays);
    }
    for (const JointPair& pair : task_.pairs) {
      const double margin = PairMargin(pair);
      for (int i = 0; i < now_[0].pieces(); ++i) {
        const PieceCells cells = FindCells(
            *pair.space, Difference(now_, pair, i), 2.0 * trust, margin);
        for (const ClearanceRow& one : cells.rows) {
          program.pairs.push_back({i, pair.first, pair.second, one.first,
                                   one.last, one.weight, -one.normal,
                                   RowConstant(one, margin) / trust});
        }
      }
    }
    return program;
  }

  Curves Moved(const JointProgram& program, const Eigen::VectorXd& x,
               double trust, double share) const {
    Curves moved = now_;
    const int block = 9 * static_cast<int>(now_.size()) + 1;
    for (std::size_t c = 0; c < now_.size(); ++c) {
      for (int k = 0; k < now_[c].pieces(); ++k) {
        const double pace = program.curves[c].pace[k];
        const auto of =
            x.segment<9>(block * k + 9 * static_cast<Eigen::Index>(c));
        KnotCurve::State& knot = moved[c].knots[k];
        knot.p += (share * trust) * of.segment<3>(0);
        knot.v += (share * 5.0 * trust / pace) * of.segment<3>(3);
        knot.a += (share * 20.0 * trust / (pace * pace)) * of.segment<3>(6);
        moved[c].durations[k] *= std::exp(share * x[block * k + block - 1]);
      }
    }
    Slow(&moved);
    return moved;
  }

  // The largest share of a step that gains and is free; 0 gained: none.
  Taken Round(double trust, double sigma) {
    const JointProgram program = Program(trust, sigma);
    const Eigen::VectorXd x = JointInteriorPoint(program).Solve().x;
    const double before = now_[0].Duration();
    for (const Taken& taken : kShares) {
      Curves moved = Moved(program, x, trust, taken.share);
      const double gain = 1.0 - moved[0].Duration() / before;
      if (!(gain > 0.0) || !IsFree(moved)) continue;
      now_ = std::move(moved);
      return {taken.share, taken.of_sigma, taken.of_trust, gain};
    }
    return kNoStep;
  }

  // Their limits proved: the same factor for all.
  std::vector<Trajectory> Within() const {
    std::vector<Trajectory> motions;
    double slowing = 1.0;
    for (std::size_t c = 0; c < now_.size(); ++c) {
      motions.push_back(now_[c].ToTrajectory());
      slowing = std::max(
          slowing,
          BoundLimitUse(motions[c], task_.robots[c].limits).SlowingNeeded() *
              (1.0 + kAboveLimit));
    }
    for (std::size_t c = 0; c < now_.size(); ++c) {
      motions[c] = motions[c].Slowed(slowing);
      if (!BoundLimitUse(motions[c], task_.robots[c].limits).IsKept()) {
        return {};
      }
    }
    return motions;
  }

  const Stopwatch stopwatch_;
  const JointTask& task_;
  double first_ = 0.0, diagonal_ = 0.0;
  Curves now_;
};

}  // namespace

JointMotions HastenTogether(const JointTask& task) {
  return Together(task).Run();
}

}  // namespace phongpd::internal
