// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/ipopt_condensed.h"

#include <algorithm>
#include <cassert>
#include <memory>

#if __has_include(<HSLLoader.h>)
#define PHONGPD_IPOPT_TAKES_SOLVERS
#ifndef FORTRAN_INTEGER_TYPE
#define FORTRAN_INTEGER_TYPE int
#endif
extern "C" {
#include <HSLLoader.h>
}
#endif

#include "planners/trajectory/condensed_system.h"

namespace phongpd {

#ifdef PHONGPD_IPOPT_TAKES_SOLVERS

namespace {

// The functions Ipopt calls carry no pointer of ours.
std::unique_ptr<CondensedSystem> current;

// Their results, by the numbers of the interface: INFO(1) is 0 or an error,
// INFO(3) to INFO(10) are sizes of work space, INFO(15) counts negative
// eigenvalues.  What is factorised is kept in `current`; the work space Ipopt
// allocates for it is as small as Ipopt may ask for.
constexpr int kInfoSize = 20;
constexpr int kNegative = 14;
constexpr int kInvalid = -1;

void Initialise(ipfint* options, double* numbers) {
  std::fill(options, options + 30, 0);
  std::fill(numbers, numbers + 5, 0.0);
}

void Analyse(ipfint* size, ipfint* entries, const ipfint* row,
             const ipfint* col, ipfint* /*work*/, ipfint* /*work_size*/,
             ipfint* /*keep*/, ipfint* /*work1*/, ipfint* steps,
             ipfint* /*flag*/, ipfint* /*options*/, double* /*numbers*/,
             ipfint* info, double* operations) {
  std::fill(info, info + kInfoSize, 0);
  std::fill(info + 2, info + 10, *size);
  *steps = 1;
  *operations = 0.0;
  current = std::make_unique<CondensedSystem>(current->rows());
  if (!current->Analyze(*size, *entries, row, col)) info[0] = kInvalid;
}

void Factorise(ipfint* size, ipfint* /*entries*/, const ipfint* /*row*/,
               const ipfint* /*col*/, double* values, ipfint* /*value_size*/,
               ipfint* /*work*/, ipfint* /*work_size*/, ipfint* /*keep*/,
               ipfint* /*steps*/, ipfint* front, ipfint* /*work1*/,
               ipfint* /*options*/, double* /*numbers*/, ipfint* info) {
  std::fill(info, info + kInfoSize, 0);
  *front = 1;
  const bool is_wanted =
      current->Factorize(values) == CondensedSystem::Inertia::kAsWanted;
  // Any other number makes Ipopt add to the diagonal and try again.
  info[kNegative] = is_wanted ? current->rows() : *size;
}

void Backsolve(ipfint* /*size*/, double* /*values*/, ipfint* /*value_size*/,
               ipfint* /*work*/, ipfint* /*work_size*/, double* /*front*/,
               ipfint* /*front_size*/, double* unknowns, ipfint* /*work1*/,
               ipfint* /*steps*/, ipfint* /*options*/, double* /*numbers*/) {
  current->Solve(unknowns);
}

}  // namespace

bool CondensedSolver::IsAvailable() { return LSL_isMA27available() == 0; }

CondensedSolver::CondensedSolver(int rows) {
  assert(current == nullptr && IsAvailable());
  current = std::make_unique<CondensedSystem>(rows);
  LSL_setMA27(Analyse, Factorise, Backsolve, Initialise);
}

CondensedSolver::~CondensedSolver() {
  LSL_setMA27(nullptr, nullptr, nullptr, nullptr);
  current.reset();
}

#else

bool CondensedSolver::IsAvailable() { return false; }
CondensedSolver::CondensedSolver(int) {}
CondensedSolver::~CondensedSolver() = default;

#endif

}  // namespace phongpd
