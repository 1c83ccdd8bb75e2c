#!/usr/bin/env bash
# Checks the structure of a source tree: the law of includes (allowed.txt beside this file), slow
# headers in one file each, no file over 400 lines. Prints each breach; exit status 1 if there is one.
# Usage: check.sh [TREE]
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
table=$here/allowed.txt
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

awk '
  function breach(text) { print text; breaches++ }

  # the table
  FNR == NR {
    if ($0 ~ /^#/ || NF == 0) next
    name = $1
    sub(/:$/, "", name)
    if (name == "outside") { for (i = 2; i <= NF; i++) outside[$i] = 1; next }
    if (name == "once") { for (i = 2; i <= NF; i++) once[$i] = ""; next }
    for (i = 2; i <= NF; i++) {
      if (!($i in rooms)) breach(FILENAME ":" FNR ": " name " names " $i ", which is not above it")
      allowed[name, $i] = 1
    }
    rooms[name] = 1
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
      if (step[2] != room && !((room, step[2]) in allowed))
        breach(where room " may not include " header)
    } else if (quoted) {
      breach(where "\"" header "\": name it from its room, adit/ROOM/...")
    } else if (header ~ /[\/.]/ && header !~ /^(Eigen|tl)\// && !(room in outside)) {
      breach(where room " may not include " header ": only Eigen, tl::expected and the standard library")
    }
  }

  END { exit breaches > 0 }
' "$table" "${files[@]}"
echo "layering: ${#files[@]} files keep the law"
