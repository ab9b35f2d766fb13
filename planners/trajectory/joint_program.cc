// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/joint_program.h"

#include <cmath>

namespace phongpd::internal {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Of unknowns that nothing else has a price for.
constexpr double kProximal = 1e-6;

}  // namespace

JointUnknowns::JointUnknowns(const JointProgram& program)
    : program_(program),
      curves_(static_cast<int>(program.curves.size())),
      pieces_(static_cast<int>(program.curves[0].pieces.size())),
      block_(9 * curves_ + 1) {
  for (int c = 0; c < curves_; ++c) {
    const bool stays = program.stays[static_cast<std::size_t>(c)];
    is_fixed_.insert(is_fixed_.end(), static_cast<std::size_t>(pieces_), stays);
    is_fixed_[static_cast<std::size_t>(c * pieces_)] = true;
  }
  for (std::size_t c = 0; c < program.rests.size(); ++c) {
    for (const int knot : program.rests[c]) {
      if (knot == pieces_) continue;  // the last one has no unknowns
      is_fixed_[c * static_cast<std::size_t>(pieces_) +
                static_cast<std::size_t>(knot)] = true;
    }
  }
}

void JointUnknowns::AddPiece(int piece, WideTridiagonal* hessian,
                             VectorXd* linear) const {
  // ∫ of products of the quadratic Bernstein polynomials, times 30.
  Eigen::Matrix3d products;
  products << 6, 3, 1, 3, 4, 3, 1, 3, 6;
  MatrixXd matrix = MatrixXd::Zero(TAt() + 1, TAt() + 1);
  VectorXd gradient = VectorXd::Zero(TAt() + 1);
  for (int c = 0; c < curves_; ++c) {
    const CurveProgram::Piece& of = program_.curves[c].pieces[piece];
    const double weight = 2.0 * of.jerk_weight / (30.0 * curves_);
    for (int axis = 0; axis < 3; ++axis) {
      const auto& rows = of.jerk[axis];
      const Eigen::Matrix<double, 8, 8> square =
          weight * rows.transpose() * products * rows;
      const auto place = [&](int j) {
        return j < 6 ? 18 * c + 3 * j + axis : EtaAt();
      };
      for (int j = 0; j < 7; ++j) {
        gradient[place(j)] += square(j, 7);
        for (int k = 0; k < 7; ++k) matrix(place(j), place(k)) += square(j, k);
      }
    }
  }
  const CurveProgram& first = program_.curves[0];
  const CurveProgram::Piece& of = first.pieces[piece];
  // Σ share·η is 0.  Durations are drawn to their mean.
  matrix(EtaAt(), EtaAt()) += of.share + 2.0 * first.evenness;
  gradient[EtaAt()] += 2.0 * first.evenness * std::log(Share(piece));
  AddGradient(piece, gradient, linear);
  AddMatrix(piece, &matrix, hessian);
}

void JointUnknowns::AddObjective(WideTridiagonal* hessian,
                                 VectorXd* linear) const {
  for (int i = 0; i < pieces_; ++i) {
    AddPiece(i, hessian, linear);
    hessian->diagonal[i].diagonal().array() += kProximal;
  }
  (*linear)[linear->size() - 1] = program_.curves[0].t;
}

double JointUnknowns::EtaOf(int piece, const VectorXd& x) const {
  const auto theta = [&](int k) {
    return k < pieces_ ? x[block_ * k + block_ - 1] : 0.0;
  };
  return (theta(piece + 1) - theta(piece)) / Share(piece);
}

