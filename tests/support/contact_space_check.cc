// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/contact_space_check.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <memory>
#include <optional>
#include <random>
#include <sstream>

#include "constraints/oracle/collision_oracle.h"
#include "core/bvh/triangle_bvh.h"
#include "core/contact/contact_space.h"
#include "core/solid/self_intersection.h"
#include "problems/shapes/random_solids.h"
#include "problems/shapes/random_vector.h"
#include "tests/support/self_overlap.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// Largest displacement of a solid's surface by the builder's grid, in steps:
// half a step in each coordinate of both operands, rounded up.
constexpr double kGridSteps = 4.0;
constexpr double kUlps = 16 * std::numeric_limits<double>::epsilon();

double LargestCoordinate(const TriangleMesh& mesh) {
  const BoundingBox box = ComputeBounds(mesh);
  return box.min.cwiseAbs().cwiseMax(box.max.cwiseAbs()).maxCoeff();
}

// Exact: do the solids meet?  Slow; asked where the oracle disagrees.
bool MeetExactly(const TriangleMesh& robot, const TriangleMesh& obstacle) {
  if (internal::Intersect(robot, obstacle)) return true;
  const auto holds_part = [](const TriangleMesh& outer,
                             const TriangleMesh& inner) {
    int count = 0, parts = 0;
    const std::vector<int> label = LabelComponents(inner, &count);
    const std::vector<int> part = LabelComponents(outer, &parts);
    for (int c = 0; c < count; ++c) {
      const auto at = std::find(label.begin(), label.end(), c) - label.begin();
      const Vector3d& p = inner.vertices[inner.triangles[at][0]];
      int winding = 0;
      for (int k = 0; k < parts; ++k) {
        TriangleMesh body{outer.vertices, {}};
        for (std::size_t t = 0; t < part.size(); ++t) {
          if (part[t] == k) body.triangles.push_back(outer.triangles[t]);
        }
        if (TriangleBvh(body).Locate(p) != Location::kInside) continue;
        winding += SignedVolume(body) > 0 ? 1 : -1;
      }
      if (winding > 0) return true;
    }
    return false;
  };
  return holds_part(robot, obstacle) || holds_part(obstacle, robot);
}

class Checker {
 public:
  Checker(const SolidPair& pair, const CheckOptions& options)
      : pair_(pair), options_(options), random_(options.seed) {}

  CheckResult Run() {
    space_ = Build(pair_.robot, pair_.obstacle, "");
    if (!Passed()) return result_;
    result_.triangles = space_->report().triangles;
    CheckExpectations();
    CheckSelfIntersections();
    CheckPoints();
    if (options_.variants) CheckVariants();
    return result_;
  }

 private:
  bool Passed() const { return result_.failures.empty(); }

  template <typename... Parts>
  void Fail(const Parts&... parts) {
    std::ostringstream text;
    text.precision(17);
    (text << ... << parts);
    result_.failures.push_back(text.str());
  }

  // Nothing if it throws, which is a failure.
  std::optional<ContactSpace> Build(const TriangleMesh& robot,
                                    const TriangleMesh& obstacle,
                                    const std::string& which) {
    std::optional<ContactSpace> built;
    try {
      built = BuildContactSpace(robot, obstacle);
    } catch (const std::exception& error) {
      Fail(which, "throws: ", error.what());
      return built;
    }
    const ContactSpace& space = *built;
    double seconds = 0.0;
    for (const auto& stage : space.report().seconds) seconds += stage.second;
    result_.seconds = std::max(result_.seconds, seconds);
    if (!space.report().closed) Fail(which, "not closed");
    if (!space.report().manifold) Fail(which, "not manifold");
    if (space.mesh().triangles.empty()) Fail(which, "empty");
    return built;
  }

  // What a volume may change by when the solid's surface moves by the grid.
  double VolumeTolerance(const ContactSpace& space) const {
    return kGridSteps * 4 * space.report().grid_step *
               SurfaceArea(space.mesh()) +
           1e-12 * std::abs(space.report().volume);
  }

  void CheckExpectations() {
    const ContactSpaceReport& report = space_->report();
    const auto expect = [&](const char* what, const std::optional<int>& value,
                            int found) {
      if (value && *value != found) {
        Fail(what, " must be ", *value, ", found ", found);
      }
    };
    expect("components", pair_.components, report.components);
    expect("genus", pair_.genus, report.genus);
    expect("cavities", pair_.cavities, report.cavities);
    const double moved =
        4 * pair_.perturbation *
        (LargestCoordinate(pair_.robot) + LargestCoordinate(pair_.obstacle));
    const double tolerance =
        pair_.is_exact
            ? 0.0
            : VolumeTolerance(*space_) + moved * SurfaceArea(space_->mesh());
    if (pair_.volume && std::abs(report.volume - *pair_.volume) > tolerance) {
      Fail("volume must be ", *pair_.volume, ", found ", report.volume);
    }
  }

