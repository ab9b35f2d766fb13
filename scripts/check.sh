#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# check.sh [quick|full|SECTION...]: what the tests do not see.  quick is what CI
# runs after them, full takes everything; a section named by itself is the whole
# of it unless SLICE=quick.  Installs the tools it needs, only those missing.
#   format       clang-format over every source
#   options      every switch configures; outside projects take each way in
#   clang        clang compiles the tree, warnings as errors
#   cppcheck     no report but those .cppcheck-suppressions explains
#   tidy         clang-tidy, by .clang-tidy
#   fptrap       tests with invalid floating-point operations trapped
#   determinism  the same bytes again, with one thread and two, by gcc and clang
#   tsan         tests with TBB's loops on plain threads, thread sanitizer
#   readme       every block of README and docs, compiled and run as it stands, and
#                the walk-throughs from nothing
#   docs         the pages, warnings as errors
#   fuzz         scripts/fuzz.sh for a while
#   coverage     lines and branches, to results/extremes/coverage.md
#   asan         tests with address and undefined-behaviour sanitizers
#   packages     wheel and Debian packages, tried in roots of their own; what
#                zsh, fish, man and groff say of completion and manual
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# The user's own cache is neither used nor filled.
export PHONGPD_CACHE_DIR=$PWD/build/cache

readonly all=(format options clang cppcheck tidy fptrap determinism readme docs
  tsan fuzz coverage asan packages)
# Not tsan, coverage and packages, which compile the library once more each, and
# docs.
readonly quick=(format options clang cppcheck tidy fptrap determinism readme
  fuzz asan)
readonly folders=(files core constraints planners problems viewer)
# Whole test programs that reach every folder below the program and build fast.
readonly slice=(
  collision_oracle_test non_penetration_test signed_metric_test
  contact_space_test contact_space_cache_test zero_edges_test
  triangle_bvh_inside_test mesh_check_test mesh_io_refusal_test mesh_io_test
  mesh_repair_test triangle_bvh_segments_test triangle_mesh_test
  branch_walk_test cubic_test euclidean_metric_test normal_field_test
  phong_field_test phong_metric_test query_cost_test tangent_plane_field_test
  tangent_plane_projection_test
  contact_roadmap_test contact_surface_planner_test free_cells_test
  free_space_test start_repair_test workspace_test
  motion_graph_test retraction_test scene_errors_test scene_mutations_test
)
# Of those, what quick builds for the address sanitizer: of each folder something,
# and little of what the fuzzers run under it already.
readonly sanitized=(
  collision_oracle_test contact_roadmap_test contact_space_cache_test
  contact_space_test contact_surface_planner_test euclidean_metric_test
  free_cells_test mesh_repair_test motion_graph_test non_penetration_test
  phong_field_test phong_metric_test retraction_test scene_errors_test
  start_repair_test triangle_bvh_inside_test triangle_mesh_test zero_edges_test
)
# Of these the tests that do the same thousands of times: half of all the time, and
# next to nothing that the sanitizers see only then.
readonly repeating=(
  ContactRoadmap.PassesWhateverIsWideEnough
  ContactSpace.SeparatesFreeFromHitForGenericSolids
  ContactSurfacePlanner.PassesWhateverIsWideEnough
  PhongField.IsAdmissibleForEverySmoothingLength
  PhongMetric.ColdQueryIsTheLeastDepthOfAllTriangles
  PhongMetric.HitIsAProjectionAndNotShallowerThanEuclidean
  PhongMetric.QueryAllListsEveryProjectionWithinTheBoundOnce
  RepairSolid.RefusesWhatOnlyAWrapCanMend
  StartRepair.FreesEveryPathOfTheFamilies
)
# Those, besides, that feed what is no number, or next to none.
readonly extreme=(
  fuzz_corpus_test path_resampling_test range_test reader_limits_test
  shapes_test stale_branches_test
)
# Those whose code under test runs in several threads; some of the others count
# allocations, which the thread sanitizer does itself.
readonly threaded=(
  contact_space_test convolution_cells_test exact_surface_test
  mesh_approximation_test query_cost_test query_batch_test
  self_intersection_test contact_roadmap_test contact_surface_planner_test
  contact_space_handle_test window_planner_test world_test
)

