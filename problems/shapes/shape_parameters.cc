// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/shapes/shape_parameters.h"

#include <cmath>
#include <sstream>

#include "core/mesh/mesh_error.h"
#include "core/pi.h"

namespace phongpd::internal {
namespace {

constexpr double kMinLength = 1e-70, kMaxLength = 1e70;

}  // namespace

void RequireLength(const char* shape, const char* parameter, double value) {
  // Both false for NaN.
  if (std::isgreaterequal(value, kMinLength) &&
      std::islessequal(value, kMaxLength)) {
    return;
  }
  std::ostringstream message;
  message << shape << ": " << parameter << " must be a length in ["
          << kMinLength << ", " << kMaxLength << "], found " << value;
  throw InputError(message.str());
}

void RequireLengthBelow(const char* shape, const char* parameter, double value,
                        double limit, const char* limit_name) {
  RequireLength(shape, parameter, value);
  if (value < limit) return;
  std::ostringstream message;
  message << shape << ": " << parameter << " must be less than " << limit_name
          << " = " << limit << ", found " << value;
  throw InputError(message.str());
}

void RequireCount(const char* shape, const char* parameter, int value,
                  int minimum, int maximum) {
  if (value >= minimum && value <= maximum) return;
  std::ostringstream message;
  message << shape << ": " << parameter << " must be a count in [" << minimum
          << ", " << maximum << "], found " << value;
  throw InputError(message.str());
}

void RequireTriangles(const char* shape, const char* formula, int first,
                      int second) {
  RequireCount(shape, formula, 2 * first * second, 0, kMaxTriangles);
}

double UnitRandom(std::mt19937_64* random) {
  return std::ldexp(static_cast<double>((*random)() >> 11), -53);
}

Eigen::Vector2d UnitCircle(int i, int n) {
  const int quadrant = 4 * i / n;
  const int rest = 4 * i - quadrant * n;
  const double angle = 0.5 * kPi * rest / n;
  const double c = std::cos(angle), s = std::sin(angle);
  switch (quadrant % 4) {
    case 0:
      return {c, s};
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    default:
      return {s, -c};
  }
}

}  // namespace phongpd::internal
