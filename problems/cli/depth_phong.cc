// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/depth_phong.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/mesh/counted.h"
#include "problems/output/json_text.h"
#include "problems/output/text.h"
#include "viewer/page_numbers.h"

namespace phongpd::cli {
namespace {

double DepthOf(const WindowPhongResult& result) {
  return std::max(0.0, -result.answer.signed_distance);
}

}  // namespace

const char* const DepthPhong::kColumns =
    ",phong_depth,phong_direction_x,phong_direction_y,phong_direction_z,"
    "phong_contact_x,phong_contact_y,phong_contact_z,phong_status,phong_level";

DepthPhong::DepthPhong(const std::string& smoothing_length,
                       const TriangleMesh& a, const TriangleMesh& b,
                       const ContactSpaceOptions& options)
    : length_(ParseLength(smoothing_length, "--smoothing-length")),
      a_(a),
      b_(b),
      options_(options) {}

WindowPhongResult DepthPhong::At(const RobotPose& pose) {
  if (!phong_ || orientation_.coeffs() != pose.orientation.coeffs()) {
    orientation_ = pose.orientation;
    const bool is_turned =
        orientation_.coeffs() != Eigen::Quaterniond::Identity().coeffs();
    const ConvolutionModel model(
        is_turned ? Rotated(a_, orientation_.toRotationMatrix()) : a_, b_,
        options_);
    const double diagonal = model.bounds().Diagonal();
    RequireLength(length_, LengthRange::kFromZero, diagonal,
                  "--smoothing-length");
    resolved_ = length_.Resolve(diagonal);
    PhongMetricOptions options;
    options.field_options.smoothing_length = resolved_.share;
    phong_.emplace(model, options);
  }
  return phong_->At(pose.position);
}

nlohmann::ordered_json DepthPhong::AsJson(
    const WindowPhongResult& result) const {
  return {{"smoothing_length",
           {{"unit", resolved_.unit}, {"share", resolved_.share}}},
          {"status", StatusName(result.answer.status)},
          {"depth", DepthOf(result)},
          {"direction", internal::PointJson(result.answer.direction)},
          {"contact", internal::PointJson(result.answer.contact)},
          {"level", ToString(result.level)},
          {"arranged_faces", result.arranged_faces},
          {"windows", result.windows}};
}

std::string DepthPhong::AsCells(const WindowPhongResult& result) {
  return ',' + FormatDouble(DepthOf(result)) + ',' +
         FormatPoint(result.answer.direction) + ',' +
         FormatPoint(result.answer.contact) + ',' +
         StatusName(result.answer.status) + ',' + ToString(result.level);
}

std::string DepthPhong::AsSentence(const WindowPhongResult& result) const {
  if (!result.answer.inside) return "";
  return "PhongPD, ℓ = " + length_.Text() + ": depth " +
         FormatDouble(DepthOf(result)) + ", out along " +
         FormatPoint(result.answer.direction) + ", level " +
         ToString(result.level) + ", " +
         Counted(result.arranged_faces, "face") + " arranged" +
         (result.answer.status == QueryStatus::kOk
              ? ""
              : std::string(", ") + StatusName(result.answer.status)) +
         '\n';
}

}  // namespace phongpd::cli
