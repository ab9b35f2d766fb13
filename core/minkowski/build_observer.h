// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace phongpd {

// What a contact space that is being built is at.
struct BuildProgress {
  const char* stage;         // a word for people: "arrangement"
  double seconds;            // since the build began
  double predicted_seconds;  // of all of it, a guess (PredictedCost); 0: none
};

// Called from within the loops of every build in the process, hundreds of times
// a second and from several threads at once: must be quick, safe to call so,
// and throw nothing.
using BuildObserver = void (*)(const BuildProgress&);

// From now on; nullptr: nobody.
void ObserveBuilds(BuildObserver observer);

}  // namespace phongpd
