// SPDX-License-Identifier: GPL-3.0-or-later
// The queries of the library for the pages of the viewer: compiled to
// WebAssembly (wasm_module.cmake), called by probe.js.  All numbers are in the
// user's unit.
#include <cstdlib>
#include <memory>
#include <vector>

#include "core/contact/contact_space.h"
#include "core/projection/euclidean_metric.h"
#include "core/projection/penetration_tracker.h"
#include "core/projection/phong_metric.h"
#include "viewer/wasm/page_failure.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// What probe.js reads, a row a metric: status, inside, signed distance,
// contact, direction and gradient.
constexpr int kNumbers = 12;
constexpr int kMetrics = 3;  // Euclidean, Phong, sliding

struct Probed {
  explicit Probed(ContactSpace given) : space(std::move(given)) {}

  ContactSpace space;
  std::unique_ptr<PhongMetric> phong;
  std::unique_ptr<EuclideanMetric> euclidean;
  std::unique_ptr<PenetrationTracker> tracker;
  Branch branch;
  PenetrationTracker::State state;
};

std::vector<Probed>& All() {
  static std::vector<Probed> all;
  return all;
}

void Write(const Vector3d& v, double* out) {
  for (int k = 0; k < 3; ++k) out[k] = v[k];
}

void Write(const PenetrationResult& result, double* out) {
  out[0] = static_cast<double>(result.status);
  out[1] = result.inside ? 1.0 : 0.0;
  out[2] = result.signed_distance;
  Write(result.contact, out + 3);
  Write(result.direction, out + 6);
  Write(result.gradient, out + 9);
}

void Write(const TrackerResult& result, double* out) {
  out[0] = static_cast<double>(result.status);
  out[1] = result.inside ? 1.0 : 0.0;
  out[2] = -result.magnitude;
  Write(result.contact, out + 3);
  Write(result.magnitude > 0.0 ? Vector3d(result.pd / result.magnitude)
                               : Vector3d(Vector3d::Zero()),
        out + 6);
  Write(Vector3d::Zero(), out + 9);
}

}  // namespace
}  // namespace phongpd

// Takes the next contact space, of `vertices` × 3 coordinates and `triangles`
// × 3 indices, and frees both.
PAGE_EXPORT(add_space)
void AddSpace(double* coordinates, int vertices, int* indices, int triangles) {
  phongpd::ContactSpace::Parts parts;
  for (int v = 0; v < vertices; ++v) {
    parts.mesh.vertices.emplace_back(coordinates[3 * v], coordinates[3 * v + 1],
                                     coordinates[3 * v + 2]);
  }
  for (int t = 0; t < triangles; ++t) {
    parts.mesh.triangles.push_back(
        {indices[3 * t], indices[3 * t + 1], indices[3 * t + 2]});
  }
  std::free(coordinates);
  std::free(indices);
  phongpd::All().emplace_back(phongpd::ContactSpace(std::move(parts)));
}

// Makes the metrics: of spaces with one D, `length`, and a smoothing length
// that is a share of it.
PAGE_EXPORT(prepare) void Prepare(double length, double smoothing_length) {
  for (phongpd::Probed& probed : phongpd::All()) {
    const phongpd::ContactSpace space = probed.space.WithLength(length);
    phongpd::PhongMetricOptions options;
    options.field_options.smoothing_length = smoothing_length;
    probed.phong = std::make_unique<phongpd::PhongMetric>(space, options);
    probed.euclidean = std::make_unique<phongpd::EuclideanMetric>(space);
    probed.tracker = std::make_unique<phongpd::PenetrationTracker>(space);
    probed.branch = {};
    probed.state = {};
  }
}

// Forgets where the robot was: the next answers are cold.
PAGE_EXPORT(forget) void Forget() {
  for (phongpd::Probed& probed : phongpd::All()) {
    probed.branch = {};
    probed.state = {};
  }
}

// The answers of Euclidean and Phong depth at (x, y, z), wherever the robot
// was: two rows of kNumbers for each space in turn.  Valid until the next call.
PAGE_EXPORT(query_cold)
const double* QueryCold(double x, double y, double z) {
  static std::vector<double> answers;
  answers.assign(phongpd::All().size() * 2 * phongpd::kNumbers, 0.0);
  double* out = answers.data();
  const Eigen::Vector3d q(x, y, z);
  for (const phongpd::Probed& probed : phongpd::All()) {
    phongpd::Write(probed.euclidean->Query(q), out);
    phongpd::Write(probed.phong->Query(q, phongpd::Branch()),
                   out + phongpd::kNumbers);
    out += 2 * phongpd::kNumbers;
  }
  return answers.data();
}

// The answers at (x, y, z), which goes on from the point before: kMetrics rows
// of kNumbers for each space in turn.  Valid until the next call.
PAGE_EXPORT(query) const double* Query(double x, double y, double z) {
  static std::vector<double> answers;
  answers.assign(phongpd::All().size() * phongpd::kMetrics * phongpd::kNumbers,
                 0.0);
  double* out = answers.data();
  const Eigen::Vector3d q(x, y, z);
  for (phongpd::Probed& probed : phongpd::All()) {
    const auto phong = probed.phong->Query(q, probed.branch);
    probed.branch = phong.branch;
    phongpd::Write(probed.euclidean->Query(q), out);
    phongpd::Write(phong, out + phongpd::kNumbers);
    phongpd::Write(probed.tracker->Step(q, &probed.state),
                   out + 2 * phongpd::kNumbers);
    out += phongpd::kMetrics * phongpd::kNumbers;
  }
  return answers.data();
}
