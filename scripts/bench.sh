#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# bench.sh [paper|queries|contact-space|lazy|convergence|pipeline|planning|
# extremes|peers|trajectories|fleets|rigid|rigid-optimize|rigid-ompl-app|wrench|
# study|study-further|study-models|study-solvers|study-times|cluster|python|trade|
# slice|all]:
# regenerates the tables and figures of results/.  continuity is a part of queries, retraction and
# widths are parts of planning.  slice makes some published rows anew and compares
# them (results/reproduction.md), study --quick the same of every table of the study
# (results/study/slice.md); they are no part of all, nor is rigid-ompl-app FOLDER, for it
# takes a checkout of OMPL.app, FOLDER its resources/3D.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# The user's own cache is neither used nor filled.
export PHONGPD_CACHE_DIR=$PWD/build/cache

suite=${1:-all}
case $suite in
  paper | queries | contact-space | lazy | convergence | pipeline | planning | \
    extremes | peers | trajectories | fleets | rigid | rigid-optimize | \
    rigid-ompl-app | wrench | study | study-further | study-models | \
    study-solvers | study-times | cluster | python | trade | continuity | \
    retraction | widths | slice | all) ;;
  *)
    echo "bench: expected paper, queries, contact-space, lazy," \
      "convergence, pipeline, planning, extremes, peers, trajectories, fleets," \
      "rigid, rigid-optimize, rigid-ompl-app, wrench, study, study-further," \
      "study-models, study-solvers, study-times, cluster, python, trade," \
      "continuity, retraction, widths, slice" \
      "or all," \
      "found $suite" >&2
    exit 2
    ;;
