// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "planners/trajectory/scaled_curve_program.h"

namespace phongpd::internal {

// A row of the program, where the interior point method is.
struct CurveRowState {
  const CurveProgram::Row* row;
  Eigen::Vector3d direction;  // of kNorm, now
  double eta, inverse_norm;
  double slack, dual;
  double slack_step, dual_step, next_slack;
  double product;  // of the predictor's steps
};

// What a step of the unknowns changes the row by, the terms in m and t
// included.  `along`: the part in ΔB and η; on entry that of the row before, of
// which a mirrored row is the negative.
double Slope(const CurveRowState& state, const CurveLocal& step, double* along);

// The slack at x, > 0 within the row; of a norm also its gradient there.
double SlackAt(CurveRowState* state, const CurveLocal& x, double* along);

// *matrix += by · (terms in ΔB, η and m)² + by_t · those times the term in t;
// the square of that is for the caller.
void AddRow(const CurveRowState& state, double by, double by_t,
            CurveLocalMatrix* matrix);

// *gradient += by · (terms in ΔB, η and m) + by_t · the term in t.
void AddRow(const CurveRowState& state, double by, double by_t,
            CurveLocal* gradient);

// Σ multiplier · gradient of a row.
template <typename Multiplier>
void AddGradients(const std::vector<CurveRowState>& states,
                  const Multiplier& multiplier, CurveLocal* gradient) {
  for (std::size_t k = 0; k < states.size(); ++k) {
    const double by = multiplier(states[k]);
    if (k + 1 < states.size() && states[k + 1].row->is_mirrored) {
      const double other = multiplier(states[k + 1]);
      AddRow(states[k++], by - other, by + other, gradient);
    } else {
      AddRow(states[k], by, by, gradient);
    }
  }
}

}  // namespace phongpd::internal
