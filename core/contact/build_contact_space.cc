// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/contact/build_by_boxes.h"
#include "core/contact/build_prediction.h"
#include "core/contact/build_stages.h"
#include "core/contact/build_switches.h"
#include "core/contact/contact_space.h"
#include "core/minkowski/arrangement/facet_intersections.h"
#include "core/minkowski/arrangement/plane_arrangement.h"
#include "core/minkowski/arrangement/plane_groups.h"
#include "core/minkowski/build_limits.h"
#include "core/minkowski/build_stop.h"
#include "core/minkowski/cells/cells.h"
#include "core/minkowski/cells/radial_edges.h"
#include "core/minkowski/cells/surface_assembly.h"
#include "core/minkowski/convolution/convolution.h"
#include "core/minkowski/operands/grid_pair.h"
#include "core/minkowski/operands/operand.h"
#include "core/minkowski/operands/solid_collision.h"
#include "core/solid/solid.h"

namespace phongpd {
namespace {

using internal::Boxes;
using internal::BuildSwitches;
using internal::Culling;
using internal::CullingReport;
using internal::OperandRole;

// One build, a stage after the other; each reads what those before it left.
class Builder {
 public:
  Builder(const ContactSpaceOptions& options, const BuildSwitches& switches)
      : options_(options), switches_(switches), limits_(options) {
    limits_.ObserveCancellation();
  }

  const CullingReport& culled() const { return culled_; }

  // Operands are Solids or meshes.
  template <typename Operand>
  ContactSpace Build(const Operand& robot, const Operand& obstacle) {
    a_ = internal::PrepareOperand(robot, OperandRole::kRobot, options_,
                                  &report_);
    limits_.CheckNow("check");
    b_ = internal::PrepareOperand(obstacle, OperandRole::kObstacle, options_,
                                  &report_);
    limits_.CheckNow("check");
    clock_.Finish("check");
    Convolve();
    Sample();
    if (IsByBoxes()) {
      BuildByBoxes();
    } else {
      BuildWhole();
    }
    internal::FinishReport(&clock_, &out_);
    return ContactSpace(std::move(out_));
  }

 private:
  void Convolve() {
    pair_ = internal::PlaceOperands(
        *a_, *b_, internal::LatticeDivisor::kGreatest, &report_);
    limits_.CheckNow("grid");
    internal::DescribeGrid(pair_, &report_);
    convolution_ = internal::ReducedConvolution(
        pair_.obstacle, pair_.reflected_robot, &limits_);
    report_.convolution_triangles = convolution_.facets.size();
    clock_.Finish("convolution");
    groups_ = internal::GroupAndName(&convolution_);
    limits_.CheckNow("prediction");
  }

  // Expects cuts, and leaves out what is occupied where that pays.
  void Sample() {
    index_ = std::make_unique<internal::FacetIndex>(convolution_);
    limits_.CheckNow("prediction");
    sample_.triangles =
        a_->mesh().triangles.size() + b_->mesh().triangles.size();
    sample_.facets = convolution_.facets.size();
    sample_.cuts =
        internal::ExpectCuts(convolution_, groups_, *index_, limits_);
    culled_.facets = sample_.facets;
    culled_.meetings = sample_.cuts.meetings;
    if (switches_.culling == Culling::kAlways ||
        (switches_.culling == Culling::kWhereItPays &&
         internal::IsWorthCulling(sample_.cuts, sample_.facets))) {
      Cull();
    }
    culled_.meetings_left = sample_.cuts.meetings;
  }

  void Cull() {
    occupied_ = internal::OccupiedRegion(pair_.obstacle, pair_.reflected_robot,
                                         convolution_, limits_);
    internal::DropOccupied(occupied_, &convolution_, &groups_);
    index_ = std::make_unique<internal::FacetIndex>(convolution_);
    sample_.cuts = internal::ExpectCuts(convolution_, groups_, *index_, limits_,
                                        &occupied_);
    sample_.is_culled = culled_.was_tried = !occupied_.IsEmpty();
    culled_.dropped = culled_.facets - convolution_.facets.size();
  }

  // Boxes where the memory of one arrangement is not there; see
  // ContactSpaceOptions.  Throws BuildRefusal where not for them either.
  bool IsByBoxes() {
    report_.predicted = internal::PredictWhole(sample_);
    const PredictedCost boxes = internal::PredictByBoxes(sample_);
    const bool is_by_boxes =
        options_.merge_coplanar && (switches_.boxes == Boxes::kAlways ||
                                    (limits_.IsAboveMemory(report_.predicted) &&
                                     boxes.mib < report_.predicted.mib));
    if (is_by_boxes) report_.predicted = boxes;
    limits_.Predict(report_.predicted);
    clock_.Finish("prediction");
    return is_by_boxes;
  }