VectorXd JointUnknowns::ToLocal(int piece, const VectorXd& x) const {
  VectorXd local(TAt() + 1);
  const double eta = EtaOf(piece, x);
  for (int c = 0; c < curves_; ++c) {
    const CurveProgram::Piece& of = program_.curves[c].pieces[piece];
    const double r = of.before, s = of.after;
    const auto from = x.segment<9>(block_ * piece + 9 * c);
    auto b = local.segment<18>(18 * c);
    b.segment<3>(0) = from.segment<3>(0);
    b.segment<3>(3) = from.segment<3>(0) + r * from.segment<3>(3);
    b.segment<3>(6) = from.segment<3>(0) + 2.0 * r * from.segment<3>(3) +
                      r * r * from.segment<3>(6);
    if (piece + 1 < pieces_) {
      const auto to = x.segment<9>(block_ * (piece + 1) + 9 * c);
      b.segment<3>(9) = to.segment<3>(0) - 2.0 * s * to.segment<3>(3) +
                        s * s * to.segment<3>(6);
      b.segment<3>(12) = to.segment<3>(0) - s * to.segment<3>(3);
      b.segment<3>(15) = to.segment<3>(0);
    } else {
      b.segment<9>(9).setZero();
    }
    for (int j = 0; j < 6; ++j) b.segment<3>(3 * j) += eta * of.by_eta.col(j);
  }
  local[EtaAt()] = eta;
  local[ThetaAt()] = x[block_ * piece + block_ - 1];
  local[TAt()] = x[x.size() - 1];
  return local;
}

void JointUnknowns::AddGradient(int piece, const VectorXd& local,
                                VectorXd* x) const {
  double eta = local[EtaAt()];
  for (int c = 0; c < curves_; ++c) {
    const CurveProgram::Piece& of = program_.curves[c].pieces[piece];
    const double r = of.before, s = of.after;
    const auto b = local.segment<18>(18 * c);
    for (int j = 0; j < 6; ++j) {
      eta += of.by_eta.col(j).dot(b.segment<3>(3 * j));
    }
    const Vector3d b1 = b.segment<3>(3), b2 = b.segment<3>(6);
    auto from = x->segment<9>(block_ * piece + 9 * c);
    from.segment<3>(0) += b.segment<3>(0) + b1 + b2;
    from.segment<3>(3) += r * (b1 + 2.0 * b2);
    from.segment<3>(6) += r * r * b2;
    if (piece + 1 == pieces_) continue;
    const Vector3d b3 = b.segment<3>(9), b4 = b.segment<3>(12);
    auto to = x->segment<9>(block_ * (piece + 1) + 9 * c);
    to.segment<3>(0) += b.segment<3>(15) + b4 + b3;
    to.segment<3>(3) -= s * (b4 + 2.0 * b3);
    to.segment<3>(6) += s * s * b3;
  }
  eta /= Share(piece);
  (*x)[block_ * piece + block_ - 1] += local[ThetaAt()] - eta;
  if (piece + 1 < pieces_) (*x)[block_ * (piece + 1) + block_ - 1] += eta;
  (*x)[x->size() - 1] += local[TAt()];
}

// FᵀMF with ToLocal's F, columns first, then rows.
void JointUnknowns::AddMatrix(int piece, MatrixXd* local,
                              WideTridiagonal* to) const {
  MatrixXd& m = *local;
  for (int pass = 0; pass < 2; ++pass) {
    for (int c = 0; c < curves_; ++c) {
      const CurveProgram::Piece& of = program_.curves[c].pieces[piece];
      const double r = of.before, s = of.after;
      for (int k = 0; k < 3; ++k) {
        const int at = 18 * c + k;
        for (int j = 0; j < 6; ++j) {
          m.col(EtaAt()) += of.by_eta(k, j) * m.col(at + 3 * j);
        }
        auto b0 = m.col(at), b1 = m.col(at + 3), b2 = m.col(at + 6);
        b0 += b1 + b2;
        b1 = r * (b1 + 2.0 * b2);
        b2 *= r * r;
        auto b3 = m.col(at + 9), b4 = m.col(at + 12), b5 = m.col(at + 15);
        b5 += b4 + b3;
        b4 = -s * (b4 + 2.0 * b3);
        b3 *= s * s;
      }
    }
    // θ of the second knot takes the place of η.
    m.col(EtaAt()) /= Share(piece);
    m.col(ThetaAt()) -= m.col(EtaAt());
    m.transposeInPlace();
  }
  AddBlocks(piece, m, to);
}

