// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints/rigid/exact_pair.h"

#include <array>
#include <cstddef>
#include <optional>

#include "constraints/rigid/rational_cubic.h"

namespace phongpd::internal {
namespace {

using Point = std::array<Rational, 3>;
using CubicVector = std::array<RationalCubic, 3>;
using Corners = std::array<Point, 3>;

Point ToRational(const Eigen::Vector3d& v) {
  return {Rational(v.x()), Rational(v.y()), Rational(v.z())};
}

Corners ToRational(const TriangleCorners& t) {
  return {ToRational(t[0]), ToRational(t[1]), ToRational(t[2])};
}

Point Minus(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Point Cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
          a[0] * b[1] - a[1] * b[0]};
}

Rational Dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

RationalCubic Dot(const Point& a, const CubicVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

bool IsZero(const Point& a) { return a[0] == 0 && a[1] == 0 && a[2] == 0; }

RationalCubic Constant(const Rational& x) {
  RationalCubic p;
  p.c[0] = x;
  return p;
}

// (1 − t) a + t b of doubles.
RationalCubic Line(double a, double b) {
  RationalCubic p;
  p.c[0] = Rational(a);
  p.c[1] = Rational(b) - Rational(a);
  return p;
}

std::size_t After(std::size_t i) { return (i + 1) % 3; }

}  // namespace

// What all pairs of a motion share: M, N and q by t.
struct ExactPairJudge::Impl {
  std::array<CubicVector, 3> rows;  // of M
  RationalCubic squared;            // N
  CubicVector position;             // q

  CubicVector Turned(const Point& v) const {
    return {Dot(v, rows[0]), Dot(v, rows[1]), Dot(v, rows[2])};
  }
};

namespace {

// The 33 cubics of a pair on a part of the way, and their signs at a time.
class PairConditions {
 public:
  template <typename Motion>
  PairConditions(const Motion& motion, const Corners& r, const Corners& b,
                 const Rational& from, const Rational& to)
      : from_(from), to_(to) {
    Corners e, f;
    for (std::size_t i = 0; i < 3; ++i) {
      e[i] = Minus(r[After(i)], r[i]);
      f[i] = Minus(b[After(i)], b[i]);
    }
    const Point m = Cross(e[0], e[1]), n = Cross(f[0], f[1]);
    has_area_ = !IsZero(m) && !IsZero(n);
    if (!has_area_) return;
    std::array<CubicVector, 3> x, z;
    for (std::size_t i = 0; i < 3; ++i) {
      const CubicVector turned = motion.Turned(r[i]);
      for (std::size_t k = 0; k < 3; ++k) {
        x[i][k] = turned[k] + motion.squared * motion.position[k];
      }
      Put(RobotCorner(i), Dot(n, x[i]) - Dot(n, b[0]) * motion.squared);
    }
    if (IsApartBy(RobotCorner(0))) return;
    for (std::size_t j = 0; j < 3; ++j) {
      CubicVector away;
      for (std::size_t k = 0; k < 3; ++k) {
        away[k] = Constant(b[j][k]) - motion.position[k];
      }
      for (std::size_t k = 0; k < 3; ++k) {
        z[j][k] = motion.rows[0][k] * away[0] + motion.rows[1][k] * away[1] +
                  motion.rows[2][k] * away[2];
      }
      Put(ObstacleCorner(j), Dot(m, z[j]) - Dot(m, r[0]) * motion.squared);
    }
    if (IsApartBy(ObstacleCorner(0))) return;
    for (std::size_t i = 0; i < 3; ++i) {
      const CubicVector edge = motion.Turned(e[i]);
      const CubicVector moment = motion.Turned(Cross(r[i], e[i]));
      const Point inward = Cross(m, e[i]);
      for (std::size_t j = 0; j < 3; ++j) {
        // f × (q − b) by its coordinates.
        CubicVector arm;
        for (std::size_t k = 0; k < 3; ++k) {
          const std::size_t u = After(k), v = After(u);
          arm[k] = f[j][u] * (motion.position[v] - Constant(b[j][v])) -
                   f[j][v] * (motion.position[u] - Constant(b[j][u]));
        }
        Put(Edges(i, j), Dot(f[j], moment) + edge[0] * arm[0] +
                             edge[1] * arm[1] + edge[2] * arm[2]);
        const Point side = Cross(n, f[j]);
        Put(RobotOver(i, j),
            Dot(side, x[i]) - Dot(side, b[j]) * motion.squared);
        Put(ObstacleOver(j, i),
            Dot(inward, z[j]) - Dot(inward, r[i]) * motion.squared);
      }
    }
  }

