// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/joint_curves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "constraints/curve_judge.h"
#include "core/stopwatch.h"
#include "planners/trajectory/curve_limits.h"
#include "planners/trajectory/curve_program.h"
#include "planners/trajectory/joint_bodies.h"
#include "planners/trajectory/joint_interior_point.h"
#include "planners/trajectory/joint_places.h"
#include "planners/trajectory/knot_curve.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;
using Curves = std::vector<KnotCurve>;

// Pieces of all curves; twice as many until what is between the knots is
// free.
constexpr int kFirstPieces = 20, kMostPieces = 160;
constexpr int kMostTied = 50;    // of pieces that are made twice as many then
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
constexpr long kMostTests = 1'000'000;  // of hulls, a curve
constexpr double kAboveLimit = 0x1p-48;

// Knots at these times; at rest after its end.
KnotCurve TakenAt(const JointRobot& robot, const std::vector<double>& times) {
  KnotCurve curve;
  const std::size_t last = times.size() - 1;
  for (std::size_t k = 0; k <= last; ++k) {
    const double t = times[k];
    const Trajectory::Sample at = robot.motion.At(t);
    const bool rests =
        k == 0 || k == last || robot.stays || t >= robot.motion.duration();
    curve.knots.push_back(
        {at.position, rests ? Vector3d(Vector3d::Zero()) : at.velocity,
         rests ? Vector3d(Vector3d::Zero()) : at.acceleration});
    if (k < last) curve.durations.push_back(times[k + 1] - t);
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
      diagonal_ = std::max(diagonal_, robot.diagonal);
      if (robot.stays) continue;
      first_ = std::max(first_, robot.motion.duration());
      has_bodies_ = has_bodies_ || !robot.bodies.empty();
      speed_ = std::max(speed_, LargestSpeed(robot.bodies));
    }
  }

  JointMotions Run() {
    JointMotions result;
    if (!Begin()) return result;
    if (is_tied_ && !Untie(&result.rounds)) return result;
    RunRounds(task_.wanted, &result.rounds);
    for (int i = 0; i < task_.halvings && Halve(); ++i) {
      RunRounds(task_.wanted, &result.rounds);
    }
    if (now_[0].Duration() < first_) result.motions = Within();
    return result;
  }

 private:
  bool MustEnd() const {
    return stopwatch_.Seconds() > task_.time_limit ||
           (task_.is_interrupted && task_.is_interrupted());
  }

  // Until it gains little, or is as good as is wanted, of one size of pieces.
  void RunRounds(double wanted, int* rounds) {
    int small_gains = 0;
    double sigma = kSigma, trust = kTrust * diagonal_;
    for (int i = 0;
         i < kMaxRounds && small_gains < kSmallGains &&
         sigma > kSmallestSigma && now_[0].Duration() > wanted && !MustEnd();
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
    for (auto& places : places_) {
      for (JointPlace& place : places) {
        place.first *= 2;
        place.last *= 2;
      }
    }
    Slow(HasClock() ? 1.0 : 0.0, &halved);
    if (MustEnd() || !IsFree(halved)) return false;
    now_ = std::move(halved);
    return true;
  }

  // Beside what moves on its own clock it is not free to go faster than was
  // thought.
  bool HasClock() const { return has_bodies_ && !is_tied_; }

  // The bodies of a robot as they move beside curves of that duration.
  std::vector<MovingBody> BodiesOf(const JointRobot& robot,
                                   double duration) const {
    std::vector<MovingBody> bodies = robot.bodies;
    if (!is_tied_) return bodies;
    for (MovingBody& body : bodies) {
      body.motion = body.motion.Slowed(duration / first_);
    }
    return bodies;
  }

  // Faster until bodies can have their own clock again; if need be with more
  // pieces.
  bool Untie(int* rounds) {
    for (;;) {
      RunRounds(first_, rounds);
      Curves curves = now_;
      // At that pace they are what they were.
      const double slower = first_ / now_[0].Duration();
      for (KnotCurve& curve : curves) curve.Slow(std::max(1.0, slower));
      is_tied_ = false;
      if (IsFree(curves)) {
        now_ = std::move(curves);
        return true;
      }
      is_tied_ = true;
      if (now_[0].pieces() > kMostTied || !Halve()) return false;
    }
  }

  bool IsFree(const Curves& curves) const {
    for (std::size_t c = 0; c < curves.size(); ++c) {
      const JointRobot& robot = task_.robots[c];
      if (robot.stays) continue;
      if (!CheckCurveAmong(*robot.fixed, BodiesOf(robot, curves[c].Duration()),
                           curves[c].ToTrajectory(), robot.required)
               .IsFree()) {
        return false;
      }
    }
    return std::all_of(
        task_.pairs.begin(), task_.pairs.end(), [&](const JointPair& pair) {
          return CheckCurve(*pair.space, DifferenceOf(curves, pair), kMostTests,
                            RequiredOf(pair))
              .IsFree();
        });
  }

  double RequiredOf(const JointPair& pair) const {
    return std::max(
        task_.robots[static_cast<std::size_t>(pair.first)].required,
        task_.robots[static_cast<std::size_t>(pair.second)].required);
  }

  // To the limits, and to at least so slow a pace.
  void Slow(double least, Curves* curves) const {
    double factor = least;
    for (std::size_t c = 0; c < curves->size(); ++c) {
      const KnotCurve& curve = (*curves)[c];
      factor = std::max({factor, SlowingOf(curve, task_.robots[c].limits),
                         SlowingOfRests(places_[c], curve)});
    }
    for (KnotCurve& curve : *curves) curve.Slow(factor);
  }

  bool Begin() {
    std::vector<Trajectory> motions;
    std::vector<std::vector<CurveVia>> via;
    for (const JointRobot& robot : task_.robots) {
      motions.push_back(robot.motion);
      via.push_back(robot.via);
    }
    is_tied_ = has_bodies_;
    for (int pieces = kFirstPieces; pieces <= kMostPieces; pieces *= 2) {
      if (MustEnd()) return false;
      const auto knots = JointKnotsOf(motions, via, first_, pieces);
      if (!knots) continue;
      places_ = knots->places;
      now_.clear();
      for (std::size_t c = 0; c < motions.size(); ++c) {
        now_.push_back(TakenAt(task_.robots[c], knots->times));
        PutIntoPlaces(places_[c], &now_.back());
      }
      Slow(0.0, &now_);
      if (IsFree(now_)) return true;
    }
    return false;
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
    for (const JointPlace& place : places_[c]) {
      if (place.via.dwell > 0.0) continue;
      options.via.push_back(
          {place.first, place.via.point, place.via.tolerance});
    }
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
        row.constant = JointRowConstant(one, robot.margin) / trust;
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
      program.rests.push_back(RestingKnots(places_[c]));
      if (!task_.robots[c].stays) AddOwnRows(c, trust, &program);
    }
    Append(RowsOfTimes(now_[0], speed_, trust, HasClock()), &program);
    for (const JointPair& pair : task_.pairs) AddPair(pair, trust, &program);
    return program;
  }

  static void Append(const std::vector<JointProgram::Row>& rows,
                     JointProgram* program) {
    program->rows.insert(program->rows.end(), rows.begin(), rows.end());
  }

  void AddOwnRows(std::size_t c, double trust, JointProgram* program) const {
    const JointRobot& robot = task_.robots[c];
    Append(RowsOfRests(places_[c], now_[c]), program);
    for (const MovingBody& body : BodiesOf(robot, now_[c].Duration())) {
      Append(RowsAgainst(body, now_[c], static_cast<int>(c), trust,
                         robot.margin, HasClock()),
             program);
    }
  }

  void AddPair(const JointPair& pair, double trust,
               JointProgram* program) const {
    const double margin = PairMargin(pair);
    for (int i = 0; i < now_[0].pieces(); ++i) {
      const PieceCells cells = FindCells(*pair.space, Difference(now_, pair, i),
                                         2.0 * trust, margin);
      for (const ClearanceRow& one : cells.rows) {
        program->rows.push_back({i, pair.first, pair.second, one.first,
                                 one.last, one.weight, -one.normal,
                                 JointRowConstant(one, margin) / trust});
      }
    }
  }

  Curves Moved(const JointProgram& program, const Eigen::VectorXd& x,
               double trust, double share) const {
    const JointUnknowns unknowns(program);
    Curves moved;
    const int block = 9 * static_cast<int>(now_.size()) + 1;
    for (std::size_t c = 0; c < now_.size(); ++c) {
      KnotCurve change;
      for (int k = 0; k < now_[c].pieces(); ++k) {
        const double pace = program.curves[c].pace[k];
        const auto of =
            x.segment<9>(block * k + 9 * static_cast<Eigen::Index>(c));
        change.knots.push_back({trust * of.segment<3>(0),
                                (5.0 * trust / pace) * of.segment<3>(3),
                                (20.0 * trust / (pace * pace)) * of.tail<3>()});
        change.durations.push_back(unknowns.EtaOf(k, x));
      }
      change.knots.emplace_back();
      moved.push_back(internal::Moved(now_[c], change, share));
      PutIntoPlaces(places_[c], &moved[c]);
    }
    const double t = share * x[x.size() - 1];
    Slow(HasClock() ? 1.0 + t : 0.0, &moved);
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
  bool has_bodies_ = false;
  // Bodies go as slowly, or fast, as the curves: what is free remains so at
  // another pace.  The motions given, taken at knots, pass their limits, and
  // could not be slowed beside what has its own clock.
  bool is_tied_ = false;
  double speed_ = 0.0;                           // of the fastest of them
  std::vector<std::vector<JointPlace>> places_;  // of each curve
  Curves now_;
};

}  // namespace

JointMotions HastenTogether(const JointTask& task) {
  return Together(task).Run();
}

}  // namespace phongpd::internal