void JointUnknowns::AddBlocks(int piece, const MatrixXd& m,
                              WideTridiagonal* to) const {
  // The order after, of each curve: p v a of the first knot; a v p of the
  // second; then θ of the second, and of the first.
  const int theta = block_ - 1;
  const auto of_second = [](int o) { return 15 - 3 * o; };
  const bool has_second = piece + 1 < pieces_;
  auto& here = to->diagonal[piece];
  auto& above = to->above[piece];
  for (int a = 0; a < curves_; ++a) {
    const int at = 18 * a;
    here.block<9, 1>(9 * a, theta) += m.block<9, 1>(at, ThetaAt());
    here.block<1, 9>(theta, 9 * a) += m.block<1, 9>(ThetaAt(), at);
    to->border[piece].segment<9>(9 * a) += m.block<9, 1>(at, TAt());
    if (!has_second) {
      for (int b = 0; b < curves_; ++b) {
        here.block<9, 9>(9 * a, 9 * b) += m.block<9, 9>(at, 18 * b);
      }
      continue;
    }
    auto& next = to->diagonal[piece + 1];
    above.block<9, 1>(9 * a, theta) += m.block<9, 1>(at, EtaAt());
    for (int o = 0; o < 3; ++o) {
      const int column = at + of_second(o);
      above.block<1, 3>(theta, 9 * a + 3 * o) +=
          m.block<1, 3>(ThetaAt(), column);
      next.block<1, 3>(theta, 9 * a + 3 * o) += m.block<1, 3>(EtaAt(), column);
      next.block<3, 1>(9 * a + 3 * o, theta) += m.block<3, 1>(column, EtaAt());
      to->border[piece + 1].segment<3>(9 * a + 3 * o) +=
          m.block<3, 1>(column, TAt());
    }
    for (int b = 0; b < curves_; ++b) {
      here.block<9, 9>(9 * a, 9 * b) += m.block<9, 9>(at, 18 * b);
      for (int o = 0; o < 3; ++o) {
        const int column = 18 * b + of_second(o);
        above.block<9, 3>(9 * a, 9 * b + 3 * o) += m.block<9, 3>(at, column);
        for (int q = 0; q < 3; ++q) {
          next.block<3, 3>(9 * a + 3 * q, 9 * b + 3 * o) +=
              m.block<3, 3>(at + of_second(q), column);
        }
      }
    }
  }
  here(theta, theta) += m(ThetaAt(), ThetaAt());
  to->border[piece][theta] += m(ThetaAt(), TAt());
  to->corner += m(TAt(), TAt());
  if (!has_second) return;
  above(theta, theta) += m(ThetaAt(), EtaAt());
  to->diagonal[piece + 1](theta, theta) += m(EtaAt(), EtaAt());
  to->border[piece + 1][theta] += m(EtaAt(), TAt());
}

void JointUnknowns::Fix(WideTridiagonal* matrix) const {
  const int theta = block_ - 1;
  matrix->diagonal[0].row(theta).setZero();
  matrix->diagonal[0].col(theta).setZero();
  matrix->diagonal[0](theta, theta) = 1.0;
  matrix->above[0].row(theta).setZero();
  matrix->border[0][theta] = 0.0;
  for (int k = 0; k < pieces_; ++k) {
    for (int c = 0; c < curves_; ++c) {
      if (!IsFixed(k, c)) continue;
      auto& block = matrix->diagonal[k];
      block.middleRows<9>(9 * c).setZero();
      block.middleCols<9>(9 * c).setZero();
      block.diagonal().segment<9>(9 * c).setOnes();
      matrix->above[k].middleRows<9>(9 * c).setZero();
      if (k > 0) matrix->above[k - 1].middleCols<9>(9 * c).setZero();
      matrix->border[k].segment<9>(9 * c).setZero();
    }
  }
}

void JointUnknowns::Fix(VectorXd* x) const {
  (*x)[block_ - 1] = 0.0;
  for (int k = 0; k < pieces_; ++k) {
    for (int c = 0; c < curves_; ++c) {
      if (IsFixed(k, c)) x->segment<9>(block_ * k + 9 * c).setZero();
    }
  }
}

}  // namespace phongpd::internal
