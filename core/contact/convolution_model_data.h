// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contact/convolution_model.h"
#include "core/minkowski/build_limits.h"
#include "core/minkowski/contact_space_report.h"
#include "core/minkowski/convolution/convolution_space.h"
#include "core/minkowski/operands/grid_pair.h"
#include "core/minkowski/operands/operand.h"
#include "core/solid/solid.h"

namespace phongpd {

struct ConvolutionModel::Data {
  // Operands are Solids or meshes.
  template <typename Operand>
  static internal::GridPair MakePair(const Operand& robot,
                                     const Operand& obstacle,
                                     const ContactSpaceOptions& options,
                                     const internal::BuildLimits& limits,
                                     ContactSpaceReport* operands) {
    using internal::OperandRole;
    const Solid a =
        internal::PrepareOperand(robot, OperandRole::kRobot, options, operands);
    limits.CheckNow("check");
    const Solid b = internal::PrepareOperand(obstacle, OperandRole::kObstacle,
                                             options, operands);
    limits.CheckNow("check");
    return internal::PlaceOperands(a, b, internal::LatticeDivisor::kPowerOfTwo,
                                   operands);
  }

  template <typename Operand>
  Data(const Operand& robot, const Operand& obstacle,
       const ContactSpaceOptions& the_options)
      : options(the_options),
        limits(options),
        pair(MakePair(robot, obstacle, options, limits, &operands)),
        space(pair, [this] { return limits.max_mib(); }),
        bounds(space.Bounds()) {
    limits.CheckNow("convolution");
    report.grid_step = pair.frame.rounding;
    report.approximation = operands.approximation;
    report.warnings = operands.warnings;
  }

  ContactSpaceOptions options;
  internal::BuildLimits limits;  // until questions can be asked
  ContactSpaceReport operands;
  internal::GridPair pair;
  internal::ConvolutionSpace space;  // of the pair
  BoundingBox bounds;
  ConvolutionReport report;
};

}  // namespace phongpd