esac
if [[ $suite == study && $# -ge 2 ]]; then
  [[ $2 == --quick ]] || { echo "bench: study: expected --quick, found $2" >&2; exit 2; }
  suite=study-slice
fi
study_peers() { # build/venv-study: solvers of others, and cyipopt against Debian's Ipopt
  scripts/setup.sh python3-dev python3-venv coinor-libipopt-dev pkg-config
  [[ -x build/venv-study/bin/python ]] || /usr/bin/python3 -m venv build/venv-study
  local peer
  for peer in numpy scipy casadi cyipopt drake osqp; do
    build/venv-study/bin/pip install --quiet --disable-pip-version-check "$peer" ||
      echo "bench: $peer cannot be installed" >&2
  done
}
study_models() { # SEED: scenes of others' meshes
  PYTHONPATH=$PWD/build/python build/venv/bin/python -B \
    results/bench/study_models.py build/models "build/study/models/$1" --seed "$1"
}
if [[ $suite == paper || $suite == all ]]; then
  scripts/build.sh paper_benchmark
  build/paper_benchmark --output results/paper
  python3 -B results/bench/paper_report.py --output results/paper
fi
if [[ $suite == queries || $suite == all ]]; then
  scripts/setup.sh libbenchmark-dev valgrind
  cmake --preset release -DPHONGPD_BUILD_QUERY_BENCHMARK=ON
  scripts/build.sh phongpd query_benchmark query_instructions tracker_benchmark
  scripts/count_queries.sh build/query_instructions > build/instructions.csv
  mv build/instructions.csv results/queries
  build/query_benchmark --output results/queries
  build/tracker_benchmark --output results/queries
  python3 -B results/bench/query_report.py --output results/queries
  python3 -B results/bench/tracker_report.py --output results/queries
fi
if [[ $suite == queries || $suite == continuity || $suite == all ]]; then
  scripts/models.sh build/models
  scripts/build.sh continuity_benchmark
  build/continuity_benchmark --output results/queries --models build/models \
    --motions 10 --frames 300
fi
if [[ $suite == contact-space || $suite == all ]]; then
  # The competitors compile for minutes: only here, and remembered in build/.
  scripts/setup.sh
  cmake --preset release -DPHONGPD_BUILD_COMPETITORS=ON
  scripts/build.sh contact_space_benchmark
  # Exit code 1, pairs that fail a check, is the report's to tell.
  build/contact_space_benchmark --output results/contact-space || (($? == 1))
  python3 -B results/bench/contact_space_report.py \
    --output results/contact-space
fi
if [[ $suite == lazy || $suite == all ]]; then
  scripts/build.sh lazy_benchmark culling_benchmark window_path_benchmark
  build/lazy_benchmark --output results/lazy --queries 60
  build/culling_benchmark --output results/lazy
  build/window_path_benchmark --output results/lazy
  python3 -B results/bench/lazy_report.py --output results/lazy
fi
if [[ $suite == convergence || $suite == all ]]; then
  scripts/build.sh phongpd convergence_benchmark
  rows=build/convergence
  rm -rf "$rows"
  . scripts/convergence_scenes.sh
  # Development looked at seeds 1 to 50 and from 1001 on.
  seed=101
  # One process a core: Ipopt's linear solver is not thread-safe.
  cores=$(nproc)
  shards() { # NAME ARGUMENTS...: compare in as many parts as there are cores
    local pids=() i
    for ((i = 0; i < cores; ++i)); do
      build/phongpd compare "${scenes[@]}" --seed "$seed" \
        --shard "$i/$cores" \
        --output "$rows/$1-$i" "${@:2}" &
      pids+=($!)
    done
    for i in "${pids[@]}"; do wait "$i"; done
  }
  shards straight --protocols straight-monotone straight-adaptive --metrics \
    euclidean phong@0 phong@0.05 phong@0.1 phong@0.2 phong@0.3
  shards exact --protocols straight-adaptive --metrics phong@0.2/exact \
    --runs 10
  shards repaired --protocols repaired-monotone repaired-adaptive pipeline \
    --metrics euclidean phong@0 phong@0.2
  # What the study alone follows, on fewer seeds.
  shards study --protocols straight-monotone straight-adaptive \
    repaired-monotone repaired-adaptive \
    --metrics followed mixed@0.2 faded@0.2 --runs 20
  # The order of the tables' columns.
  build/phongpd compare --output "$rows/all" --rows \
    "$rows"/{straight,exact,repaired,study}-*/rows.jsonl > "$rows/words"
  cp "$rows"/all/{rows,summary}.csv results/convergence
  build/convergence_benchmark --output results/convergence \
    --scenes "${scenes[@]}" --how "scripts/bench.sh convergence"
  python3 -B results/bench/convergence_report.py --output results/convergence
fi
if [[ $suite == study || $suite == study-further || $suite == study-models ||
  $suite == all ]]; then
  # results/study/protocol.md; parts that were cut off go on where they were.
  scripts/python.sh
  scripts/build.sh phongpd phongpd_python
  . scripts/study_scenes.sh
  block() { # FOLDER SEED RUNS METRICS...: of all `scenes`
    local pids=() i
    for ((i = 0; i < $(nproc); ++i)); do
      build/phongpd compare "${scenes[@]}" --seed "$2" \
        --runs "$3" --max-iter "$study_cap" --shard "$i/$(nproc)" \
        --protocols straight-monotone straight-adaptive repaired-monotone \
        repaired-adaptive --metrics "${@:4}" --output "$1-$i" &
      pids+=($!)
    done
    for i in "${pids[@]}"; do wait "$i"; done
  }
fi
if [[ $suite == study || $suite == all ]]; then
  scenes=("${study_scenes[@]}")
  runs=${STUDY_SEEDS:-10}
  block build/study/first "$study_seed" "$runs" "${study_metrics[@]}"
  build/venv/bin/python -B results/bench/study_report.py results/study \
    --rows build/study/first-*/rows.jsonl --how "Command: \`scripts/bench.sh \
study\`. Commit: $(git rev-parse --short HEAD)."
  build/venv/bin/python -B results/bench/study_power.py results/study \
    --measure build/phongpd
fi
if [[ $suite == study-further || $suite == all ]]; then
  # The second block of the protocol, beside the first one's metrics.
  scenes=("${study_scenes[@]}")
  block build/study/further "$study_seed" "${STUDY_SEEDS:-5}" \
    "${study_metrics[@]}" "${study_further[@]}"
  build/venv/bin/python -B results/bench/study_report.py results/study \
    --block further --rows build/study/further-*/rows.jsonl \
    --how "Command: \`scripts/bench.sh study-further\`. Commit: $(git rev-parse \
    --short HEAD)."
fi
if [[ $suite == study-models || $suite == all ]]; then
  # The protocol's last section.  More seeds: STUDY_MODELS_SEEDS=2.
  scripts/models.sh build/models
  for ((i = 0; i < ${STUDY_MODELS_SEEDS:-1}; ++i)); do
    seed=$((study_models_seed + i))
    folder=build/study/models/$seed
    study_models "$seed"
    scenes=("$folder"/*.json)
    block "$folder/rows" "$seed" 1 "${study_metrics[@]}"
  done
  cp "$folder/meshes.csv" results/study/models_meshes.csv
  build/venv/bin/python -B results/bench/study_report.py results/study \
    --block models --rows build/study/models/*/*/rows.jsonl \
    --how "Command: \`scripts/bench.sh study-models\`. Commit: $(git rev-parse \
    --short HEAD)."
fi
if [[ $suite == study-solvers || $suite == all ]]; then
  # results/study/solvers_protocol.md.
  scripts/python.sh
  scripts/build.sh phongpd_python
  . scripts/study_scenes.sh
  study_peers
  venv=build/venv-study
  # As for trajectories: what was interrupted goes on where it was.
  rows=build/study-solvers/$(git rev-parse HEAD)
  OPENBLAS_NUM_THREADS=1 PYTHONPATH=$PWD/build/python "$venv/bin/python" -B \
    results/bench/study_solvers.py "$rows/rows.jsonl" \
    --scenes "${study_scenes[@]}" --seed "$study_seed" \
    --runs "${STUDY_SEEDS:-1}"
  "$venv/bin/python" -B results/bench/study_solvers_report.py results/study \
    --rows "$rows/rows.jsonl" --how "Command: \`scripts/bench.sh study-solvers\`. \
Commit: $(git rev-parse --short HEAD). $(<"$rows/measured.txt")"
fi
if [[ $suite == study-slice ]]; then
  scripts/models.sh build/models
  scripts/python.sh
  scripts/build.sh phongpd phongpd_python
  . scripts/study_scenes.sh
  study_peers
  study_models "$study_models_seed"
  OPENBLAS_NUM_THREADS=1 PYTHONPATH=$PWD/build/python \
    build/venv-study/bin/python -B results/bench/study_slice.py results/study \
    --program build/phongpd --scenes "build/study/models/$study_models_seed" \
    --seed "$study_seed" --how "Command: \`scripts/bench.sh study --quick\`. \
Commit: $(git rev-parse --short HEAD)."
fi
if [[ $suite == pipeline || $suite == all ]]; then
  scripts/build.sh phongpd
  # A commit whose Ipopt solved its systems by MUMPS.
  scripts/compare_pipeline.sh a937fda build/phongpd results/convergence
fi
if [[ $suite == planning || $suite == all ]]; then
  scripts/build.sh planning_benchmark voxel_worlds_test
  PHONGPD_VOXEL_WORLDS=1700 build/tests/voxel_worlds_test |
    awk '/^solved/ { solved += $2; proved += $4; wrong += $6 }
      END { print solved " solved, " proved " proved infeasible, " wrong \
        " disagreements (PHONGPD_VOXEL_WORLDS=1700 voxel_worlds_test)" }' \
      > results/planning/voxel_worlds.txt
  build/planning_benchmark --output results/planning
  python3 -B results/bench/planning_report.py --output results/planning
fi
if [[ $suite == planning || $suite == widths || $suite == all ]]; then
  scripts/build.sh width_benchmark
  build/width_benchmark --output results/planning
  python3 -B results/bench/passages_report.py --output results/planning
fi
if [[ $suite == planning || $suite == retraction || $suite == all ]]; then
  scripts/build.sh retraction_benchmark
  build/retraction_benchmark --output results/planning --seeds 20
  python3 -B results/bench/passages_report.py --output results/planning
fi
if [[ $suite == extremes || $suite == all ]]; then
  # Every test program with a suite named *Campaign* takes part.
  mapfile -t tests < <(grep -rlE '^TEST(_[FP])?\([A-Za-z]*Campaign' tests \
    --include='*_test.cc' | xargs -n 1 basename -s .cc | sort)
  scripts/build.sh phongpd motion_set degradation_benchmark "${tests[@]}"
  logs=$PWD/build/extremes
  rm -rf "$logs"
  mkdir -p "$logs"
  campaign() { # TEST: its long form, at most a quarter of an hour
    local code=0 start=$SECONDS limit=900
    [[ $1 != voxel_pairs_test ]] || limit=18000 # a million plans, each twice
    PHONGPD_CAMPAIGN=long timeout "$limit" "build/tests/$1" \
      --gtest_filter='*Campaign*' > "$logs/$1.log" 2>&1 || code=$?
    echo "END $code $((SECONDS - start))" >> "$logs/$1.log"
    echo "$1: exit code $code, $((SECONDS - start)) s"
  }
  export -f campaign
  export logs
  printf '%s\n' "${tests[@]}" | xargs -P 2 -I{} bash -c 'campaign {}'
  # Exit code 1, wrong answers of ours, is the report's to tell.
  build/motion_set --output results/extremes || (($? == 1))
  build/degradation_benchmark --output results/extremes
  python3 -B results/bench/degradation_report.py --output results/extremes
  python3 -B results/bench/extremes_report.py --logs "$logs" \
    --output results/extremes --program build/phongpd \
    --how "scripts/bench.sh extremes"
fi
if [[ $suite == study-times || $suite == all ]]; then
  # Contact space, field and solves of 1, 10 and 100 problems; a quarter of an hour.
  scripts/python.sh
  scripts/build.sh phongpd_python
  . scripts/study_scenes.sh
  PYTHONPATH=$PWD/build/python build/venv/bin/python -B \
    results/bench/study_times.py results/study --scenes "${study_scenes[@]}" \
    --seed "$study_seed" --commit "$(git rev-parse --short HEAD)"
fi
if [[ $suite == cluster || $suite == all ]]; then
  scripts/python.sh
  scripts/build.sh phongpd_python
  PYTHONPATH=$PWD/build/python build/venv/bin/python \
    results/bench/cluster_benchmark.py --output results/cluster \
    --how "scripts/bench.sh cluster"
fi
if [[ $suite == peers || $suite == all ]]; then
  # What wheels leave to the system: Open3D's.
  scripts/setup.sh python3-dev python3-venv libusb-1.0-0 libgl1 libegl1 libgomp1
  scripts/python.sh
  scripts/build.sh phongpd_python
  venv=build/venv-peers
  [[ -x $venv/bin/python ]] || /usr/bin/python3 -m venv "$venv"
  # One by one: a wheel that is not there is told, and keeps no other away.
  for peer in numpy manifold3d coal python-fcl mujoco trimesh rtree scipy \
    open3d-cpu casadi drake; do
    "$venv/bin/pip" install --quiet --disable-pip-version-check "$peer" ||
      echo "bench: $peer cannot be installed" >&2
  done
  PYTHONPATH=$PWD/build/python "$venv/bin/python" \
    results/bench/peers_benchmark.py --output results/peers \
    --how "scripts/bench.sh peers"
  "$venv/bin/python" results/bench/peers_motions.py --output results/peers \
    --how "scripts/bench.sh peers"
fi
if [[ $suite == trajectories || $suite == all ]]; then
  scripts/setup.sh python3-dev python3-venv
  scripts/python.sh
  scripts/build.sh phongpd_python
  venv=build/venv-trajectories
  [[ -x $venv/bin/python ]] || /usr/bin/python3 -m venv "$venv"
  for peer in numpy scipy python-fcl ruckig toppra ompl drake; do
    "$venv/bin/pip" install --quiet --disable-pip-version-check "$peer" ||
      echo "bench: $peer cannot be installed" >&2
  done
  # Rows of an earlier commit would be taken for this one's; those of a run that
  # was interrupted stay.
  rows=build/trajectories/$(git rev-parse HEAD)
  OPENBLAS_NUM_THREADS=1 PYTHONPATH=$PWD/build/python "$venv/bin/python" \
    results/bench/trajectories_benchmark.py --output results/trajectories \
    --rows "$rows" --how "scripts/bench.sh trajectories" \
    --commit "$(git rev-parse --short HEAD)"
fi
if [[ $suite == fleets || $suite == all ]]; then
  scripts/build.sh fleet_benchmark
  build/fleet_benchmark --output results/fleets
  python3 -B results/bench/fleet_report.py --output results/fleets
fi
if [[ $suite == rigid || $suite == all ]]; then
  scripts/setup.sh python3-dev python3-venv
  scripts/python.sh
  scripts/build.sh rigid_judge_benchmark rigid_plan_benchmark phongpd_python
  venv=build/venv-rigid
  [[ -x $venv/bin/python ]] || /usr/bin/python3 -m venv "$venv"
  for peer in numpy scipy ompl ipctk hpp-core hpp-python; do
    "$venv/bin/pip" install --quiet --disable-pip-version-check "$peer" ||
      echo "bench: $peer cannot be installed" >&2
  done
  # As above.  `scripts/bench.sh rigid --long` runs what takes days.
  rows=build/rigid/$(git rev-parse HEAD)
  # The wheel of hpp-python does not find its libraries by itself.
  LD_LIBRARY_PATH=$(echo "$venv"/lib/python3*/site-packages/cmeel.prefix/lib) \
    PYTHONPATH=$PWD/build/python "$venv/bin/python" -B \
    results/bench/rigid_peers.py --output results/rigid --rows "$rows"
  PYTHONPATH=$PWD/build/python "$venv/bin/python" -B \
    results/bench/rigid_ompl2.py --output results/rigid --rows "$rows" \
    --jobs "$(nproc)"
  python3 -B results/bench/rigid_benchmark.py --output results/rigid \
    --rows "$rows" --jobs "$(nproc)" --how "scripts/bench.sh rigid${2:+ ${*:2}}" \
    --commit "$(git rev-parse --short HEAD)" "${@:2}"
fi
if [[ $suite == rigid-ompl-app ]]; then
  scripts/build.sh phongpd
  python3 -B results/bench/rigid_ompl_app.py "${2:?expected the folder resources/3D}" \
    --output results/rigid --rows "build/rigid-ompl-app/$(git rev-parse HEAD)" \
    --commit "$(git rev-parse --short HEAD)"
fi
if [[ $suite == rigid-optimize || $suite == all ]]; then
  scripts/build.sh rigid_optimize_benchmark
  folder=results/rigid-optimize
  # Development looked at seeds 1 to 10.
  build/rigid_optimize_benchmark --seed 101 --limit 20 \
    --methods samples both > "$folder/rows.jsonl"
  echo "Command: \`scripts/bench.sh rigid-optimize\`. Commit:" \
    "$(git rev-parse --short HEAD). Machine: $(nproc) cores, shared." \
    > "$folder/measured.txt"
  python3 -B results/bench/rigid_optimize_report.py --output "$folder"
fi
if [[ $suite == wrench || $suite == all ]]; then
  # `scripts/bench.sh wrench --quick`: a few pairs, and not where it is published.
  scripts/build.sh wrench_benchmark example_09_peg_force
  folder=results/rigid-depth some=()
  if [[ ${2:-} == --quick ]]; then
    folder=build/rigid-depth some=(--pairs 3 --steps 16 --lengths 3)
  fi
  build/wrench_benchmark --output "$folder" "${some[@]}"
  build/examples/09_peg_force examples/peg.off examples/hole.off \
    "$folder/peg_force.csv"
  python3 -B results/bench/wrench_report.py --output "$folder"
fi
if [[ $suite == python || $suite == all ]]; then
  scripts/python.sh
  scripts/build.sh phongpd_python python_baseline
  PYTHONPATH=build/python build/venv/bin/python \
    results/bench/python_benchmark.py --baseline build/python_baseline \
    --output results/python --how "scripts/bench.sh python"
fi
if [[ $suite == slice ]]; then
  scripts/build.sh reproduction
  build/reproduction --output results --how "scripts/bench.sh slice"
fi
# Last: it draws what the others measured, too.
if [[ $suite == trade || $suite == all ]]; then
  scripts/build.sh trade_benchmark defaults_benchmark budget_benchmark
  build/trade_benchmark --output results/trade --seeds 2
  . scripts/convergence_scenes.sh
  build/defaults_benchmark --output results/trade --scenes "${scenes[@]}"
  python3 -B results/bench/defaults_report.py --output results/trade
  # More problems of each pair: TRADE_SEEDS=10 scripts/bench.sh trade.
  rm -f results/trade/budget.csv results/trade/budget_measured.txt
  build/budget_benchmark --output results/trade --seeds "${TRADE_SEEDS:-2}"
  python3 -B results/bench/budget_report.py --output results/trade
  python3 -B results/bench/trade_report.py --output results/trade
fi
