// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/scaled_curve_program.h"

#include <algorithm>

namespace phongpd::internal {

using Eigen::Vector3d;
using Eigen::VectorXd;

CurveLocal ToLocal(const CurveProgram& program, int piece, const VectorXd& x) {
  const CurveProgram::Piece& of = program.pieces[piece];
  const auto from =
      x.segment<BlockTridiagonal::kSize>(BlockTridiagonal::kSize * piece);
  CurveLocal local;
  const double r = of.before, s = of.after;
  local.segment<3>(0) = from.segment<3>(0);
  local.segment<3>(3) = from.segment<3>(0) + r * from.segment<3>(3);
  local.segment<3>(6) = from.segment<3>(0) + 2.0 * r * from.segment<3>(3) +
                        r * r * from.segment<3>(6);
  if (piece + 1 < program.size()) {
    const auto to = x.segment<BlockTridiagonal::kSize>(BlockTridiagonal::kSize *
                                                       (piece + 1));
    local.segment<3>(9) = to.segment<3>(0) - 2.0 * s * to.segment<3>(3) +
                          s * s * to.segment<3>(6);
    local.segment<3>(12) = to.segment<3>(0) - s * to.segment<3>(3);
    local.segment<3>(15) = to.segment<3>(0);
  } else {
    local.segment<9>(9).setZero();
  }
  for (int j = 0; j < 6; ++j) {
    local.segment<3>(3 * j) += from[9] * of.by_eta.col(j);
  }
  local[kCurveEta] = from[9];
  local[kCurveMissing] = from[10];
  local[kCurveT] = x[x.size() - 1];
  return local;
}

void AddGradient(const CurveProgram& program, int piece,
                 const CurveLocal& local, VectorXd* x) {
  const CurveProgram::Piece& of = program.pieces[piece];
  auto from =
      x->segment<BlockTridiagonal::kSize>(BlockTridiagonal::kSize * piece);
  const double r = of.before, s = of.after;
  const Vector3d b1 = local.segment<3>(3), b2 = local.segment<3>(6);
  from.segment<3>(0) += local.segment<3>(0) + b1 + b2;
  from.segment<3>(3) += r * (b1 + 2.0 * b2);
  from.segment<3>(6) += r * r * b2;
  from[9] += local[kCurveEta];
  for (int j = 0; j < 6; ++j) {
    from[9] += of.by_eta.col(j).dot(local.segment<3>(3 * j));
  }
  from[10] += local[kCurveMissing];
  (*x)[x->size() - 1] += local[kCurveT];
  if (piece + 1 == program.size()) return;
  auto to = x->segment<BlockTridiagonal::kSize>(BlockTridiagonal::kSize *
                                                (piece + 1));
  const Vector3d b3 = local.segment<3>(9), b4 = local.segment<3>(12);
  to.segment<3>(0) += local.segment<3>(15) + b4 + b3;
  to.segment<3>(3) -= s * (b4 + 2.0 * b3);
  to.segment<3>(6) += s * s * b3;
}

// FᵀMF with ToLocal's F: M F by columns, then Fᵀ of each of its columns.
void AddMatrix(const CurveProgram& program, int piece, CurveLocalMatrix* local,
               BlockTridiagonal* to) {
  const CurveProgram::Piece& of = program.pieces[piece];
  const double r = of.before, s = of.after;
  CurveLocalMatrix& m = *local;
  for (int j = 1; j <= 4; ++j) {  // the ends do not know η
    for (int c = 0; c < 3; ++c) {
      m.col(kCurveEta) += of.by_eta(c, j) * m.col(3 * j + c);
    }
  }
  for (int c = 0; c < 3; ++c) {
    auto b0 = m.col(c), b1 = m.col(3 + c), b2 = m.col(6 + c);
    b0 += b1 + b2;
    b1 = r * (b1 + 2.0 * b2);
    b2 *= r * r;
    auto b3 = m.col(9 + c), b4 = m.col(12 + c), b5 = m.col(15 + c);
    b5 += b4 + b3;
    b4 = -s * (b4 + 2.0 * b3);
    b3 *= s * s;
  }
  const Eigen::Map<const Eigen::Matrix<double, 12, 1>> by_eta(
      of.by_eta.col(1).data());
  for (int k = 0; k < 21; ++k) {
    auto column = m.col(k);
    column[kCurveEta] += by_eta.dot(column.segment<12>(3));
    const Vector3d b1 = column.segment<3>(3), b2 = column.segment<3>(6);
    column.segment<3>(0) += b1 + b2;
    column.segment<3>(3) = r * (b1 + 2.0 * b2);
    column.segment<3>(6) = r * r * b2;
    const Vector3d b3 = column.segment<3>(9), b4 = column.segment<3>(12);
    column.segment<3>(15) += b4 + b3;
    column.segment<3>(12) = -s * (b4 + 2.0 * b3);
    column.segment<3>(9) = s * s * b3;
  }
  // The order after: p v a of the first knot; a v p of the second; η m t.
  to->diagonal[piece].topLeftCorner<9, 9>() += m.topLeftCorner<9, 9>();
  to->diagonal[piece].block<9, 2>(0, 9) += m.block<9, 2>(0, kCurveEta);
  to->diagonal[piece].block<2, 9>(9, 0) += m.block<2, 9>(kCurveEta, 0);
  to->diagonal[piece].block<2, 2>(9, 9) += m.block<2, 2>(kCurveEta, kCurveEta);
  to->border[piece].head<9>() += m.block<9, 1>(0, kCurveT);
  to->border[piece].tail<2>() += m.block<2, 1>(kCurveEta, kCurveT);
  to->corner += m(kCurveT, kCurveT);
  if (piece + 1 == program.size()) return;
  for (int o = 0; o < 3; ++o) {
    const int column = 15 - 3 * o;
    to->above[piece].block<9, 3>(0, 3 * o) += m.block<9, 3>(0, column);
    to->above[piece].block<2, 3>(9, 3 * o) += m.block<2, 3>(kCurveEta, column);
    to->border[piece + 1].segment<3>(3 * o) += m.block<3, 1>(column, kCurveT);
    for (int q = 0; q < 3; ++q) {
      to->diagonal[piece + 1].block<3, 3>(3 * o, 3 * q) +=
          m.block<3, 3>(column, 15 - 3 * q);
    }
  }
}

void AddObjective(const CurveProgram& program, BlockTridiagonal* hessian,
                  VectorXd* linear) {
  // ∫ of products of the quadratic Bernstein polynomials, times 30.
  Eigen::Matrix3d products;
  products << 6, 3, 1, 3, 4, 3, 1, 3, 6;
  for (int i = 0; i < program.size(); ++i) {
    const CurveProgram::Piece& piece = program.pieces[i];
    CurveLocalMatrix matrix = CurveLocalMatrix::Zero();
    CurveLocal gradient = CurveLocal::Zero();
    for (int axis = 0; axis < 3; ++axis) {
      const auto& rows = piece.jerk[axis];
      const Eigen::Matrix<double, 8, 8> square =
          (2.0 * piece.jerk_weight / 30.0) * rows.transpose() * products * rows;
      const auto place = [&](int j) {
        return j < 6 ? 3 * j + axis : kCurveEta;
      };
      for (int j = 0; j < 7; ++j) {
        gradient[place(j)] += square(j, 7);
        for (int k = 0; k < 7; ++k) matrix(place(j), place(k)) += square(j, k);
      }
    }
    gradient[kCurveEta] += piece.share;
    gradient[kCurveMissing] += program.missing;
    if (i > 0) {
      const CurveProgram::Piece& before = program.pieces[i - 1];
      const double even = 2.0 * program.evenness;
      const double by = even + 2.0 * std::max(before.caution, piece.caution);
      hessian->diagonal[i](9, 9) += by;
      hessian->diagonal[i - 1](9, 9) += by;
      hessian->above[i - 1](9, 9) -= by;
      const double jump = piece.log_duration - before.log_duration;
      (*linear)[BlockTridiagonal::kSize * i + 9] += even * jump;
      (*linear)[BlockTridiagonal::kSize * (i - 1) + 9] -= even * jump;
    }
    AddGradient(program, i, gradient, linear);
    AddMatrix(program, i, &matrix, hessian);
  }
  (*linear)[linear->size() - 1] = program.t;
}

}  // namespace phongpd::internal
