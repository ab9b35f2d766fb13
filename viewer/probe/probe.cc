// SPDX-License-Identifier: GPL-3.0-or-later
// The queries of the library for the pages of the viewer: compiled to
// WebAssembly (probe.cmake), called by probe.js.  All numbers are in the user's
// unit.  What a page hands over has passed the checks of the program that wrote
// it; an exception stops the module, and the page says so.
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <memory>
#include <vector>

#include "core/contact/contact_space.h"
#include "core/projection/euclidean_metric.h"
#include "core/projection/penetration_tracker.h"
#include "core/projection/phong_metric.h"

// Of the page: says why nothing goes on, and does not return.
extern "C" __attribute__((import_module("page"), import_name("fail"))) void
FailPage(const char* why);

// What the library throws all comes from std::exception.  There is no
// unwinding here: the page hears the reason and drops the module.
extern "C" void* __cxa_allocate_exception(std::size_t size) {
  return std::malloc(size);
}
extern "C" [[noreturn]] void __cxa_throw(void* thrown, void*, void*) {
  FailPage(static_cast<std::exception*>(thrown)->what());
  __builtin_trap();
}

// Debian's compiler run-time for WebAssembly was built to look at these.
extern "C" std::uintptr_t __stack_chk_guard;
std::uintptr_t __stack_chk_guard = 0x5bd1e995;
extern "C" [[noreturn]] void __stack_chk_fail() { __builtin_trap(); }

#define PROBE_EXPORT(name) extern "C" __attribute__((export_name(#name), used))

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

PROBE_EXPORT(allocate) void* Allocate(int bytes) { return std::malloc(bytes); }

// Takes the next contact space, of `vertices` × 3 coordinates and `triangles`
// × 3 indices, and frees both.
PROBE_EXPORT(add_space)
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
PROBE_EXPORT(prepare) void Prepare(double length, double smoothing_length) {
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
PROBE_EXPORT(forget) void Forget() {
  for (phongpd::Probed& probed : phongpd::All()) {
    probed.branch = {};
    probed.state = {};
  }
}

// The answers of Euclidean and Phong depth at (x, y, z), wherever the robot
// was: two rows of kNumbers for each space in turn.  Valid until the next call.
PROBE_EXPORT(query_cold)
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
PROBE_EXPORT(query) const double* Query(double x, double y, double z) {
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