  void CheckSelfIntersections() {
    const TriangleMesh& mesh = space_->mesh();
    if (pair_.is_exact && space_->report().self_intersections > 0) {
      Fail(space_->report().self_intersections, " self-intersections");
    }
    // Slivers as thin as the grid have no reliable direction to separate in,
    // so crossings are told from rounding at the grid's size only.
    const double rounding =
        kGridSteps * space_->report().grid_step +
        kUlps * (LargestCoordinate(mesh) + LargestCoordinate(pair_.robot) +
                 LargestCoordinate(pair_.obstacle));
    result_.rounded_contacts = space_->report().self_intersections;
    result_.deepest_overlap = DeepestSelfOverlap(mesh) / rounding;
    if (result_.deepest_overlap > 1.0) {
      Fail("triangles overlap by ", result_.deepest_overlap * rounding,
           ", more than the grid explains (", rounding, ")");
    }
  }

  // Does the surface agree with the oracle about q?  `is_outside` is what the
  // way q was made says, if anything.
  void CheckPoint(const Vector3d& q, const bool* is_outside) {
    const double margin = kGridSteps * space_->report().grid_step +
                          kUlps * (LargestCoordinate(pair_.robot) +
                                   LargestCoordinate(pair_.obstacle));
    if (space_->bvh().FindClosest(q).distance < margin) {
      ++result_.undecided;
      return;
    }
    const bool inside = space_->bvh().Locate(q) == Location::kInside;
    if (is_outside != nullptr && *is_outside == inside) ++result_.crevices;
    if (oracle_->Collides(q) == inside) return;
    if (MeetExactly(Translated(pair_.robot, q), pair_.obstacle) == inside) {
      ++result_.oracle_errors;
      return;
    }
    // A gap thinner than the grid may open or close.
    for (int k = 0; k < 6; ++k) {
      Vector3d beside = q;
      beside[k % 3] += k < 3 ? margin : -margin;
      if (MeetExactly(Translated(pair_.robot, beside), pair_.obstacle) ==
          inside) {
        ++result_.undecided;
        return;
      }
    }
    Fail("q = (", q.x(), ", ", q.y(), ", ", q.z(), ") must be ",
         inside ? "free" : "hit", ", is not");
  }

  void CheckPoints() {
    oracle_ = std::make_unique<CollisionOracle>(
        MakeSolid(pair_.robot, "robot"), MakeSolid(pair_.obstacle, "obstacle"));
    const BoundingBox box = ComputeBounds(space_->mesh());
    for (int i = 0; i < options_.points; ++i) {
      CheckPoint(RandomPoint(box, &random_), nullptr);
    }
    for (const double step : {1e-6, -1e-6, 1e-9, -1e-9}) {
      const bool is_outside = step > 0.0;
      for (int i = 0; i < options_.points; ++i) {
        const SurfacePoint at = RandomSurfacePoint(space_->mesh(), &random_);
        CheckPoint(at.position + step * box.Diagonal() * at.normal,
                   &is_outside);
      }
    }
  }

  // Compares a variant, mapped back by v ↦ (v − offset) / factor.
  void Compare(const std::optional<ContactSpace>& built, double factor,
               const Vector3d& offset, const std::string& which) {
    if (!built) return;
    const ContactSpace& variant = *built;
    const double volume =
        variant.report().volume / std::pow(std::abs(factor), 3);
    const double reach = (LargestCoordinate(pair_.robot) +
                          LargestCoordinate(pair_.obstacle) + offset.norm());
    const double length =
        kGridSteps * (space_->report().grid_step +
                      variant.report().grid_step / std::abs(factor)) +
        kUlps * reach;
    const double tolerance =
        2 * VolumeTolerance(*space_) + length * SurfaceArea(space_->mesh());
    if (std::abs(volume - space_->report().volume) > tolerance) {
      Fail(which, "volume must be ", space_->report().volume, ", found ",
           volume);
    }
    const BoundingBox a = ComputeBounds(space_->mesh());
    const BoundingBox b = ComputeBounds(variant.mesh());
    const Vector3d p = (b.min - offset) / factor, q = (b.max - offset) / factor;
    const double error = std::max((p.cwiseMin(q) - a.min).norm(),
                                  (p.cwiseMax(q) - a.max).norm());
    if (error > 2 * length) Fail(which, "bounding box is off by ", error);
  }

  void CheckVariants() {
    const TriangleMesh &a = pair_.robot, &b = pair_.obstacle;
    Compare(Build(b, a, "swapped: "), -1.0, Vector3d::Zero(), "swapped: ");

    const double far = 100 * ComputeBounds(space_->mesh()).Diagonal();
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    const auto offset = [&]() -> Vector3d {
      return far * RandomVector(&unit, &random_);
    };
    const Vector3d robot = offset(), obstacle = offset();
    Compare(Build(Translated(a, robot), Translated(b, obstacle), "moved: "),
            1.0, obstacle - robot, "moved: ");

    const double factor = std::pow(10.0, 9 * unit(random_));
    std::ostringstream which;
    which << "scaled by " << factor << ": ";
    Compare(Build(Scaled(a, factor), Scaled(b, factor), which.str()), factor,
            Vector3d::Zero(), which.str());
  }

  const SolidPair& pair_;
  const CheckOptions& options_;
  std::mt19937_64 random_;
  std::optional<ContactSpace> space_;
  std::unique_ptr<CollisionOracle> oracle_;
  CheckResult result_;
};

}  // namespace

CheckResult CheckContactSpace(const SolidPair& pair,
                              const CheckOptions& options) {
  return Checker(pair, options).Run();
}

}  // namespace phongpd
