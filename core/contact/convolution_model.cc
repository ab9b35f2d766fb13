// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact/convolution_model.h"

#include <utility>

#include "core/contact/convolution_model_data.h"
#include "core/mesh/finite.h"
#include "core/mesh/mesh_error.h"
#include "core/minkowski/operands/operand.h"
#include "core/stopwatch.h"

namespace phongpd {

using Eigen::Vector3d;

namespace {

void RequireNoShell(const ContactSpaceOptions& options) {
  if (!options.outer_shell_only) return;
  throw InputError(
      "outer_shell_only: expected false for a convolution model, which knows "
      "nothing of cavities, found true; build the contact space");
}

}  // namespace

ConvolutionModel::ConvolutionModel(const Solid& robot, const Solid& obstacle,
                                   const ContactSpaceOptions& options) {
  RequireNoShell(options);
  const Stopwatch stopwatch;
  auto data = std::make_shared<Data>(
      robot, obstacle, internal::WithNames(options, robot, obstacle));
  data->report.seconds = stopwatch.Seconds();
  data_ = std::move(data);
}

ConvolutionModel::ConvolutionModel(const TriangleMesh& robot,
                                   const TriangleMesh& obstacle,
                                   const ContactSpaceOptions& options) {
  RequireNoShell(options);
  const Stopwatch stopwatch;
  auto data = std::make_shared<Data>(robot, obstacle, options);
  data->report.seconds = stopwatch.Seconds();
  data_ = std::move(data);
}

bool ConvolutionModel::IsFree(const Vector3d& q) const {
  return data_->space.IsFree(q);
}

bool ConvolutionModel::IsFree(const Vector3d& a, const Vector3d& b) const {
  return data_->space.IsFree(a, b);
}

double ConvolutionModel::FirstContact(const Vector3d& a,
                                      const Vector3d& b) const {
  if (!IsFinite(b) || !IsFree(a)) return 0.0;
  return data_->space.FirstContact(a, b);
}

ConvolutionModel::Nearest ConvolutionModel::FindNearest(
    const Vector3d& q) const {
  if (!IsFinite(q)) return {};
  if (!IsFree(q)) return {q, 0.0};
  const internal::ConvolutionSpace::Nearest found = data_->space.FindNearest(q);
  return {found.point, found.distance};
}

double ConvolutionModel::Clearance(const Vector3d& a, const Vector3d& b,
                                   double limit) const {
  return IsFree(a, b) ? data_->space.Distance(a, b, limit) : 0.0;
}

std::vector<Separator> ConvolutionModel::FindSeparators(const Vector3d& a,
                                                        const Vector3d& b,
                                                        double radius,
                                                        double slack) const {
  std::vector<Separator> separators;
  for (const auto& facet : data_->space.FindSeparating(a, b, radius, slack)) {
    const Separator one = SeparatorOf(facet, a, b);
    if (one.distance <= radius) separators.push_back(one);
  }
  return separators;
}

const BoundingBox& ConvolutionModel::bounds() const { return data_->bounds; }
const ConvolutionReport& ConvolutionModel::report() const {
  return data_->report;
}
std::size_t ConvolutionModel::facets() const { return data_->space.facets(); }
TriangleMesh ConvolutionModel::Mesh() const { return data_->space.Mesh(); }

}  // namespace phongpd
