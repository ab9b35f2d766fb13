// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact/contact_space.h"
#include "core/projection/penetration_tracker.h"
#include "python/src/arrays.h"
#include "python/src/bindings.h"
#include "python/src/computing.h"

namespace phongpd::python {
namespace {

// Columns of one row a step of the motion, from the state as it is.
nb::dict Follow(const PenetrationTracker& tracker,
                PenetrationTracker::State* state, const Rows3& rows) {
  const size_t count = rows.shape(0);
  Column<unsigned char, 1> status(count), inside(count);
  Column<double, 1> depth(count), euclidean(count), ratio(count), moved(count);
  Column<double, 3> pd(count), contact(count);
  Column<int, 1> triangle(count);
  {
    const Computing computing;
    for (size_t i = 0; i < count; ++i) {
      const TrackerResult r = tracker.Step(Row(rows, i), state);
      status[i] = static_cast<unsigned char>(r.status);
      inside[i] = r.inside;
      depth[i] = r.magnitude;
      euclidean[i] = r.euclidean_depth;
      ratio[i] = r.ratio;
      moved[i] = r.moved;
      pd.Set(i, r.pd);
      contact.Set(i, r.contact);
      triangle[i] = r.triangle;
    }
  }
  nb::dict out;
  out["status"] = status.Array();
  out["inside"] = inside.Array();
  out["penetration"] = pd.Array();
  out["depth"] = depth.Array();
  out["euclidean_depth"] = euclidean.Array();
  out["ratio"] = ratio.Array();
  out["moved"] = moved.Array();
  out["contact"] = contact.Array();
  out["triangle"] = triangle.Array();
  return out;
}

}  // namespace

void BindTracker(nb::module_& module) {
  nb::class_<PenetrationTracker::State>(module, "TrackerState")
      .def(nb::init<>());
  nb::class_<PenetrationTracker>(module, "PenetrationTracker")
      .def("__init__",
           [](PenetrationTracker* self, const ContactSpace& space, double ratio,
              double speed) {
             PenetrationTrackerOptions options;
             options.ratio = ratio;
             options.speed = speed;
             const Computing computing;
             new (self) PenetrationTracker(space, options);
           })
      .def("follow", &Follow);
}

}  // namespace phongpd::python
