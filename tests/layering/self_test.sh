#!/usr/bin/env bash
# Proves that check.sh can fail: small trees with one fault each, and one without.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failures=0
cases=0

# put FILE TEXT: a file of the next tree
put() {
  mkdir -p "$scratch/tree/$(dirname "$1")"
  printf '%b\n' "$2" >"$scratch/tree/$1"
}

# expect NAME PATTERN: the tree must be refused with a line that matches; `-` means it must pass. It
# is judged by the table in it, if there is one; else by the real one, of which it does not use all.
expect() {
  local name=$1 pattern=$2 output status=0 table=()
  if [ -f "$scratch/tree/allowed.txt" ]; then table=("$scratch/tree/allowed.txt"); fi
  output=$(bash "$here/check.sh" "$scratch/tree" "${table[@]}" 2>&1) || status=$?
  cases=$((cases + 1))
  if [ "$pattern" = - ]; then
    if [ $status -ne 0 ]; then failures=$((failures + 1)); echo "FAILED $name: $output"; fi
  elif [ $status -eq 0 ] || ! grep -qE "$pattern" <<<"$output"; then
    failures=$((failures + 1))
    echo "FAILED $name: expected /$pattern/, got status $status: $output"
  fi
  rm -rf "$scratch/tree"
}

# A lawful tree, to which a case may add.
lawful() {
  put allowed.txt "geometry:\nmap: geometry\nio: geometry map\noutside: io\nonce: CLI/ nlohmann/"
  put src/adit/CMakeLists.txt 'adit_module(map DEPENDS geometry)\nadit_module(io DEPENDS map\n  PRIVATE fmt)'
  put src/adit/map/map.hpp '#include <vector>\n#include <Eigen/Core>\n#include "adit/geometry/angle.hpp"'
  put src/adit/map/map_test.cpp '#include "adit/simulation/world.hpp"'
  put apps/main.cpp '#include <CLI/CLI.hpp>\n#include "adit/io/plan.hpp"'
  put src/adit/io/json.cpp '#include <nlohmann/json.hpp>\n#include "adit/map/map.hpp"'
  put src/adit/io/json.hpp '#include "adit/geometry/angle.hpp"'
}

lawful
expect 'a lawful tree' -

lawful
put src/adit/io/json.hpp 'int x;'
put src/adit/io/json_test.cpp '#include "adit/geometry/angle.hpp"'
expect 'a grant that only a test uses' 'allowed.txt:3: io is granted geometry, of which it includes nothing'

lawful
put src/adit/io/json.cpp '#include <string>\n#include "adit/map/map.hpp"'
expect 'a library granted in vain' 'allowed.txt:4: io is granted another library, of which it includes nothing'

lawful
put src/adit/CMakeLists.txt '# map\nadit_module(map PUBLIC Eigen3::Eigen DEPENDS\n  geometry io PRIVATE fmt)'
expect 'a library that depends on one above' 'CMakeLists.txt:3: map may not depend on io'

put src/adit/geometry/angle.hpp '#include "adit/map/map.hpp"'
expect 'an arrow upwards' 'angle.hpp:1: geometry may not include adit/map/map.hpp'

put src/adit/matching/matching.cpp '  #  include "adit/extraction/extraction.hpp"'
expect 'a side step between rooms' 'matching may not include'

put src/adit/localizer/localizer.cpp '#include "adit/io/plan.hpp"'
expect 'the core reading files' 'localizer may not include adit/io'

put src/adit/evaluation/report.cpp '#include "adit/simulation/world.hpp"'
expect 'evaluation that knows the simulator' 'evaluation may not include adit/simulation'

put src/adit/map/map.cpp '#include <fmt/core.h>'
expect 'an outside library in the core' 'map may not include fmt/core.h'

put src/adit/map/map.cpp '#include "../visibility/visibility.hpp"'
expect 'a path around the law' 'name it from its room'

put src/adit/attic/attic.cpp 'int x;'
expect 'an unknown room' 'lies in no room'

put src/adit/adit.cpp 'int x;'
expect 'a file outside the rooms' 'lies in no room'

put apps/a.cpp '#include <CLI/CLI.hpp>'
put apps/b.cpp '#include <CLI/CLI.hpp>'
expect 'a slow header twice' 'b.cpp:1: CLI/CLI.hpp is already included by apps/a.cpp'

put src/adit/map/map.cpp "$(printf 'int x;\\n%.0s' {1..401})"
expect 'a long file' 'map.cpp:401: more than 400 lines'

mkdir -p "$scratch/tree/src"
expect 'an empty tree' 'no source file'

echo "layering self-test: $((cases - failures)) of $cases cases as expected"
[ $failures -eq 0 ]
