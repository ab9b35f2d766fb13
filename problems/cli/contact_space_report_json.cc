// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/contact_space_report_json.h"

#include "core/mesh/counted.h"
#include "problems/output/output_files.h"
#include "problems/output/text.h"

namespace phongpd::cli {
namespace {

using Json = nlohmann::ordered_json;

Json ToJson(const RepairReport& repair) {
  return {{"duplicate_faces", repair.duplicate_faces},
          {"mirrored_faces", repair.mirrored_faces},
          {"degenerate_faces", repair.degenerate_faces},
          {"turned_faces", repair.turned_faces},
          {"joined_vertices", repair.joined_vertices},
          {"wrapped", repair.is_wrapped},
          {"wrap_reason", repair.wrap_reason},
          {"wrap_alpha", repair.wrap_alpha},
          {"wrap_bound", repair.wrap_bound},
          {"actions", repair.actions}};
}

Json ToJson(const Approximation& approximation) {
  Json steps = Json::array();
  for (const ApproximationStep& step : approximation.steps) {
    steps.push_back({{"operand", step.operand},
                     {"kind", ApproximationName(step.kind)},
                     {"bound", step.bound},
                     {"lower_bound", step.lower_bound},
                     {"bound_of", step.is_surface_bound ? "surface" : "solid"},
                     {"conservative", step.is_conservative},
                     {"triangles_before", step.triangles_before},
                     {"triangles_after", step.triangles_after},
                     {"dropped_cavities", step.dropped_cavities}});
  }
  return {{"kind", KindsOf(approximation)},
          {"bound", approximation.bound},
          {"conservative", approximation.is_conservative},
          {"steps", steps}};
}

}  // namespace

Json ToJson(const MeshReport& mesh, const RepairReport& repair,
            const std::string& file) {
  return {{"file", file},
          {"vertices", mesh.vertices},
          {"triangles", mesh.triangles},
          {"components", mesh.components},
          {"degenerate_triangles", mesh.degenerate_triangles},
          {"duplicate_vertices", mesh.duplicate_vertices},
          {"duplicate_triangles", mesh.duplicate_triangles},
          {"joined_vertices", mesh.joined_vertices},
          {"inverted_components", mesh.inverted_components},
          {"volume", mesh.volume},
          {"repair", ToJson(repair)},
          {"warnings", mesh.warnings}};
}

Json ToJson(const ContactSpaceReport& report) {
  Json seconds = Json::object();
  for (const auto& [stage, time] : report.seconds) seconds[stage] = time;
  return {{"triangles", report.triangles},
          {"vertices", report.vertices},
          {"closed", report.closed},
          {"manifold", report.manifold},
          {"components", report.components},
          {"genus", report.genus},
          {"cavities", report.cavities},
          {"volume", report.volume},
          {"self_intersections", report.self_intersections},
          {"degenerate_triangles", report.degenerate_triangles},
          {"triangle_quality",
           {{"measure", "4 sqrt(3) area / sum of squared edges"},
            {"worst", report.worst_quality},
            {"median", report.median_quality}}},
          {"from_cache", report.from_cache},
          {"seconds", seconds},
          {"peak_mib", report.peak_mib},
          {"method", report.method},
          {"predicted_cost",
           {{"meetings", report.predicted.meetings},
            {"arrangement_faces", report.predicted.arrangement_faces},
            {"seconds", report.predicted.seconds},
            {"mib", report.predicted.mib}}},
          {"approximation", ToJson(report.approximation)},
          {"convolution_triangles", report.convolution_triangles},
          {"arrangement_faces", report.arrangement_faces},
          {"cells", report.cells},
          {"judged_cells", report.judged_cells},
          {"canonical_frame", report.canonical_frame},
          {"grid_step", report.grid_step},
          {"warnings", report.warnings}};
}

std::string Summary(const std::string& file, const ContactSpaceReport& report) {
  TextStream text;
  double total = 0.0;
  for (const auto& [stage, time] : report.seconds) total += time;
  // Words that go beside a mesh on standard output name no file.
  if (!file.empty() && file != kStandardOutput) text << file << ": ";
  text << Counted(report.triangles, "triangle") << ", "
       << Counted(report.vertices, "vertex", "vertices") << ", "
       << (report.closed ? "closed, " : "NOT CLOSED, ")
       << (report.manifold ? "manifold, " : "NOT MANIFOLD, ")
       << Counted(report.components, "component") << ", genus " << report.genus
       << ", " << Counted(report.cavities, "cavity", "cavities") << ", volume "
       << FormatDouble(report.volume) << '\n'
       << "triangle quality: worst " << Rounded(report.worst_quality, 4)
       << ", median " << Rounded(report.median_quality, 4) << '\n'
       << (report.from_cache ? "from the cache; " : "");
  if (report.seconds.empty()) {
    text << "joined, ";  // of pieces, which other processes built
  } else {
    text << "built in " << Rounded(total, 4) << " s, peak "
         << Rounded(report.peak_mib, 4) << " MiB, ";
  }
  text << report.convolution_triangles << " convolution and "
       << report.arrangement_faces << " arrangement faces\n";
  return text.str();
}

}  // namespace phongpd::cli
