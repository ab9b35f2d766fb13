# SPDX-License-Identifier: GPL-3.0-or-later
# shellcheck shell=bash disable=SC2034
# To be sourced: the scenes of the convergence study.
scenes=(
  u_axis u_trap l plate:thickness=0.1 plate:thickness=0.02
  plate:thickness=0.005 long_plate torus_hole cone_axes ball_wrench
  ball_convex clutter knot peg_tunnel:clearance=0.1 peg_tunnel:clearance=0.01
  peg_tunnel:clearance=0.001 u_axis:edge=0.1 u_trap:edge=0.1 plate:edge=0.1
  long_plate:edge=0.1
)
