#!/usr/bin/env bash
# Whether two builds of the command give the same answers, byte for byte: tracking, relocation and
# surveys on real and simulated logs. For changes that must not change what the estimator says.
# Usage: same_answers.sh ADIT_BEFORE ADIT_AFTER [CASE...]; without a case all are compared.
# Real logs are read from the folder that ADIT_DATA names, ../shared/data by default.
set -euo pipefail

before=$(realpath "$1")
after=$(realpath "$2")
shift 2
data=${ADIT_DATA:-$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)/../shared/data}
data=$(realpath "$data")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# Worlds are made once, by the build after: simulators may differ, estimators must not.
simulated() {
  local name=$1
  shift
  [ -d "$scratch/$name" ] || "$after" simulate "$@" -o "$scratch/$name" >/dev/null
}

intel() {
  "$1" localize --map "$data/intel/map.csv" --log "$data/intel/log.clf" --start 4.78,-5.84,-96.83 -o "$2"
}

mockup() {
  simulated mockup mockup --seed 71 --clutter 8
  "$1" localize --map "$scratch/mockup/plan.csv" --log "$scratch/mockup/log.clf" \
    --config "$scratch/mockup/config.toml" -o "$2"
}

panel() {
  simulated panel panel --seed 72 --clutter 8 --sweep 0.1
  "$1" localize --map "$scratch/panel/plan.csv" --log "$scratch/panel/log.clf" \
    --config "$scratch/panel/config.toml" -o "$2"
}

niosh_drive() {
  simulated niosh "$data/mines/niosh.csv" --drive 60 --scanner sick --seed 73 --clutter 5
}

niosh_anywhere() {
  niosh_drive
  "$1" localize --map "$data/mines/niosh.csv" --log "$scratch/niosh/log.clf" \
    --config "$scratch/niosh/config.toml" --start anywhere -o "$2"
}

locate() {
  simulated niosh_short "$data/mines/niosh.csv" --drive 8 --scanner sick --seed 75 --clutter 5
  mkdir -p "$2"
  "$1" locate --map "$data/mines/niosh.csv" --scan "$scratch/niosh_short/log.clf:all" \
    --config "$scratch/niosh_short/config.toml" --json | sed 's/"elapsed_s": *[0-9.e+-]*//' >"$2/poses.json"
}

survey() {
  mkdir -p "$2"
  local logs=("$data"/fr-clinic/*.clf)
  "$1" survey --log "${logs[0]}" --trajectory "$2/trajectory.tum" -o "$2/plan.csv"
}

known_positions() {
  simulated stations panel --seed 74 --scanner cyclone --clutter 5
  [ -f "$scratch/positions.tum" ] || {
    awk 'NR % 12 == 1 { print $1, $2, $3, 0, 0, 0, 0, 1 }' "$scratch/stations/truth.tum" >"$scratch/positions.tum"
    awk 'FILENAME ~ /positions/ { known[$1 + 0] = 1; next }
      /^ROBOTLASER1/ { if (($(NF - 2) + 0) in known) print; next } { print }' \
      "$scratch/positions.tum" "$scratch/stations/log.clf" >"$scratch/stations.clf"
  }
  mkdir -p "$2"
  "$1" survey --log "$scratch/stations.clf" --config "$scratch/stations/config.toml" \
    --poses "$scratch/positions.tum" --trajectory "$2/trajectory.tum" -o "$2/plan.csv"
}

cases=("$@")
if [ ${#cases[@]} -eq 0 ]; then
  cases=(intel mockup panel niosh_anywhere locate survey known_positions)
fi
differ=0
for name in "${cases[@]}"; do
  "$name" "$before" "$scratch/$name.before" >/dev/null
  "$name" "$after" "$scratch/$name.after" >/dev/null
  rm -f "$scratch/$name".{before,after}/timings.json
  files=$(cd "$scratch/$name.after" && for file in *; do
    cmp -s "$file" "../$name.before/$file" || printf ' %s' "$file"
  done)
  if [ -z "$files" ]; then
    echo "same    $name: $(find "$scratch/$name.after" -type f | wc -l) files"
  else
    differ=1
    echo "DIFFERS $name:$files"
  fi
done
exit $differ
