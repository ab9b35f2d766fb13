// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/depth_beside.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/mesh/counted.h"
#include "problems/cli/depth_row.h"
#include "problems/output/json_text.h"
#include "problems/output/text.h"
#include "viewer/page_numbers.h"

namespace phongpd::cli {
namespace {

double DepthOf(const WindowResult& result) {
  return std::max(0.0, -result.answer.signed_distance);
}

}  // namespace

DepthBeside::DepthBeside(MetricKind metric, const std::string& smoothing_length,
                         const TriangleMesh& a, const TriangleMesh& b,
                         const ContactSpaceOptions& options)
    : a_(a), b_(b), options_(options) {
  const std::string what = "--smoothing-length";
  spec_.metric = metric;
  if (!smoothing_length.empty()) {
    spec_.smoothing_length = ParseLength(smoothing_length, what);
  }
  const double number = spec_.smoothing_length.value();
  if (spec_.smoothing_length.is_share() && number > 1.0) {
    const std::string text = FormatDouble(number);
    throw InputError(what +
                     ": expected at most 1 (the diagonal D of the contact "
                     "space), found " +
                     text + "; did you mean " + text + "unit?");
  }
  RequireLength(spec_.smoothing_length, LengthRangeOf(metric), 0.0, what);
}

WindowResult DepthBeside::At(const RobotPose& pose) {
  const bool is_begun = phong_ || smoothed_;
  if (!is_begun || orientation_.coeffs() != pose.orientation.coeffs()) {
    orientation_ = pose.orientation;
    const bool is_turned =
        orientation_.coeffs() != Eigen::Quaterniond::Identity().coeffs();
    const ConvolutionModel model(
        is_turned ? Rotated(a_, orientation_.toRotationMatrix()) : a_, b_,
        options_);
    const double diagonal = model.bounds().Diagonal();
    RequireLength(spec_.smoothing_length, LengthRangeOf(spec_.metric), diagonal,
                  "--smoothing-length");
    resolved_ = spec_.smoothing_length.Resolve(diagonal);
    const SignedMetricOptions options = spec_.Options(diagonal);
    if (spec_.metric == MetricKind::kPhong) {
      phong_.emplace(model, options.phong);
    } else {
      smoothed_.emplace(model, resolved_.share,
                        spec_.metric == MetricKind::kSmoothed
                            ? SmoothedAt::kPosition
                            : SmoothedAt::kContact);
    }
  }
  return phong_ ? phong_->At(pose.position) : smoothed_->At(pose.position);
}

const char* DepthBeside::Key() const {
  return spec_.metric == MetricKind::kPhong ? "phong" : "smoothed";
}

std::string DepthBeside::Columns() const {
  std::string columns;
  for (const char* name :
       {"depth", "direction_x", "direction_y", "direction_z", "contact_x",
        "contact_y", "contact_z", "status", "level"}) {
    columns += std::string(",") + Key() + '_' + name;
  }
  return columns;
}

nlohmann::ordered_json DepthBeside::AsJson(const WindowResult& result) const {
  nlohmann::ordered_json row;
  if (spec_.metric != MetricKind::kPhong) {
    row["metric"] = ToString(spec_.metric);
  }
  row.update({{"smoothing_length",
               {{"unit", resolved_.unit}, {"share", resolved_.share}}},
              {"status", ToString(result.answer.status)},
              {"depth", DepthOf(result)},
              {"direction", internal::PointJson(result.answer.direction)},
              {"contact", internal::PointJson(result.answer.contact)},
              {"level", ToString(result.level)},
              {"arranged_faces", result.arranged_faces},
              {"windows", result.windows}});
  return row;
}

std::string DepthBeside::AsCells(const WindowResult& result) {
  return ',' + FormatDouble(DepthOf(result)) + ',' +
         FormatPoint(result.answer.direction) + ',' +
         FormatPoint(result.answer.contact) + ',' +
         ToString(result.answer.status) + ',' + ToString(result.level);
}

std::string DepthBeside::AsSentence(const WindowResult& result) const {
  if (!result.answer.inside) return "";
  const std::string name = phong_ ? "PhongPD" : ToString(spec_.metric);
  return name + ", ℓ = " + spec_.smoothing_length.Text() + ": depth " +
         Rounded(DepthOf(result), kDigits) + ", out along " +
         RoundedPoint(result.answer.direction) + ", level " +
         ToString(result.level) + ", " +
         Counted(result.arranged_faces, "face") + " arranged" +
         (result.answer.status == QueryStatus::kOk
              ? ""
              : std::string(", ") + ToString(result.answer.status)) +
         '\n';
}

}  // namespace phongpd::cli