  bool has_area() const { return has_area_; }
  bool is_apart() const { return is_apart_; }

  // A time in the part at which they meet.
  std::optional<Rational> MeetingTime() {
    if (MeetAt([&](std::size_t k) { return cubics_[k].SignAt(from_); })) {
      return from_;
    }
    // Who is over what matters in one plane only: at a root of the corners'
    // conditions, unless one of those is 0 for all t.
    bool is_in_plane = false;
    for (std::size_t k = 0; k < 6; ++k) {
      is_in_plane = is_in_plane || cubics_[k].IsZero();
    }
    const std::size_t count = is_in_plane ? kCount : RobotOver(0, 0);
    for (std::size_t k = 0; k < count; ++k) {
      if (fixed_[k] != 0) continue;
      for (CubicRoot& root : RootsIn(cubics_[k], from_, to_)) {
        std::array<std::optional<int>, kCount> known;
        const auto sign = [&](std::size_t i) {
          if (fixed_[i] != 0) return fixed_[i];
          if (!known[i]) known[i] = SignAtRoot(cubics_[i], &root);
          return *known[i];
        };
        if (!MeetAt(sign)) continue;
        for (int step = 0; step < 50 && !root.IsExact(); ++step) root.Refine();
        return root.high;
      }
    }
    return std::nullopt;
  }

 private:
  static constexpr std::size_t kCount = 33;
  static std::size_t RobotCorner(std::size_t i) { return i; }
  static std::size_t ObstacleCorner(std::size_t j) { return 3 + j; }
  static std::size_t Edges(std::size_t i, std::size_t j) {
    return 6 + 3 * i + j;
  }
  // Corner i of the robot over edge j of the obstacle, and so on.
  static std::size_t RobotOver(std::size_t i, std::size_t j) {
    return 15 + 3 * i + j;
  }
  static std::size_t ObstacleOver(std::size_t j, std::size_t i) {
    return 24 + 3 * j + i;
  }

  void Put(std::size_t k, const RationalCubic& cubic) {
    cubics_[k] = cubic;
    int sign = 0;
    fixed_[k] = HasOneSign(cubic, from_, to_, &sign) ? sign : 0;
  }

  // Three corners on one side of a plane all the time.
  bool IsApartBy(std::size_t first) {
    is_apart_ = fixed_[first] != 0 && fixed_[first + 1] == fixed_[first] &&
                fixed_[first + 2] == fixed_[first];
    return is_apart_;
  }

  // By the signs, sign(k) of cubic k: does an edge of one meet the other?
  template <typename Sign>
  static bool MeetAt(const Sign& sign) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto end = [&](std::size_t k) {
        return sign(RobotCorner(k == 0 ? i : After(i)));
      };
      const auto line = [&](std::size_t j) { return sign(Edges(i, j)); };
      const auto over = [&](std::size_t k, std::size_t j) {
        return sign(RobotOver(k == 0 ? i : After(i), j));
      };
      // Of the obstacle's corner j, beside the edge.
      const auto plane = [&](std::size_t j) { return sign(ObstacleCorner(j)); };
      const auto beside = [&](std::size_t j) {
        return sign(ObstacleOver(j, i));
      };
      if (EdgeMeets(end, line, over, plane, beside)) return true;
    }
    for (std::size_t j = 0; j < 3; ++j) {
      const auto end = [&](std::size_t k) {
        return sign(ObstacleCorner(k == 0 ? j : After(j)));
      };
      const auto line = [&](std::size_t i) { return sign(Edges(i, j)); };
      const auto over = [&](std::size_t k, std::size_t i) {
        return sign(ObstacleOver(k == 0 ? j : After(j), i));
      };
      const auto plane = [&](std::size_t i) { return sign(RobotCorner(i)); };
      const auto beside = [&](std::size_t i) { return sign(RobotOver(i, j)); };
      if (EdgeMeets(end, line, over, plane, beside)) return true;
    }
    return false;
  }

