// SPDX-License-Identifier: GPL-3.0-or-later
// What sweeps over many machines ask of the library: rows of comparisons, what
// can be told of them before one is run, and to leave other workers their
// cores.
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/nearest_name.h"
#include "planners/retraction/retraction_names.h"
#include "planners/world/planner_id.h"
#include "problems/output/json_text.h"
#include "problems/scenes/kept_world.h"
#include "problems/scenes/scene_source.h"
#include "problems/studies/comparison_run.h"
#include "problems/studies/study_metrics.h"
#include "python/src/bindings.h"
#include "python/src/interruptible.h"
#include "python/src/workshop.h"

namespace phongpd::python {
namespace {

namespace nb = nanobind;

// Rows of one scene or family; the world is kept while the solids stay.
class Comparison {
 public:
  Comparison(const std::string& scene, double max_mib, bool cache)
      : source_(scene), worlds_(FolderOf(cache), {0.0, max_mib}) {}

  std::string Row(std::uint64_t seed, const std::string& protocol,
                  const std::string& metric) {
    return Interruptible([&] {
      const std::lock_guard<std::mutex> lock(one_at_a_time_);
      if (seed_ != seed) {
        seed_.reset();
        loaded_ = source_.Load(seed);
        seed_ = seed;
      }
      nlohmann::ordered_json row = RunComparison(
          loaded_, worlds_.Of(loaded_),
          {seed, FindProtocol(protocol), ParseStudyMetric(metric, "metrics"),
           source_.is_family()});
      row.erase("path");
      return JsonText(row);
    });
  }

 private:
  SceneSource source_;
  KeptWorld worlds_;
  Scene loaded_;
  std::optional<std::uint64_t> seed_;  // that it was loaded with
  std::mutex one_at_a_time_;
};

// At most so many threads of this process compute, until it is released; of
// several limits the least.
class ThreadLimit {
 public:
  explicit ThreadLimit(std::size_t threads)
      : control_(std::in_place, tbb::global_control::max_allowed_parallelism,
                 std::max<std::size_t>(threads, 1)) {}
  void Release() { control_.reset(); }

 private:
  std::optional<tbb::global_control> control_;
};

// Throws InputError for all that can be told to be wrong before there is a
// scene.  An empty clearance is the scene's own.
void CheckPlanner(const std::string& planner, const std::string& retraction,
                  const std::string& clearance) {
  const PlannerId id = ParsePlanner(planner, "planners");
  ParseRetraction(retraction, "retraction");
  if (clearance.empty()) return;
  RequireSeeksClearance(id, "clearance");
  // Whether the unit is the scene's, the scene will say.
  ParseLength(clearance, "clearance", UnitNamedIn(clearance));
}

}  // namespace

void BindSweeps(nb::module_& module) {
  nb::class_<Comparison>(module, "Comparison")
      .def(nb::init<const std::string&, double, bool>(),
           nb::call_guard<Computing>())
      .def("row", &Comparison::Row);
  nb::class_<ThreadLimit>(module, "ThreadLimit")
      .def(nb::init<std::size_t>())
      .def("release", &ThreadLimit::Release);
  module.def("did_you_mean", &DidYouMean, nb::arg("word"), nb::arg("names"));
  module.def("scene_digest", [](const std::string& scene) {
    const Computing computing;
    return SceneSource(scene).Digest();
  });
  module.def("check_method",
             [](const std::string& protocol, const std::string& metric) {
               FindProtocol(protocol);
               ParseStudyMetric(metric, "metrics");
             });
  module.def("check_planner", &CheckPlanner);
}

}  // namespace phongpd::python
