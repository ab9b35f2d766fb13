// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact/contact_space_piece.h"

#include <utility>

#include "core/contact/build_by_boxes.h"
#include "core/contact/build_stages.h"
#include "core/contact/contact_space_bytes.h"
#include "core/contact/piece_cover.h"
#include "core/contact/piece_data.h"
#include "core/mesh/mesh_error.h"
#include "core/minkowski/build_limits.h"
#include "core/minkowski/cells/cells.h"
#include "core/minkowski/operands/operand.h"
#include "core/minkowski/windows/window_plan.h"
#include "core/solid/solid.h"

namespace phongpd {
namespace {

using internal::OperandRole;
using internal::PlannedWindow;
using internal::SurfacePiece;
using internal::ToText;

void RequireOfPiece(bool is_met, const std::string& message) {
  if (!is_met) throw InputError(message);
}

// All that pieces of one build have in common, whatever its files are called
// and whatever it may cost.
internal::ContentHash DigestOf(const TriangleMesh& robot,
                               const TriangleMesh& obstacle,
                               ContactSpaceOptions options,
                               std::size_t facets_of_box) {
  options.max_seconds = options.max_mib = 0.0;
  options.robot_name = options.obstacle_name = "";
  return internal::HashContent(internal::KeyBytes(robot, obstacle, options) +
                               std::to_string(facets_of_box));
}

// The windows of one part: a run of them, of an even share of all facets.
std::vector<PlannedWindow> ShareOf(std::vector<PlannedWindow> windows,
                                   PieceNumber number) {
  double all = 0.0;
  for (const PlannedWindow& w : windows) {
    all += static_cast<double>(w.facets.size());
  }
  std::vector<PlannedWindow> share;
  double before = 0.0;
  for (PlannedWindow& w : windows) {
    const auto facets = static_cast<double>(w.facets.size());
    const double middle = (before + 0.5 * facets) / all * number.count;
    before += facets;
    if (static_cast<int>(middle) == number.index) {
      share.push_back(std::move(w));
    }
  }
  return share;
}

}  // namespace

PieceNumber ContactSpacePiece::number() const { return data_->number; }
std::size_t ContactSpacePiece::boxes() const { return data_->boxes.size(); }
std::size_t ContactSpacePiece::faces() const {
  std::size_t count = 0;
  for (const SurfacePiece& box : data_->boxes) count += box.faces.size();
  return count;
}

ContactSpacePiece internal::BuildPiece(const TriangleMesh& robot,
                                       const TriangleMesh& obstacle,
                                       const ContactSpaceOptions& options,
                                       PieceNumber number,
                                       std::size_t facets_of_box) {
  RequireOfPiece(
      0 <= number.index && number.index < number.count,
      "piece: expected i/n with 0 <= i < n, found " + ToText(number));
  RequireOfPiece(
      options.merge_coplanar,
      "merge_coplanar: expected true for a piece of a contact space, found "
      "false; build the whole");
  auto data = std::make_shared<ContactSpacePiece::Data>();
  ContactSpaceReport& report = data->report;
  StageClock clock(&report);
  BuildLimits limits(options);
  limits.ObserveCancellation();
  data->name = "piece " + ToText(number);
  data->build = DigestOf(robot, obstacle, options, facets_of_box);
  data->number = number;
  data->outer_shell_only = options.outer_shell_only;

  const Solid a = PrepareOperand(robot, OperandRole::kRobot, options, &report);
  const Solid b =
      PrepareOperand(obstacle, OperandRole::kObstacle, options, &report);
  const GridPair pair = PlaceOperands(a, b, LatticeDivisor::kGreatest, &report);
  DescribeGrid(pair, &report);
  data->frame = pair.frame;
  data->frame.robot.clear();
  data->frame.obstacle.clear();
  Convolution convolution =
      ReducedConvolution(pair.obstacle, pair.reflected_robot, &limits);
  report.convolution_triangles = convolution.facets.size();
  PlaneGroups groups = GroupAndName(&convolution);
  const OccupiedRegion occupied(pair.obstacle, pair.reflected_robot,
                                convolution, limits);
  DropOccupied(occupied, &convolution, &groups);
  clock.Finish("convolution");
  const std::vector<PlannedWindow> windows =
      ShareOf(PlanWindows(convolution, occupied, facets_of_box), number);
  const SolidCollision judge(pair.obstacle, pair.reflected_robot);
  data->boxes = ArrangeBoxes(windows, convolution, judge, limits);
  clock.Finish("boxes");
  return ContactSpacePiece(std::move(data));
}

ContactSpacePiece BuildContactSpacePiece(const TriangleMesh& robot,
                                         const TriangleMesh& obstacle,
                                         const ContactSpaceOptions& options,
                                         PieceNumber number) {
  return internal::BuildPiece(robot, obstacle, options, number,
                              internal::kFacetsOfBox);
}

ContactSpace JoinContactSpace(const std::vector<ContactSpacePiece>& pieces) {
  const auto ordered = internal::InOrder(pieces);
  const ContactSpacePiece::Data& first = *ordered.front();
  std::vector<SurfacePiece> boxes;
  for (const ContactSpacePiece::Data* data : ordered) {
    boxes.insert(boxes.end(), data->boxes.begin(), data->boxes.end());
  }
  ContactSpace::Parts out;
  ContactSpaceReport& report = out.report;
  report = first.report;
  internal::StageClock clock(&report);
  try {
    internal::WriteJoinedSurface(boxes, first.outer_shell_only, first.frame,
                                 nullptr, &clock, &out);
    internal::FinishReport(&clock, &out);
  } catch (const internal::SurfaceError&) {
    throw InputError(
        first.name +
        (ordered.size() == 1
             ? ""
             : " and " + std::to_string(ordered.size() - 1) + " more") +
        ": expected pieces that fit together, found borders that do not (cells "
        "beside them too thin to be judged, or other contents than were "
        "written); write them anew by phongpd contact-space --piece, or build "
        "the whole");
  }
  report.seconds.clear();
  report.peak_mib = 0.0;
  return ContactSpace(std::move(out), first.name);
}

}  // namespace phongpd