  // An edge with ends 0 and 1 and a triangle, closed.
  template <typename End, typename Line, typename Over, typename Plane,
            typename Beside>
  static bool EdgeMeets(const End& end, const Line& line, const Over& over,
                        const Plane& plane, const Beside& beside) {
    const int p = end(0), q = end(1);
    if (p * q > 0) return false;
    if (p != 0 || q != 0) {
      // One point of the edge is in the plane.
      const int a = line(0), b = line(1), c = line(2);
      return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
    }
    for (std::size_t k = 0; k < 2; ++k) {
      if (over(k, 0) >= 0 && over(k, 1) >= 0 && over(k, 2) >= 0) return true;
    }
    for (std::size_t j = 0; j < 3; ++j) {
      const int u = over(0, j), v = over(1, j);
      if (u * v > 0 || (u == 0 && v == 0)) continue;
      // The triangle's edge j reaches from one side of the edge to the other:
      // in the other's plane, or from one side of that to the other.
      const int s = plane(j), t = plane(After(j));
      if (s != 0 || t != 0 ? s * t <= 0 : beside(j) * beside(After(j)) <= 0) {
        return true;
      }
    }
    return false;
  }

  std::array<RationalCubic, kCount> cubics_;
  std::array<int, kCount> fixed_{};  // the sign on all of the part, or 0
  Rational from_, to_;
  bool has_area_ = false, is_apart_ = false;
};

}  // namespace

ExactPairJudge::ExactPairJudge(const QuaternionMotion& motion) {
  auto impl = std::make_unique<Impl>();
  const Eigen::Quaterniond &a = motion.start().orientation,
                           &b = motion.end().orientation;
  const RationalCubic w = Line(a.w(), b.w()), x = Line(a.x(), b.x());
  const RationalCubic y = Line(a.y(), b.y()), z = Line(a.z(), b.z());
  const RationalCubic ww = w * w, xx = x * x, yy = y * y, zz = z * z;
  const Rational two(2);
  impl->rows[0] = {ww + xx - yy - zz, two * (x * y - w * z),
                   two * (x * z + w * y)};
  impl->rows[1] = {two * (x * y + w * z), ww - xx + yy - zz,
                   two * (y * z - w * x)};
  impl->rows[2] = {two * (x * z - w * y), two * (y * z + w * x),
                   ww - xx - yy + zz};
  impl->squared = ww + xx + yy + zz;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    impl->position[k] =
        Line(motion.start().position[axis], motion.end().position[axis]);
  }
  impl_ = std::move(impl);
}

ExactPairJudge::~ExactPairJudge() = default;

bool ExactPairJudge::Meet(const TriangleCorners& robot,
                          const TriangleCorners& obstacle, double from,
                          double to, double* time, bool* is_decided) const {
  PairConditions conditions(*impl_, ToRational(robot), ToRational(obstacle),
                            Rational(from), Rational(to));
  *is_decided = conditions.has_area();
  if (!*is_decided || conditions.is_apart()) return false;
  const std::optional<Rational> meeting = conditions.MeetingTime();
  if (meeting) *time = CGAL::to_double(*meeting);
  return meeting.has_value();
}

}  // namespace phongpd::internal
