#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# release.sh --check [quick]: the release checklist, each item "ok" or "NO", or "--"
# with the reason where it cannot be tried here or not yet; exit code 1 if any is
# "NO".  quick leaves out what takes minutes.  Nothing is published, tagged or
# changed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

readonly log=build/release.log
failed=0
item() { # TEXT COMMAND...
  local text=$1
  shift
  if "$@" >>"$log" 2>&1; then
    echo "ok  $text"
  else
    echo "NO  $text"
    failed=$((failed + 1))
  fi
}

# No failure, but no success either, and said so.
not_tried() { # TEXT REASON
  echo "--  not tried: $1: $2"
}

version() { sed -n 's/^  VERSION \([0-9.]*\)$/\1/p' CMakeLists.txt; }
agrees() { cmake -D SOURCE="$PWD" -P tests/packaging/versions_test.cmake; }
is_dated() { grep -qE "^## $(version) \([0-9]{4}-[0-9]{2}-[0-9]{2}\)$" CHANGELOG.md; }
is_clean() { git status --porcelain && [[ ! $(git status --porcelain) ]]; }
is_new() { ! git rev-parse --verify --quiet "refs/tags/v$(version)"; }
recipe_parses() {
  scripts/setup.sh python3-yaml
  /usr/bin/python3 - <<'END'
import yaml
recipe = yaml.safe_load(open("packaging/conda/recipe.yaml"))
for output in recipe["outputs"]:
    assert output["package"]["name"] and output["requirements"]["host"]
END
}
# The recipes can say where the released source is, and its checksum, only once it is
# there: the last step below.
is_placed() {
  ! grep -nE 'example\.invalid|0{40}' packaging/conda/recipe.yaml \
    packaging/vcpkg/phongpd/portfile.cmake
}

# What is under two licences that the FSF holds incompatible says in every form
# that it is handed on in what is permitted.
permits_ipopt() {
  local told permission file
  permission='grant you additional permission to'
  for file in LICENSE-EXCEPTION packaging/debian/copyright; do
    tr -s ' \n' ' ' <"$file" | grep -qF "$permission" || return 1
  done
  for told in README.md packaging/conda/recipe.yaml \
    packaging/vcpkg/phongpd/portfile.cmake; do
    grep -qF LICENSE-EXCEPTION "$told" || return 1
  done
  grep -qF "## What may be handed on" docs/install.md
}

has_docker() { docker info; }
# As docs/install.md has it, with a first answer: of the cube, in the U.
image_runs() {
  docker build -f packaging/Dockerfile -t phongpd:check . &&
    docker run --rm -v "$PWD/examples:/data:ro" -w /data phongpd:check \
      depth cube.off u.off --at 0.5 0.5 0.5 | grep -F 'depth 0.2,'
}
# What an editor would do with it: the image, and the command after.
devcontainer_sets_up() {
  local image command
  image=$(sed -n 's/^ *"image": "\(.*\)",$/\1/p' .devcontainer/devcontainer.json)
  command=$(sed -n 's/^ *"postCreateCommand": "\(.*\)"$/\1/p' \
    .devcontainer/devcontainer.json)
  [[ $image && $command ]] &&
    docker run --rm -v "$PWD:/phongpd:ro" -w /phongpd "$image" $command
}

case "$*" in
  --check | '--check quick') ;;
  *) echo "release: expected --check or --check quick, found '$*'" >&2; exit 2 ;;
esac
mkdir -p build
: >"$log"
echo "Release checklist of PhongPD $(version); what failed is told in $log"
item "the version is the same everywhere" agrees
item "CHANGELOG.md begins with '## $(version) (YYYY-MM-DD)'" is_dated
item "there is no tag v$(version) yet" is_new
item "nothing is uncommitted" is_clean
item "the conda recipe parses" recipe_parses
if is_placed >>"$log"; then
  echo "ok  the recipes tell where the released source is"
else
  not_tried "the recipes tell where the released source is" \
    "it is nowhere yet; by hand, below"
fi
item "the permission to combine with Ipopt is in all that is shipped" \
  permits_ipopt
if [[ ${2:-} != quick ]]; then
  item "the tests pass (scripts/test.sh)" scripts/test.sh
  item "README's commands run (scripts/readme.sh)" scripts/readme.sh
  item "the pages build (scripts/docs.sh)" scripts/docs.sh
  item "sdist and wheel build and run (scripts/wheel.sh --test)" \
    scripts/wheel.sh --test
  item "Debian packages build and run (scripts/deb.sh --test)" \
    scripts/deb.sh --test
fi
readonly images="the Dockerfile builds and answers, the devcontainer sets up"
if [[ ${2:-} == quick ]]; then
  not_tried "$images" "takes minutes"
elif ! has_docker >>"$log" 2>&1; then
  not_tried "$images" "docker info finds no daemon here"
else
  item "the image of packaging/Dockerfile builds and answers" image_runs
  item "the devcontainer sets up" devcontainer_sets_up
fi
cat <<END
By hand, then:
  - git tag -a v$(version) -m "PhongPD $(version)" && git push origin v$(version)
  - Publish the source distribution, and no wheel or Debian package: those hold or
    load Ipopt beside CGAL's GPL packages (docs/install.md, "What may be handed
    on").
  - Fill source and checksum into the recipes, set the next version, and begin its
    "Unreleased (x.y.z)" part of CHANGELOG.md.
END
((failed == 0))
