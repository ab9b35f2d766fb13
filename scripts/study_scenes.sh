# SPDX-License-Identifier: GPL-3.0-or-later
# shellcheck shell=bash disable=SC2034
# To be sourced: scenes and metrics of results/study/protocol.md.
study_scenes=(
  ball_cone:cone_radius=1 ball_convex:sides=9,radius=0.4
  ball_wrench:ball_radius=0.3 clutter:layout=7,boxes=40
  cone_axes:half_width=0.3 cube_vessel:cube=0.4,window=1
  knot:tube=0.2 l:width=0.3 long_plate:thickness=0.15
  long_plate:width=1.4,edge=0.13 peg_tunnel:clearance=0.003
  peg_tunnel:clearance=0.03 peg_tunnel:clearance=0.06
  plate:thickness=0.01 plate:thickness=0.05 plate:thickness=0.2
  plate:edge=0.13 plate_hole:clearance=0.1 torus_hole:ball_radius=0.25
  u_axis:wall=0.15 u_axis:wall=0.3,edge=0.13 u_trap:height=0.7
  u_trap:wall=0.15,edge=0.13
)
study_metrics=(
  euclidean phong@0.2 smoothed@0.2 smoothed-foot@0.2 diffused@0.2 placebo@0.2
)
study_further=(
  phong@0 phong@0.1 phong@0.2/exact followed smoothed@0.1 smoothed@0.4
)
study_seed=70001
study_models_seed=71001
study_cap=3000
