// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <string>

#include "core/minkowski/contact_space_options.h"
#include "core/minkowski/contact_space_report.h"
#include "core/stopwatch.h"

namespace phongpd::internal {

inline constexpr double kMib = 1024.0 * 1024.0;  // bytes

// Address space and resident set of the process, MiB.
struct ProcessMib {
  double all = 0.0, resident = 0.0;
};

// The limits of one build, asked from within its loops: what was predicted is
// a guide, what was passed is a fact.  Time counts from construction; memory
// is the growth of the process's resident set since then, so that other
// threads' work counts, too.
class BuildLimits {
 public:
  explicit BuildLimits(const ContactSpaceOptions& options);
  // The same limits from the same beginning, for one of several builds; cheap.
  BuildLimits(const BuildLimits& other);
  BuildLimits& operator=(const BuildLimits&) = delete;
  // What a copy of this has found out since: max_mib, and when memory was read.
  void LearnFrom(const BuildLimits& copy) const;

  // Throws BuildRefusal naming the operands, the limit and what was predicted,
  // if that is above an explicit limit.
  void Predict(const PredictedCost& cost);

  // Is more memory predicted than this build may take, whoever set the limit?
  bool IsAboveMemory(const PredictedCost& cost) const {
    return cost.mib > max_mib();
  }

  // What it may take, whoever set the limit.  If nobody did, nine tenths of
  // what was free in the beginning: of the machine, and of what a control group
  // or RLIMIT_AS leaves of it.  Found when first asked for, which takes longer
  // than a small model.
  double max_mib() const;

  // From now on CancelBuilds stops this build, too.
  void ObserveCancellation();

  // Throws BuildRefusal naming the operands, the limit that has been passed and
  // the stage, or BuildCancelled.  From any thread; cheap enough for every
  // facet.
  void Check(const char* stage) const;
  // The same, but looks at the clock each time: for what is done in one go.
  void CheckNow(const char* stage) const;

 private:
  void StopIfCancelled(const char* stage) const;
  [[noreturn]] void Refuse(const std::string& what) const;
  [[noreturn]] void RefuseIn(const char* stage, const std::string& what) const;

  std::string operands_;
  double max_seconds_;  // infinity: none
  bool is_automatic_;   // max_mib_ is a share of what is free
  ProcessMib first_;
  Stopwatch stopwatch_;
  PredictedCost predicted_;
  bool is_cancellable_ = false;
  unsigned cancellations_ = 0;  // before this build
  mutable std::atomic<unsigned> calls_{0};
  mutable std::atomic<double> max_mib_;      // negative: not known yet
  mutable std::atomic<double> next_memory_;  // seconds, when it is read again
};

}  // namespace phongpd::internal