say() { printf 'check: %s\n' "$*"; }
whole() { [[ $SLICE == full ]]; }
sources() { find "${folders[@]}" tests results examples python -name '*.h' -o -name '*.cc'; }

# Runs the test programs that are built there: those outside the slice are not,
# and what is no program of ours says nothing about the preset.
run_tests() { # PRESET [PATTERN to leave out] [OPTION of ctest...]
  ctest --preset "$1" --parallel 2 --no-tests=error -L '_tests?$' \
    -E "_NOT_BUILT${2:+|$2}" "${@:3}"
}

# The cases of the test files named, as a pattern of ctest's: they are in one
# program with others of their folder, or in one of their own.
cases_of() { # NAME_test...
  local files
  files=$(for name; do find tests -name "$name.cc"; done)
  printf '(^|/)(%s)[.]' "$(sed -nE 's/^TEST(_[FP])?\((\w+),.*/\2/p' $files |
    sort -u | paste -sd '|')"
}

build_tests() { # PRESET PROGRAMS...: everything in full
  local programs=("${@:2}")
  if whole; then programs=(); fi
  PRESET=$1 scripts/build.sh "${programs[@]}"
}

# Compiler commands of the folders named, one a line, from build-clang/; without
# what a build writes there first.
compile_commands() { # [-DOPTION...] FOLDER...
  scripts/setup.sh clang
  local options=() pattern
  while [[ $1 == -D* ]]; do
    options+=("$1")
    shift
  done
  cmake --preset clang "${options[@]}" >/dev/null
  pattern=$(IFS='|' && echo "$*")
  sed -n 's/^  "command": "\(.*\)",$/\1/p' build-clang/compile_commands.json |
    sed 's/\\"/"/g; s/\\\\/\\/g' | grep -E " $PWD/(build-clang/)?($pattern)/" |
    while IFS= read -r command; do
      [[ ! -e ${command##* } ]] || printf '%s\n' "$command"
    done
}

check_format() {
  scripts/setup.sh clang-format
  sources | xargs clang-format --dry-run -Werror
}

check_options() {
  local log=build/check/options.log part one running=()
  local parts=(CORE CONSTRAINTS ORACLE PLANNERS IPOPT OMPL SOLVE SHAPES PROBLEMS
    STUDIES VIEWER PROGRAM EXAMPLES TESTS RESULTS)
  rm -rf build/check/options
  mkdir -p build/check/options
  configured() { # PLACE MESSAGE OPTION...
    cmake -S . -B "$1" "${@:3}" >"$1.log" 2>&1 &&
      grep -q "Generating done" "$1.log" && grep -q -- "$2" "$1.log" ||
      { cat "$1.log"; say "options ${*:3}: expected '$2'"; return 1; }
  }
  # One on each processor.
  configures() { # MESSAGE OPTION...
    say "options ${*:2}"
    while (($(jobs -rp | wc -l) >= $(nproc))); do sleep 0.1; done
    configured "build/check/options/${#running[@]}" "$@" &
    running+=($!)
  }
  # What is switched off, and what is said of that which stands on it.
  local -A above=([CORE]=phongpd::constraints [CONSTRAINTS]=phongpd::planners
    [ORACLE]=phongpd::studies [PLANNERS]=phongpd::ipopt
    [IPOPT]=phongpd::solve [OMPL]=phongpd::solve
    [SOLVE]=phongpd::studies [SHAPES]=phongpd::problems
    [PROBLEMS]=phongpd::studies [STUDIES]="the program"
    [VIEWER]="the program"
    [PROGRAM]="the tests")
  local none=()
  for part in "${parts[@]}"; do
    configures "${above[$part]:+Not built for want of.*: }${above[$part]:-}" \
      "-DPHONGPD_BUILD_$part=OFF"
    none+=("-DPHONGPD_BUILD_$part=OFF")
  done
  configures "" "${none[@]}"
  # What is not installed.
  for part in fcl ompl CLI11 nlohmann_json GTest assimp tinyxml2; do
    configures "Not built for want of .*the package" \
      "-DCMAKE_DISABLE_FIND_PACKAGE_$part=ON"
  done
  PKG_CONFIG_LIBDIR=/nonexistent configures \
    "Not built for want of the package coinor-libipopt-dev.*: phongpd::ipopt"
  configures "Not built for want of the package libjs-three" \
    -DPHONGPD_THREE_JS=
  for one in "${running[@]}"; do wait "$one"; done

  # Outside projects; the tests build the one of the installed package.
  takes() { # WAY OPTION...
    say "options taken by $1"
    rm -rf "build/check/$1"
    cmake -S tests/consumer -B "build/check/$1" -DWAY="$1" \
      -DPHONGPD_SOURCE="$PWD" "${@:2}" >"$log" 2>&1 &&
      cmake --build "build/check/$1" --parallel 2 >>"$log" 2>&1 ||
      { cat "$log"; return 1; }
  }
  takes subdirectory -DCOMPONENTS=core,ipopt,ompl -DCOMPILE_ONLY=ON
  if whole; then
    # Not optimised: it is compiled for this alone.
    takes fetch -DCOMPONENTS=core -DCMAKE_BUILD_TYPE=None
    build/check/fetch/use_core examples/cube.off examples/cube.off
  fi
}

# full builds, each source alone.  In quick what fuzz and asan do not build by
# clang as well, which is the library: the program, tests and benchmarks, in the
# groups of a build without a cache, by the front end only, which has all of the
# diagnostics.  The headers that all tests parse are parsed once.
check_clang() {
  scripts/setup.sh clang
  if whole; then PRESET=clang scripts/build.sh all benchmarks; return; fi
  local list=build/check/clang.commands count
  compile_commands -DCMAKE_DISABLE_PRECOMPILE_HEADERS=OFF \
    -DPHONGPD_UNITY_BUILD=ON -DPHONGPD_JOIN_TESTS=ON \
    problems/cli tests results examples >"$list.each"
  # Sources of groups are not compiled by themselves as well.
  sed -n 's/.* \(.*\/Unity\/.*\)/\1/p' "$list.each" |
    xargs sed -n 's/^#include "\(.*\)"$/\1/p' >"$list.grouped"
  awk 'NR == FNR { grouped[$1]; next } !($NF in grouped) && !seen[$NF]++' \
    "$list.grouped" "$list.each" >"$list.all"
  each() { (cd build-clang && tr '\n' '\0' |
    xargs -0 -n 1 -P "$(nproc)" bash -c); }
  sed -n 's/\( -x c++-header \)-o [^ ]* -c \(.*\)[.]cxx$/\1-o \2.pch -c \2.cxx/p' \
    "$list.all" | each
  grep -v -- ' -x c++-header ' "$list.all" |
    sed 's/ -o [^ ]* -c / -fsyntax-only -c /' >"$list"
  count=$(wc -l <"$list")
  say "clang: $count sources or groups of them"
  # One line each $((count / 10)) sources tells that it moves.
  awk -v every=$((count / 10)) '{ print }
    NR % every == 0 { print "echo check: clang: " NR " sources" }' "$list" | each
}

check_cppcheck() {
  scripts/setup.sh cppcheck
  cppcheck --std=c++17 --language=c++ --quiet --error-exitcode=1 -I . \
    --enable=warning,performance,portability \
    --suppressions-list=.cppcheck-suppressions "${folders[@]}" results
}

check_tidy() {
  scripts/setup.sh clang clang-tidy
  local files checks=()
  if whole; then
    files=$(compile_commands "${folders[@]}" | sed 's/.* //' |
      grep -v build-clang)
  else
    # In groups, which include sources to parse their headers once; those with
    # CGAL take minutes each, and those of core/minkowski half of what is left.
    checks=(--checks=-bugprone-suspicious-include)
    files=$(compile_commands -DPHONGPD_UNITY_BUILD=ON core constraints |
      sed -n 's/.* \(.*\/Unity\/.*\)/\1/p' | grep -v cgal |
      xargs grep -L /core/minkowski/)
  fi
  say "tidy: $(wc -w <<<"$files") sources or groups of them"
  # The count of what it left out in system headers is no news.
  xargs -n 1 -P "$(nproc)" clang-tidy -p build-clang --quiet "${checks[@]}" \
    <<<"$files" 2>build/check/tidy.errors || { cat build/check/tidy.errors; return 1; }
}

check_fptrap() {
  scripts/setup.sh binutils
  local programs=("${slice[@]}" "${extreme[@]}")
  # All of it, as CI has it by then: programs hold the tests of whole folders.
  PRESET=release scripts/build.sh
  local log=$PWD/build/check/invalid.log only=()
  rm -f "$log"
  whole || only=(-R "$(cases_of "${programs[@]}")")
  g++ -shared -fPIC -O1 tests/support/trap_invalid.cc -o build/trap_invalid.so
  # Those that limit files and memory, or preload something themselves, limit
  # the trap's log, too.
  PHONGPD_INVALID_LOG=$log LD_PRELOAD=$PWD/build/trap_invalid.so \
    run_tests release '^CliLimits|^CliFault' "${only[@]}"
  # Tests feed NaN on purpose: no word at all means no trap at all.
  [[ -s $log ]]
  # Functions of ours that did one; tests themselves may.
  sort -u "$log" | while read -r file offset; do
    [[ $file == /* ]] || file=build/$file  # the program under its plain name
    addr2line -f -C -e "$file" "$offset" | head -n 1
  done | sort | uniq -c >build/check/invalid.functions
  local ours
  ours=$(grep 'phongpd::' build/check/invalid.functions |
    grep -v '_Test::TestBody' |
    grep -vEf <(grep -v '^#' tests/invalid_operations.txt)) || return 0
  say "fptrap: invalid operations where none are expected:"
  cut -c 1-160 <<<"$ours"
  return 1
}

check_determinism() {
  scripts/build.sh phongpd
  local programs=(build/phongpd)
  if whole; then
    PRESET=clang scripts/build.sh phongpd
    programs+=(build-clang/phongpd)
  fi
  scripts/determinism.sh "$(if whole; then echo 10; else echo 2; fi)" \
    "${programs[@]}"
}

# That from C++ compiles the core once more; a root of their own takes minutes.
check_readme() {
  scripts/readme.sh
  if whole; then
    scripts/walkthroughs.sh --root
  else
    scripts/walkthroughs.sh research gantry
  fi
}

check_docs() { scripts/docs.sh; }

check_tsan() {
  scripts/setup.sh clang libclang-rt-14-dev
  PRESET=tsan scripts/build.sh "${threaded[@]}"
  TSAN_OPTIONS=halt_on_error=1 run_tests tsan
}

check_fuzz() {
  if [[ ! -x scripts/fuzz.sh ]]; then
    say "fuzz: NOT RUN, THERE IS NO scripts/fuzz.sh"
    return
  fi
  if whole; then scripts/fuzz.sh 300s; return; fi
  # One seed: what a change breaks is seen, what chance finds is not its fault.
  FUZZ_SEED=1 scripts/fuzz.sh 15s
}

# Of the library alone, not of the program and the tests themselves.
check_coverage() {
  scripts/setup.sh gcovr
  build_tests coverage "${slice[@]}"
  find build-coverage -name '*.gcda' -delete
  run_tests coverage
  gcovr --root . --object-directory build-coverage --exclude-throw-branches \
    --filter '(files|core|constraints|planners)/' --csv build/check/coverage.csv
  mkdir -p results/extremes
  {
    # Headers once: not again by the link that users include them through.
    grep -v '^build-coverage/' build/check/coverage.csv |
      awk -F, -v slice="$SLICE" -f scripts/coverage.awk
    # From where they were compiled: paths may be relative to that.
    for folder in files core constraints planners planners/trajectory planners/solve; do
      (cd "build-coverage/$folder" && find CMakeFiles -name '*.gcda' | sort |
        xargs gcov --stdout --branch-probabilities --branch-counts \
          --demangled-names --relative-only --source-prefix "$OLDPWD" \
          2>/dev/null)
    done | awk -f scripts/derivatives.awk
  } >results/extremes/coverage.md
}

# Without undefined's object-size: the address sanitizer sees accesses beyond an
# object itself, and it takes an eighth of the time to compile.
check_asan() {
  scripts/setup.sh clang libclang-rt-14-dev
  build_tests asan "${sanitized[@]}"
  local left_out=
  whole || left_out="^($(IFS='|' && echo "${repeating[*]}"))\$"
  ASAN_OPTIONS=detect_stack_use_after_return=1:check_initialization_order=1 \
    UBSAN_OPTIONS=print_stacktrace=1 run_tests asan "$left_out"
}

# The core as a shared library: its SONAME is the minor version, and an outside
# project that links it runs where it was installed.
check_shared() {
  local none=() part place=$PWD/build/check/shared minor
  for part in ORACLE IPOPT OMPL SOLVE PROBLEMS VIEWER PROGRAM EXAMPLES TESTS RESULTS; do
    none+=("-DPHONGPD_BUILD_$part=OFF")
  done
  cmake -S . -B build-shared -D BUILD_SHARED_LIBS=ON "${none[@]}"
  cmake --build build-shared --parallel "$(nproc)"
  rm -rf "$place" && mkdir -p "$place"
  cmake --install build-shared --prefix "$place/installed" >/dev/null
  minor=$(sed -n 's/^  VERSION \([0-9]*\.[0-9]*\)\..*/\1/p' CMakeLists.txt)
  objdump -p "$place/installed/lib/libphongpd_core.so" |
    grep "SONAME *libphongpd_core[.]so[.]$minor\$"
  cp examples/*.cc examples/*.off packaging/examples/CMakeLists.txt "$place"
  cmake -S "$place" -B "$place/build" \
    -D CMAKE_PREFIX_PATH="$place/installed" >/dev/null
  cmake --build "$place/build"
  "$place/build/01_depth" "$place/cube.off" "$place/u.off" |
    grep 'Euclidean depth 0.3, out along 1 0 0'
}

check_packages() {
  check_shared
  # The tests leave out what is not there.
  scripts/setup.sh zsh fish man-db groff
  scripts/build.sh
  ctest --preset release --no-tests=error \
    -R "$(cases_of cli_completion_test cli_man_test)" \
    --output-log build/check/terminal.log
  if grep Skipped build/check/terminal.log; then return 1; fi
  scripts/wheel.sh --test
  scripts/deb.sh --test
}

case ${1:-quick} in
  quick) sections=("${quick[@]}") SLICE=quick ;;
  full) sections=("${all[@]}") SLICE=full ;;
  *) sections=("$@") SLICE=${SLICE:-full} ;;
esac
export SLICE
for section in "${sections[@]}"; do
  if ! declare -F "check_$section" >/dev/null; then
    echo "check: expected quick, full or one of ${all[*]}, found $section" >&2
    exit 2
  fi
done
mkdir -p build/check
if [[ $# -eq 1 && ${#sections[@]} -eq 1 ]]; then
  "check_$1"
  say "$1 ($SLICE) passed after $SECONDS s"
  exit 0
fi

# Seconds of processor time that finished children took.
used() { awk 'END { split($1 " " $2, t, /[ms ]+/)
  print int(60 * t[1] + t[2] + 60 * t[3] + t[4]) }' build/check/times; }
passed=0 failed=0
printf '%-12s %-7s %8s %8s\n' section result 'wall s' 'cpu s' \
  >build/check/summary
for section in "${sections[@]}"; do
  say "$section ($SLICE) begins after $SECONDS s"
  times >build/check/times
  wall=$SECONDS cpu=$(used) result=passed
  scripts/check.sh "$section" || result=FAILED
  [[ $result == passed ]] && passed=$((passed + 1)) || failed=$((failed + 1))
  times >build/check/times
  printf '%-12s %-7s %8d %8d\n' "$section" "$result" $((SECONDS - wall)) \
    $(($(used) - cpu)) | tee -a build/check/summary
done
cat build/check/summary
say "$passed passed, $failed failed"
((failed == 0))
