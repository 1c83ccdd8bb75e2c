#!/usr/bin/env bash
# Checks the structure of a source tree: the law of includes (allowed.txt beside this file), that it
# grants no more than is used, slow headers in one file each, no file over 400 lines. Prints each
# breach; exit status 1 if there is one.
# Usage: check.sh [TREE [TABLE]]
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
table=$(realpath "${2:-$here/allowed.txt}")
cd "${1:-$here/../..}"

folders=()
for folder in src apps bindings nodes bench fuzz tests; do
  if [ -d "$folder" ]; then folders+=("$folder"); fi
done
list=$(find "${folders[@]}" -type f \( -name '*.cpp' -o -name '*.hpp' \) | LC_ALL=C sort)
if [ -z "$list" ]; then
  echo "layering: no source file in $PWD"
  exit 1
fi
mapfile -t files <<<"$list"
libraries=()
if [ -f src/adit/CMakeLists.txt ]; then libraries=(src/adit/CMakeLists.txt); fi

awk '
  function breach(text) { print text; breaches++ }

  # the table
  FNR == NR {
    if ($0 ~ /^#/ || NF == 0) next
    name = $1
    sub(/:$/, "", name)
    if (name == "outside") {
      for (i = 2; i <= NF; i++) {
        outside[$i] = 1
        grants[++granted] = $i SUBSEP "another library"
        line_of[granted] = FNR
      }
      next
    }
    if (name == "once") { for (i = 2; i <= NF; i++) once[$i] = ""; next }
    for (i = 2; i <= NF; i++) {
      if (!($i in rooms)) breach(FILENAME ":" FNR ": " name " names " $i ", which is not above it")
      allowed[name, $i] = 1
      grants[++granted] = name SUBSEP $i
      line_of[granted] = FNR
    }
    rooms[name] = 1
    next
  }

  # the libraries: adit_module(room DEPENDS room... )
  FILENAME ~ /CMakeLists\.txt$/ {
    gsub(/[()]/, " & ")
    for (i = 1; i <= NF; i++) {
      if ($i ~ /^#/) break
      if ($i == "adit_module") { library = $(i + 2); depends = 0 }
      else if ($i ~ /^(PUBLIC|PRIVATE|\))$/) depends = 0
      else if ($i == "DEPENDS") depends = 1
      else if (depends && !((library, $i) in allowed))
        breach(FILENAME ":" FNR ": " library " may not depend on " $i)
    }
    next
  }

  FNR == 1 {
    parts = split(FILENAME, part, "/")
    room = ""
    if (part[1] == "src") {
      room = part[2] == "adit" && parts > 3 ? part[3] : "none"
      if (!(room in rooms)) breach(FILENAME ":1: lies in no room of the table")
    }
    is_test = FILENAME ~ /_test\.cpp$/
  }

  FNR == 401 { breach(FILENAME ":401: more than 400 lines: is a room missing?") }

  /^[ \t]*#[ \t]*include[ \t]*[<"]/ {
    quoted = $0 ~ /include[ \t]*"/
    header = $0
    sub(/^[^<"]*[<"]/, "", header)
    sub(/[>"].*$/, "", header)
    where = FILENAME ":" FNR ": "

    for (slow in once) {
      if (index(header, slow) != 1) continue
      if (once[slow] != "" && once[slow] != FILENAME)
        breach(where header " is already included by " once[slow])
      once[slow] = FILENAME
    }
    if (room == "" || is_test) next
    split(header, step, "/")
    if (step[1] == "adit") {
      used[room, step[2]] = 1
      if (step[2] != room && !((room, step[2]) in allowed))
        breach(where room " may not include " header)
    } else if (quoted) {
      breach(where "\"" header "\": name it from its room, adit/ROOM/...")
    } else if (header ~ /[\/.]/ && header !~ /^(Eigen|tl)\//) {
      used[room, "another library"] = 1
      if (!(room in outside)) breach(where room " may not include " header ": only Eigen, tl::expected and the standard library")
    }
  }

  END {
    for (i = 1; i <= granted; i++) {
      if (grants[i] in used) continue
      split(grants[i], grant, SUBSEP)
      breach(table ":" line_of[i] ": " grant[1] " is granted " grant[2] ", of which it includes nothing")
    }
    exit breaches > 0
  }
' table="${table##*/}" "$table" "${libraries[@]}" "${files[@]}"
echo "layering: ${#files[@]} files keep the law"