  void BuildByBoxes() {
    index_.reset();
    std::vector<internal::SurfacePiece> boxes;
    {
      const std::vector<internal::PlannedWindow> plan = internal::PlanWindows(
          convolution_, occupied_,
          switches_.facets_of_box > 0 ? switches_.facets_of_box
                                      : internal::kFacetsOfBox);
      report_.method += " in " + std::to_string(plan.size()) + " boxes";
      const internal::SolidCollision judge(pair_.obstacle,
                                           pair_.reflected_robot);
      boxes = internal::ArrangeBoxes(plan, convolution_, judge, limits_);
    }
    clock_.Finish("boxes");
    convolution_ = {};
    groups_ = {};
    try {
      internal::WriteJoinedSurface(boxes, options_.outer_shell_only,
                                   pair_.frame, &limits_, &clock_, &out_);
    } catch (const internal::LeakError&) {
      throw BuildRefusal(
          options_.robot_name + " and " + options_.obstacle_name +
          ": expected boxes that fit together, found cells beside their "
          "borders too thin to be judged; raise max_mib, so that it is built "
          "in one");
    }
  }

  void BuildWhole() {
    internal::ExactPoints points;
    const internal::Arrangement arrangement = Arrange(&points);
    report_.arrangement_faces = arrangement.faces.size();
    clock_.Finish("arrangement");

    const internal::RadialEdges radial =
        internal::SortAroundEdges(convolution_, arrangement, points, &limits_);
    limits_.CheckNow("cells");
    const internal::FreeCells cells = FindCells(arrangement, radial, points);
    report_.cells = static_cast<std::size_t>(cells.cells);
    report_.judged_cells = static_cast<std::size_t>(cells.judged);
    internal::ReportCavities(cells.cavities, options_.outer_shell_only,
                             &report_);
    clock_.Finish("cells");

    limits_.CheckNow("surface");
    const internal::PatchSurface patches = internal::AssembleSurface(
        arrangement, groups_, radial, cells,
        {options_.merge_coplanar, options_.outer_shell_only, 1, &limits_},
        &points);
    limits_.CheckNow("surface");
    internal::WriteSurface(patches, convolution_, groups_, points, pair_.frame,
                           &limits_, &clock_, &out_);
  }

  // Leaves no index: the arrangement is what takes memory.
  internal::Arrangement Arrange(internal::ExactPoints* points) {
    const internal::FacetIntersections intersections =
        internal::IntersectFacets(convolution_, groups_, *index_, limits_,
                                  points, &occupied_);
    clock_.Finish("intersection");
    internal::Arrangement arrangement = internal::ArrangePlanes(
        convolution_, groups_, intersections, limits_, points);
    index_.reset();
    return arrangement;
  }

  internal::FreeCells FindCells(const internal::Arrangement& arrangement,
                                const internal::RadialEdges& radial,
                                const internal::ExactPoints& points) {
    const internal::SolidCollision judge(pair_.obstacle, pair_.reflected_robot);
    try {
      return internal::FindFreeCells(convolution_, arrangement, radial, points,
                                     judge, limits_);
    } catch (const internal::LeakError&) {
      if (pair_.IsRounded()) {
        internal::RefuseLostFacets(pair_.obstacle, *b_, pair_.reflected_robot,
                                   *a_, pair_.frame.step);
      }
      throw;
    }
  }

  const ContactSpaceOptions& options_;
  BuildSwitches switches_;
  CullingReport culled_;
  internal::BuildLimits limits_;
  ContactSpace::Parts out_;
  ContactSpaceReport& report_ = out_.report;
  internal::StageClock clock_{&report_};

  std::optional<Solid> a_, b_;  // robot and obstacle as they are built
  internal::GridPair pair_;
  internal::Convolution convolution_;
  internal::PlaneGroups groups_;
  std::unique_ptr<internal::FacetIndex> index_;
  internal::OccupiedRegion occupied_;
  internal::BuildSample sample_;
};

}  // namespace

ContactSpace BuildContactSpace(const Solid& robot, const Solid& obstacle,
                               const ContactSpaceOptions& options) {
  const ContactSpaceOptions named =
      internal::WithNames(options, robot, obstacle);
  return Builder(named, {}).Build(robot, obstacle);
}

ContactSpace BuildContactSpace(const TriangleMesh& robot,
                               const TriangleMesh& obstacle,
                               const ContactSpaceOptions& options) {
  return Builder(options, {}).Build(robot, obstacle);
}

ContactSpace internal::BuildSwitched(const TriangleMesh& robot,
                                     const TriangleMesh& obstacle,
                                     const ContactSpaceOptions& options,
                                     const BuildSwitches& switches,
                                     CullingReport* report) {
  Builder builder(options, switches);
  ContactSpace space = builder.Build(robot, obstacle);
  if (report != nullptr) *report = builder.culled();
  return space;
}

}  // namespace phongpd
