#!/usr/bin/env bash
# The command from outside, as its users and their scripts meet it.
# Usage: cli_test.sh ADIT SCRATCH CASE; each function below is a case.
set -euo pipefail

adit=$1
scratch=$2/$3
rm -rf "$scratch"
mkdir -p "$scratch"
cd "$scratch"

die() {
  printf 'FAILED: %s\n' "$*" >&2
  [ -s err ] && sed 's/^/  stderr: /' err >&2
  exit 1
}

# expect STATUS ARG...: runs adit, its output in the files out and err
expect() {
  local wanted=$1 status=0
  shift
  "$adit" "$@" >out 2>err || status=$?
  [ "$status" -eq "$wanted" ] || die "status $status, not $wanted: adit $*"
}
# says PATTERN: what stderr must say
says() { grep -qE -- "$1" err || die "stderr does not say: $1"; }
prints() { grep -qE -- "$1" out || die "stdout does not say: $1"; }
absent() {
  local path
  for path in "$@"; do [ ! -e "$path" ] || die "$path was left behind"; done
}
there() {
  local path
  for path in "$@"; do [ -s "$path" ] || die "$path is absent or empty"; done
}
# in_range WHAT VALUE LOW HIGH
in_range() {
  awk -v x="$2" -v low="$3" -v high="$4" 'BEGIN { exit !(x != "" && x + 0 == x && x >= low && x <= high) }' ||
    die "$1 is $2, not in $3 to $4"
}
# json_number FILE OBJECT KEY: a number of an object at the top, of pretty-printed JSON; with an
# empty OBJECT, of the top itself
json_number() {
  awk -v object="$2" -v key="\"$3\":" '
    $1 == "\"" object "\":" && /{$/ { inside = 1 }
    /^  }/ { inside = 0 }
    $1 == key && (object == "" || inside) { sub(/,$/, "", $2); print $2; exit }' "$1"
}
lines_of() { grep -c '' "$1"; }
is_png() { [ "$(head -c 8 "$1" | od -An -tx1 | tr -d ' \n')" = 89504e470d0a1a0a ] || die "$1 is no PNG"; }
# room_plan FILE: a plan of one closed room
room_plan() { printf 'x1,y1,x2,y2\n0,0,8,0\n8,0,8,5\n8,5,3,5\n3,5,3,7\n3,7,0,7\n0,7,0,0\n' >"$1"; }

statuses() {
  expect 2
  expect 2 frobnicate
  expect 2 localize
  says '--map'
  expect 2 localize --map plan.csv
  says '--log'
  expect 2 simulate mockup
  expect 2 simulate mockup -o d --scanner nonsense
  absent d
  expect 2 simulate mockup -o d --clutter many
  expect 2 simulate mockup -o d --clutter -3
  expect 2 simulate mockup -o d --clutter-kind heaps
  local built
  for built in '' bend bend= bend=x bend=-1 bend=nan bend=0.1m bent=0.1 bend=0.1,bend=0.2 bend=0.1, reach=0 missing=1.5; do
    expect 2 simulate mockup -o d --as-built "$built"
  done
  expect 2 simulate mockup -o d --as-built bend=0.1,bent=0.1
  says "no key 'bent': bend, reach, rough"
  expect 2 simulate mockup -o d --as-built missing=1.5
  says 'missing=1.5 is no number from 0 to 1'
  for built in 1,2 1,2,x 1,2,3,4 1,2,nan 1,2,-3 1,2,0; do expect 2 simulate mockup -o d --off-plan "$built"; done
  expect 2 simulate mockup -o d --off-plan 10,15,100
  says 'nothing of the plan'
  absent d
  expect 2 evaluate --estimate e.tum
  expect 2 evaluate
  expect 2 map
  expect 2 map info
  expect 2 plot
  expect 2 plot map -o x.png
  expect 2 demo extra
  room_plan plan.csv
  expect 2 simulate plan.csv -o d --path p.tum --drive 10
  expect 2 simulate plan.csv -o d --fault freeze=20
  says "no key 'freeze'"
  expect 2 simulate plan.csv -o d --fault freeze_s=soon
  says "'soon' is no number for freeze_s"
  expect 2 simulate plan.csv -o d --fault dropouts=1.5
  expect 2 simulate plan.csv -o d --fault jumps=1,dropouts=1,jumps=2
  says "'jumps' is given twice"
  absent d
  expect 0 simulate --help
  prints 'odometry_scale: .*default: 0'
  prints 'mount_yaw_rad: .*rad'
  expect 0 --help
  prints 'localize'
  expect 0 localize --help
  prints 'degrees'
  expect 0 --version
  expect 0 config
  prints '^\[scanner\]'
  cp out config.toml
  expect 0 simulate mockup -o d
  for estimator in nonsense Full ''; do
    expect 2 localize --map d/plan.csv --log d/log.clf --estimator "$estimator" -o e
  done
  for start in 1,2 1,2,x 1,2,3,4 '' nan,0,0 1,2,3m; do
    expect 2 localize --map d/plan.csv --log d/log.clf "--start=$start" -o e
  done
  absent e
  expect 0 localize --map d/plan.csv --log d/log.clf --config config.toml -o e
}

# bad WHERE ARG...: a call that is right with input that is not
bad() {
  local where=$1
  shift
  expect 1 "$@"
  says "$where"
  [ "$(lines_of err)" -eq 1 ] || die "more than one line of complaint: adit $*"
  absent e picture.png
}

bad_input() {
  expect 0 simulate mockup -o d
  cd d
  printf '0,0,1,0\n1,0,1,1\nx,0,1\n' >letters.csv
  printf '0,0,1,0\n1,0,nan,1\n' >nan.csv
  printf '0,0,1,0\n1,0,1,1,\377\000\001\n' >binary.csv
  : >empty.csv
  printf '# nothing\n' >comments.csv
  local plan
  for plan in letters.csv:3 nan.csv:2 binary.csv empty.csv comments.csv absent.csv; do
    bad "$plan" localize --map "${plan%:*}" --log log.clf -o e
    bad "$plan" map info "${plan%:*}"
    bad "$plan" map check "${plan%:*}"
    bad "$plan" map convert "${plan%:*}" -o e
    bad "$plan" plot map --map "${plan%:*}" -o picture.png
    bad "$plan" simulate "${plan%:*}" --path truth.tum -o e
  done
  : >empty.clf
  head -c 3000 /dev/urandom >binary.clf
  printf 'FLASER 180 1 2 3\nODOM 0 0 0 0 0 0 1 h 1\n' >useless.clf
  local log
  for log in empty.clf binary.clf useless.clf absent.clf; do
    bad "$log" localize --map plan.csv --log $log -o e
    bad "$log" plot scan --scan $log:0 -o picture.png
  done
  bad 'log.clf.*16' plot scan --scan log.clf:16 -o picture.png
  printf '[scanner]\nrange_sigma_m = 0.1\n\n[scanner2]\nx = 1\n' >table.toml
  printf '[scanner]\nrange_sigma = 0.1\n' >key.toml
  printf '[scanner]\nmax_range_m = 50\nrange_sigma_m = "wide"\n' >type.toml
  printf '[scanner\n' >syntax.toml
  local toml
  for toml in table.toml:4 key.toml:2 type.toml:3 syntax.toml:1 absent.toml; do
    bad "$toml" localize --map plan.csv --log log.clf --config "${toml%:*}" -o e
    bad "$toml" simulate mockup --config "${toml%:*}" -o e
  done
  printf '1 2 3\n' >short.tum
  bad short.tum:1 evaluate --estimate short.tum --truth truth.tum
  bad short.tum:1 evaluate --estimate truth.tum --truth short.tum
  bad short.tum:1 simulate plan.csv --path short.tum -o e
  bad short.tum:1 plot trajectory --map plan.csv --trajectory short.tum -o picture.png
  printf '1 2 3\n' >short.relations
  bad short.relations:1 evaluate --estimate truth.tum --relations short.relations
  bad 'e' plot map --map plan.csv -o e/picture.png
  bad 'e.dxf' map convert plan.csv -o e.dxf
  absent e.dxf
  printf '[extraction]\nmin_operator_m = 0\n' >zero.toml
  bad 'zero.toml:2.*above 0' localize --map plan.csv --log log.clf --config zero.toml -o e
  bad 'at most 1000000' simulate panel --speed 1e-9 -o e

  # a bad line of a log is skipped, and counted
  { head -n 5 log.clf && printf 'ROBOTLASER1 0 nan\nROBOTLASER1 0 -3.1 6.2\n' && tail -n +6 log.clf; } >worse.clf
  expect 0 localize --map plan.csv --log worse.clf -o f
  grep -q '"scans": 16' f/report.json || die 'the good lines were not read'
  grep -A 5 '"warnings": \[' f/report.json | grep -q 'worse\|line\|2' || die 'no warning in the report'

  # outputs that cannot be written
  : >file
  bad file localize --map plan.csv --log log.clf -o file
  mkdir -p g/report.json
  bad report.json localize --map plan.csv --log log.clf -o g
  absent g/trajectory.tum g/estimates.csv g/last_pose.json g/timings.json
  bad file simulate mockup -o file/below
}

# judged ESTIMATE TRUTH MEAN MAX: evaluates, with bounds on the position error
judged() {
  expect 0 evaluate --estimate "$1" --truth "$2" --json
  in_range "mean error" "$(json_number out position mean)" 0 "$3"
  in_range "largest error" "$(json_number out position max)" 0 "$4"
  in_range "missing" "$(json_number out '' missing)" 0 0
}
# has_form FOLDER LOG: the files that localize leaves
has_form() {
  there "$1"/{trajectory.tum,estimates.csv,last_pose.json,report.json,timings.json}
  local scans
  scans=$(grep -c '^\(ROBOTLASER\|FLASER\)' "$2")
  head -n 1 "$1/estimates.csv" |
    grep -q '^t,x,y,theta,cov_xx,cov_xy,cov_xt,cov_yy,cov_yt,cov_tt,status,protection_m' ||
    die "the header of $1/estimates.csv"
  [ "$(lines_of "$1/estimates.csv")" -eq $((scans + 1)) ] || die "not one row for each of $scans scans"
  [ "$(grep -c '^[^#]' "$1/trajectory.tum")" -eq "$(awk -F, 'NR > 1 && $5 != "inf"' "$1/estimates.csv" | grep -c '')" ] ||
    die 'not one pose for each scan whose pose is known'
  awk 'NF != 8 { exit 1 }' "$1/trajectory.tum" || die 'a row of trajectory.tum has not 8 columns'
  awk -F, 'NR > 1 && ($1 !~ /^[0-9]+\.[0-9][0-9][0-9][0-9][0-9][0-9]$/ || $11 !~ /^(ok|degraded|ambiguous|lost)$/) { exit 1 }' \
    "$1/estimates.csv" || die "stamps or statuses of $1/estimates.csv"
  # a warning may have been met "3 times"
  ! grep -v ' times)' "$1/report.json" | grep -qiE 'micro|second|time|elapsed' || die 'report.json speaks of time'
  awk -F, 'NF != 18 { exit 1 }' "$1/estimates.csv" || die "a row of $1/estimates.csv has not 18 columns"
  grep -q microseconds "$1/timings.json" || die 'timings.json has no unit'
  local stage
  for stage in deskew prediction extraction matching estimation refinement cycle; do
    in_range "scans with $stage" "$(json_number "$1/timings.json" $stage scans)" 0 "$scans"
  done
  in_range 'median of a cycle' "$(json_number "$1/timings.json" cycle median)" 0.1 1e6
}
# world NAME MEAN MAX ARG...: simulate, localize, evaluate
world() {
  local name=$1 mean=$2 max=$3 start
  shift 3
  expect 0 simulate "$@" -o sim
  there sim/{plan.csv,log.clf,truth.tum,config.toml}
  start=$(first_pose sim/truth.tum)
  expect 0 localize --map sim/plan.csv --log sim/log.clf --config sim/config.toml --start "$start" -o out1
  has_form out1 sim/log.clf
  judged out1/estimates.csv sim/truth.tum "$mean" "$max"
  judged out1/trajectory.tum sim/truth.tum "$mean" "$max"
}
# first_pose TUM: as --start wants it
first_pose() {
  awk '/^[^#]/ { print $2 "," $3 "," atan2($7, $8) * 114.591559026; exit }' "$1"
}

mockup() {
  world mockup 0.04 0.25 mockup --clutter 8 --seed 5
  expect 0 evaluate --estimate out1/estimates.csv --truth sim/truth.tum --json
  in_range 'NEES per degree of freedom' "$(json_number out nees per_dof)" 0.3 3
  in_range 'rows that are ok' "$(json_number out by_status ok)" 15 16
  expect 0 evaluate --estimate out1/trajectory.tum --truth sim/truth.tum --json
  in_range 'rows of a bare trajectory that are ok' "$(json_number out by_status ok)" 0 0
  # without --start: the log's odometry begins at the first guess
  expect 0 localize --map sim/plan.csv --log sim/log.clf --config sim/config.toml -o out2
  judged out2/estimates.csv sim/truth.tum 0.05 0.3
  # without --config: what is not given is found in the log
  expect 0 localize --map sim/plan.csv --log sim/log.clf -o out3
  judged out3/estimates.csv sim/truth.tum 0.06 0.4
}

# Rough walls on a plan that idealises them.
panel() {
  world panel 0.10 0.4 panel --scanner sick --seed 3
  local learnt
  learnt=$(json_number out1/report.json map_error offset_sigma_m)
  in_range 'the error of the plan, as learnt' "$learnt" 0.05 0.4
  grep -A 5 '"map_error"' out1/report.json | grep -q 'then learnt from the residuals' ||
    die 'the report does not say where the error of the plan comes from'
  in_range 'protection level' "$(json_number out1/report.json protection_m median)" 0.05 1
  in_range 'rows without protection level' \
    "$(json_number out1/report.json certainty without_protection)" 0 0
  expect 0 evaluate --estimate out1/estimates.csv --truth sim/truth.tum --json
  in_range 'levels that were exceeded' "$(json_number out protection exceeded)" 0 2
}

drift() { world drift 0.35 1.2 drift --scanner sick --seed 3; }

# A scanner whose sweep takes its time, on the move: the wheels between the scans say how it moves.
sweep() {
  room_plan plan.csv
  printf '0 1 1 0 0 0 0 1\n1 6 1.5 0 0 0 0 1\n2 6.5 3.5 0 0 0 0.7071067812 0.7071067812\n3 1.5 4 0 0 0 1 0\n' >path.tum
  local drive="plan.csv --path path.tum --scanner hokuyo --speed 2 --odometry 0.02,0.5,0.02 --seed 2"
  # shellcheck disable=SC2086
  world standing 0.01 0.05 $drive
  local moment
  for moment in start middle; do
    printf '[scanner]\nstamp = "%s"\n' $moment >$moment.toml
    # shellcheck disable=SC2086
    world $moment 0.015 0.15 $drive --sweep 0.2 --config $moment.toml
    grep -q '^sweep_s = 0.2' sim/config.toml || die 'config.toml does not say how long a sweep takes'
    grep -q "^stamp = \"$moment\"" sim/config.toml || die 'config.toml does not say what the stamp names'
    in_range 'odometry messages for each scan' \
      $(($(grep -c ^ODOM sim/log.clf) / $(grep -c ^ROBOTLASER1 sim/log.clf))) 8 10
    # as if it were at rest: worse
    sed 's/^sweep_s = .*/sweep_s = 0.0/' sim/config.toml >still.toml
    expect 0 localize --map sim/plan.csv --log sim/log.clf --config still.toml \
      --start "$(first_pose sim/truth.tum)" -o still
    expect 0 evaluate --estimate still/estimates.csv --truth sim/truth.tum --json
    in_range 'mean error without the sweep' "$(json_number out position mean)" 0.025 10
  done
}

# Each estimator is what the report says, and the whole cycle is the default.
estimators() {
  expect 0 simulate panel --scanner sick --speed 4 --seed 6 -o sim
  local start estimator
  start=$(first_pose sim/truth.tum)
  local common="localize --map sim/plan.csv --log sim/log.clf --config sim/config.toml --start=$start"
  for estimator in features points full; do
    # shellcheck disable=SC2086
    expect 0 $common --estimator $estimator -o $estimator
    grep -q "\"estimator\": \"$estimator\"" $estimator/report.json || die "the report is not of $estimator"
    has_form $estimator sim/log.clf
  done
  judged features/estimates.csv sim/truth.tum 0.4 3
  judged points/estimates.csv sim/truth.tum 0.12 0.5
  judged full/estimates.csv sim/truth.tum 0.12 0.5
  # shellcheck disable=SC2086
  expect 0 $common -o default
  cmp full/estimates.csv default/estimates.csv
  ! cmp -s features/estimates.csv full/estimates.csv || die 'features and full are the same'
}

# Two lasers on one machine, the second coarser: each is taken for what it is.
two_lasers() {
  expect 0 simulate mockup --scanner hokuyo --seed 4 -o sim
  awk '/^ROBOTLASER1/ {
         print
         $1 = "ROBOTLASER2"
         for (i = 10; i < 10 + $9; i++) $i = 0.1 * int(10 * $i + 0.5)
       }
       { print }' sim/log.clf >both.clf
  expect 0 localize --map sim/plan.csv --log both.clf --start "$(first_pose sim/truth.tum)" -o out1
  has_form out1 both.clf
  judged out1/estimates.csv sim/truth.tum 0.08 0.4
  local laser
  for laser in 1:0.001 2:0.1; do
    grep -A 10 "\"laser\": \"ROBOTLASER${laser%:*}\"" out1/report.json |
      grep -q "\"quantisation_m\": ${laser#*:}," || die "the step of ROBOTLASER${laser%:*}"
  done
}

# A start that no scan can bear out is no crash: features alone are lost for good, all points look in
# the whole mine and trust nothing but the truth.
far_start() {
  expect 0 simulate mockup --seed 8 -o sim
  local start estimator
  for estimator in features points full; do
    for start in 500,-300,45 1e9,1e9,0 -1e300,1e300,1e300; do
      expect 0 localize --map sim/plan.csv --log sim/log.clf --config sim/config.toml --start=$start \
        --estimator $estimator -o out1
      has_form out1 sim/log.clf
      in_range 'scans that are lost' "$(json_number out1/report.json by_status lost)" 2 16
      if [ $estimator = features ]; then
        in_range 'scans that are lost' "$(json_number out1/report.json by_status lost)" 16 16
      else
        in_range 'scans that are trusted' "$(json_number out1/report.json by_status ok)" 8 14
        expect 0 evaluate --estimate out1/estimates.csv --truth sim/truth.tum --json
        in_range 'scans trusted wrongly' "$(json_number out '' confidently_wrong)" 0 0
      fi
    done
  done
}

# Stamps that go wrong are counted and reported, and every scan is answered.
odd_stamps() {
  expect 0 simulate mockup --speed 1 --seed 8 -o sim
  # the tenth scan stands twice, the twentieth comes after the twenty-first, the thirtieth to
  # fiftieth are missing, and from the sixtieth on the clock is another
  awk '!/^ROBOTLASER1/ { next }
       { n++ }
       n == 20 { late = $0; next }
       n >= 30 && n < 50 { next }
       n >= 60 { $(NF - 2) = sprintf("%.3f", $(NF - 2) + 1e6) }
       { print }
       n == 10 { print }
       n == 21 { print late }' sim/log.clf >odd.clf
  expect 0 localize --map sim/plan.csv --log odd.clf --config sim/config.toml \
    --start "$(first_pose sim/truth.tum)" -o out1
  has_form out1 odd.clf
  prints 'stamps: 1 twice, 1 late, 1 after a gap, 1 after a jump'
  local key
  for key in duplicates late gaps jumps; do
    in_range "$key" "$(json_number out1/report.json stamps $key)" 1 1
  done
  # the rest of the run is as good as ever
  expect 0 evaluate --estimate out1/estimates.csv --truth sim/truth.tum --json
  in_range 'largest error' "$(json_number out position max)" 0 0.25
}

plan_with_path() {
  room_plan plan.csv
  printf '0 1 1 0 0 0 0 1\n1 6 1.5 0 0 0 0 1\n2 6.5 3.5 0 0 0 0.7071067812 0.7071067812\n3 1.5 4 0 0 0 1 0\n' >path.tum
  world plan 0.03 0.2 plan.csv --path path.tum --scanner hokuyo --speed 0.8 --odometry 0.02,0.5,0.02 --seed 2
  cmp plan.csv <(printf 'x1,y1,x2,y2\n' && grep -v x1 sim/plan.csv) || die 'the plan changed on the way'
}

repeat() {
  expect 0 simulate mockup --clutter 8 --seed 11 -o a
  expect 0 simulate mockup --clutter 8 --seed 11 -o b
  expect 0 simulate mockup --clutter 8 --seed 12 -o c
  local file folder
  for file in plan.csv log.clf truth.tum config.toml; do cmp a/$file b/$file; done
  ! cmp -s a/log.clf c/log.clf || die 'the seed changes nothing'
  expect 0 localize --map a/plan.csv --log a/log.clf --config a/config.toml -o one
  expect 0 localize --map a/plan.csv --log a/log.clf --config a/config.toml -o two
  for file in estimates.csv report.json trajectory.tum; do cmp one/$file two/$file; done
  # with a sweep, and what the cycle learns on the way
  expect 0 simulate panel --scanner sick --speed 5 --sweep 0.2 --seed 5 -o d
  for folder in three four; do
    expect 0 localize --map d/plan.csv --log d/log.clf --config d/config.toml \
      --start "$(first_pose d/truth.tum)" -o $folder
  done
  for file in estimates.csv report.json trajectory.tum; do cmp three/$file four/$file; done
  # over a result that is there
  expect 0 localize --map a/plan.csv --log a/log.clf --config a/config.toml -o one
  cmp one/estimates.csv two/estimates.csv
}

<<<<<<< HEAD
as_built() {
  # a plain world's mine is its plan, and zero is nothing
  expect 0 simulate mockup --seed 3 -o plain
  expect 0 simulate mockup --seed 3 --as-built bend=0,chains=0 -o zero
  cmp plain/plan.csv plain/mine.csv
  local file
  for file in plan.csv mine.csv log.clf truth.tum config.toml; do cmp plain/$file zero/$file; done
  grep -q '^sigma_m = 0.0*$' plain/config.toml || die 'an exact plan is not stated as such'
  local differs=bend=0.15,reach=8,rough=0.05,missing=0.02,added=0.02,chains=0.05,distortion=0.001
  expect 0 simulate mockup --seed 3 --as-built $differs -o a
  expect 0 simulate mockup --seed 3 --as-built $differs -o b
  for file in plan.csv mine.csv log.clf truth.tum config.toml; do cmp a/$file b/$file; done
  cmp plain/plan.csv a/plan.csv
  [ "$(lines_of a/mine.csv)" -gt 300 ] || die 'the walls are not bent'
  # 0.15, 0.1 / sqrt 2, 0.3 sqrt 0.05
  in_range sigma_m "$(awk '$1 == "sigma_m" { print $3 }' a/config.toml)" 0.178 0.180
  expect 0 localize --map a/mine.csv --log a/log.clf --config a/config.toml -o in_mine
  judged in_mine/estimates.csv a/truth.tum 0.2 1.5
  # a part that the plan lacks
  expect 0 simulate mockup --seed 3 --off-plan 3.5,25,4 -o off
  cmp plain/log.clf off/log.clf
  cmp plain/mine.csv off/mine.csv
  awk -F, 'NR > 1 && ($1 - 3.5) ^ 2 + ($2 - 25) ^ 2 < 15.99 { exit 1 }' off/plan.csv || die 'walls in the circle'
  expect 0 simulate mockup --off-plan -3.5,2,4 -o off
  # what stands and drives about
  local kind
  for kind in against piercing along rows mixed groups; do
    expect 0 simulate mockup --seed 3 --clutter 8 --clutter-kind $kind --speed 1 -o $kind
    ! cmp -s $kind/log.clf plain/log.clf || die "$kind changes nothing"
    cmp plain/mine.csv $kind/mine.csv
  done
  expect 0 simulate mockup --seed 3 --speed 1 -o driven
  expect 0 simulate mockup --seed 3 --speed 1 --machine-ahead 5 -o behind
  ! cmp -s driven/log.clf behind/log.clf || die 'no machine ahead'
  expect 0 simulate panel --seed 3 --scanner sick --speed 4 -o level
  expect 0 simulate panel --seed 3 --scanner sick --speed 4 --ramps 2 -o sloped
  cmp level/truth.tum sloped/truth.tum
  ! cmp -s level/log.clf sloped/log.clf || die 'no ramp'
=======
# a drive at random needs no path, is as long as asked, and stands where it shall
drives() {
  gallery plan.csv
  expect 0 simulate plan.csv --scanner sick --drive 40 --seed 3 -o a
  expect 0 simulate plan.csv --scanner sick --drive 40 --seed 3 -o b
  expect 0 simulate plan.csv --scanner sick --drive 40 --seed 4 -o c
  expect 0 simulate plan.csv --scanner sick --drive 40 --seed 3 --stops 2 --turns 1 -o d
  cmp a/log.clf b/log.clf
  ! cmp -s a/truth.tum c/truth.tum || die 'the seed changes nothing'
  in_range metres "$(awk 'NR > 1 { s += sqrt(($2 - x) ^ 2 + ($3 - y) ^ 2) } { x = $2; y = $3 } END { print s }' a/truth.tum)" 38 40.001
  in_range 'scans more' "$(($(lines_of d/truth.tum) - $(lines_of a/truth.tum)))" 80 150
  expect 0 localize --map a/plan.csv --log a/log.clf --config a/config.toml -o one
  judged one/estimates.csv a/truth.tum 0.05 0.3
  printf '0,0,1,0\n1,0,1,1\n1,1,0,1\n0,1,0,0\n' >narrow.csv
  expect 1 simulate narrow.csv -o e
  says 'narrow.csv'
  absent e
}

# what fails shows in the log, and only there
faults() {
  gallery plan.csv
  expect 0 simulate plan.csv --scanner sick --drive 30 --seed 3 -o right
  expect 0 simulate plan.csv --scanner sick --drive 30 --seed 3 -o wrong \
    --fault dropouts=1,dropout_s=4,freeze_s=20,repeat_after_s=15
  cmp right/truth.tum wrong/truth.tum
  cmp right/config.toml wrong/config.toml
  in_range 'ODOM lines lost' "$(($(grep -c ^ODOM right/log.clf) - $(grep -c ^ODOM wrong/log.clf)))" 190 201
  # a scan's ranges are the fields 10 to 1090
  [ "$(awk '/^ROBOTLASER1/ && $(NF - 2) >= 15 { s = ""; for (i = 10; i < 1091; ++i) s = s " " $i; print s }' \
    wrong/log.clf | sort -u | grep -c '')" -eq 1 ] || die 'a scanner that repeats its scan has several'
  [ "$(awk '/^ODOM/ && $(NF - 2) > 20 { print $2, $3, $4 }' wrong/log.clf | sort -u | grep -c '')" -eq 1 ] ||
    die 'frozen odometry moves'
>>>>>>> drives
}

negative_start() {
  printf -- '-8,-6,8,-6\n8,-6,8,5\n8,5,3,5\n3,5,3,7\n3,7,-8,7\n-8,7,-8,-6\n' >plan.csv
  printf '0 -1 -2 0 0 0 -0.258819045 0.965925826\n1 3 -3.5 0 0 0 0 1\n' >path.tum
  expect 0 simulate plan.csv --path path.tum --scanner sick -o sim
  expect 0 localize --map sim/plan.csv --log sim/log.clf --config sim/config.toml --start -1,-2,-30 -o one
  judged one/estimates.csv sim/truth.tum 0.03 0.2
  expect 0 localize --map sim/plan.csv --log sim/log.clf --config sim/config.toml --start=-1,-2,-30 -o two
  cmp one/estimates.csv two/estimates.csv
  expect 0 plot features --map plan.csv --pose -1,-2,-30 -o features.png
  is_png features.png
}

# gallery FILE: one long room with niches, none like another
gallery() {
  printf '0,0,40,0\n40,0,40,6\n40,6,31,6\n31,6,31,9\n31,9,26,9\n26,9,26,6\n26,6,12,6\n12,6,12,13\n12,13,8,13\n8,13,8,6\n8,6,0,6\n0,6,0,0\n' >"$1"
}
# gallery_drive: a drive through it, in the folder sim
gallery_drive() {
  gallery plan.csv
  printf '0 5 3 0 0 0 0 1\n1 20 2.5 0 0 0 0 1\n2 28 6 0 0 0 0.7071067812 0.7071067812\n' >path.tum
  expect 0 simulate plan.csv --path path.tum --scanner sick --speed 2 --seed 4 -o sim
}
# json_poses FILE KEY: that number of every pose of every line, a line each
json_poses() { grep -o "\"$2\":[-0-9.e+]*" "$1" | cut -d: -f2; }

locate() {
  gallery_drive
  expect 0 locate --map sim/plan.csv --scan sim/log.clf:0 --config sim/config.toml --json
  [ "$(lines_of out)" -eq 1 ] || die 'not one line for one scan'
  prints '^\{"status":"ok","poses":\[\{"x":[-0-9.e]+,"y":[-0-9.e]+,"theta":[-0-9.e]+,"weight":[0-9.e]+,"cov":\[([-0-9.e]+,){5}[-0-9.e]+\]\}.*\],"elapsed_s":[0-9.e-]+\}$'
  says 'index of [0-9]+ places'
  in_range x "$(json_poses out x | head -n 1)" 4.9 5.1
  in_range y "$(json_poses out y | head -n 1)" 2.9 3.1
  in_range heading "$(json_poses out theta | head -n 1)" -0.02 0.02
  in_range 'sum of the weights' "$(json_poses out weight | awk '{ sum += $1 } END { print sum }')" 0.999 1.001
  # the same for people, without a configuration, and with a picture
  local ending
  for ending in png svg pdf; do
    expect 0 locate --map sim/plan.csv --scan sim/log.clf:0 -o poses.$ending
    there poses.$ending
  done
  prints '^scan 0: ok'
  prints '1\.0000 +[45]\.[0-9]+ +[23]\.[0-9]+'
  is_png poses.png
  grep -q '<svg' poses.svg || die 'poses.svg is no SVG'
  # every scan, by any number of threads
  local scans
  scans=$(grep -c ^ROBOTLASER1 sim/log.clf)
  for threads in 1 3; do
    expect 0 locate --map sim/plan.csv --scan sim/log.clf:all --config sim/config.toml --json --threads $threads
    [ "$(lines_of out)" -eq "$scans" ] || die "not one line for each of $scans scans"
    sed 's/"elapsed_s".*//' out >answers$threads
  done
  cmp answers1 answers3
  in_range 'scans that are ok' "$(grep -c '^{"status":"ok"' answers1)" $((scans * 8 / 10)) "$scans"
  # where the vehicle is, not its scanner: the mounting turns and shifts the laser's pose
  awk '/^ROBOTLASER1/ { n = $9; o = 9 + n + 1; k = $o; o += k + 1
         x = $o; y = $(o + 1); t = $(o + 2)
         $(o + 3) = x - 0.4 * cos(t); $(o + 4) = y - 0.4 * sin(t) }
       { print }' sim/log.clf >mounted.clf
  expect 0 locate --map sim/plan.csv --scan mounted.clf:0 --json
  in_range 'x of the vehicle' "$(json_poses out x | head -n 1)" 4.5 4.7
  # what it cannot be
  expect 1 locate --map sim/plan.csv --scan sim/log.clf:"$scans" --json
  says "sim/log.clf: has $scans scans"
  [ ! -s out ] || die 'an answer to a scan that is not there'
  local scan
  for scan in sim/log.clf sim/log.clf: sim/log.clf:x sim/log.clf:-1 :all all; do
    expect 2 locate --map sim/plan.csv --scan "$scan"
  done
  expect 2 locate --map sim/plan.csv --scan sim/log.clf:all -o all.png
  expect 2 locate --map sim/plan.csv --scan sim/log.clf:0 -o poses.jpeg
  expect 2 locate --map sim/plan.csv --scan sim/log.clf:0 --threads 0
  expect 2 locate --map sim/plan.csv
  absent all.png poses.jpeg
  expect 1 locate --map none.csv --scan sim/log.clf:0
  says none.csv
}

# Two places that look the same: both are told.
locate_twins() {
  printf '0,0,9,0\n9,0,9,4\n9,4,6,4\n6,4,6,7\n6,7,0,7\n0,7,0,0\n' >one.csv
  { cat one.csv && awk -F, '{ print $1 + 100 "," $2 "," $3 + 100 "," $4 }' one.csv; } >plan.csv
  printf '0 3 3 0 0 0 0 1\n' >path.tum
  expect 0 simulate plan.csv --path path.tum --speed 0 --scanner cyclone -o sim
  expect 0 locate --map plan.csv --scan sim/log.clf:0 --config sim/config.toml --json -o twins.png
  prints '^\{"status":"ambiguous"'
  json_poses out x | awk '$1 > 2.5 && $1 < 3.5 { a = 1 } $1 > 102.5 && $1 < 103.5 { b = 1 } END { exit !(a && b) }' ||
    die 'not both places'
  is_png twins.png
  # where that is so, for all places of the plan
  expect 0 map aliases plan.csv --pitch 2 -o aliases.png
  prints '0\.0 %  one answer'
  prints '[1-9][0-9]* +100\.0 %  ambiguous'
  prints 'the worst pairs'
  is_png aliases.png
  cp out first
  expect 0 map aliases plan.csv --pitch 2 --threads 1 -o aliases.png
  cmp first out
  gallery gallery.csv
  expect 0 map aliases gallery.csv --scanner sick --pitch 4
  in_range 'places with one answer (%)' "$(awk '/one answer/ { print $2 }' out)" 60 100
  expect 2 map aliases plan.csv --scanner nonsense
  expect 2 map aliases plan.csv --pitch 0
  expect 2 map aliases plan.csv -o aliases.jpeg
  expect 1 map aliases none.csv
  says none.csv
}

# A plan of two levels: a folder with a file each.
levels() {
  gallery_drive
  mkdir mine
  cp sim/plan.csv mine/upper.csv
  awk -F, '/^[-0-9]/ { print 1.5 * $1 "," 0.8 * $2 "," 1.5 * $3 "," 0.8 * $4 }' sim/plan.csv >mine/deep.csv
  expect 0 locate --map mine --scan sim/log.clf:0 --config sim/config.toml --json
  prints '^\{"status":"ok","poses":\[\{[^{]*\],"level":"upper"\}'
  says 'level deep: index'
  expect 0 locate --map mine --scan sim/log.clf:0 --config sim/config.toml -o level.png
  prints 'upper$'
  local common="localize --map mine --log sim/log.clf --config sim/config.toml"
  # shellcheck disable=SC2086
  {
    expect 0 $common --level upper --start 5,3,0 -o named
    expect 0 localize --map sim/plan.csv --log sim/log.clf --config sim/config.toml --start 5,3,0 -o plain
    expect 0 $common --start anywhere -o found
    expect 0 $common --level upper --start anywhere -o both
    expect 2 $common --start 5,3,0 -o e
    says 'deep, upper'
    expect 2 $common --level lower --start 5,3,0 -o e
    says 'deep, upper'
    expect 2 localize --map sim/plan.csv --log sim/log.clf --level upper -o e
  }
  absent e
  cmp named/estimates.csv plain/estimates.csv
  cmp found/estimates.csv both/estimates.csv
  grep -q '"level": "upper"' found/report.json || die 'the report does not say which level'
  # the level of a saved pose
  # shellcheck disable=SC2086
  {
    expect 0 $common --resume found/last_pose.json -o again
    grep -q '"level": "upper"' again/last_pose.json || die 'the level is not kept'
    expect 1 $common --resume found/last_pose.json --level deep -o e
  }
  says 'last_pose.json.*upper'
  mkdir empty
  expect 1 locate --map empty --scan sim/log.clf:0
  says 'empty: .*no plan'
}

# Without any first pose: lost at first, with variances that say so, and right before long.
anywhere() {
  gallery_drive
  local common="localize --map sim/plan.csv --log sim/log.clf --config sim/config.toml"
  # shellcheck disable=SC2086
  expect 0 $common --start anywhere -o one
  has_form one sim/log.clf
  grep -q '"start": "anywhere"' one/report.json || die 'the report does not say how it began'
  awk -F, 'NR == 2 { exit !($11 == "lost" && $5 == "inf" && $8 == "inf" && $10 == "inf") }' one/estimates.csv ||
    die 'the first row is not one of a pose that is not known'
  awk -F, 'NR > 1 && $11 == "ok" { n++ } NR > 1 && $11 == "ok" && $5 == "inf" { bad = 1 } END { exit bad || n < 5 }' \
    one/estimates.csv || die 'never found'
  awk -F, 'NR == 1 || $11 == "ok"' one/estimates.csv >ok.csv
  expect 0 evaluate --estimate ok.csv --truth sim/truth.tum --json
  in_range 'largest error of an ok pose' "$(json_number out position max)" 0 0.2
  # shellcheck disable=SC2086
  expect 0 $common --start anywhere --threads 1 -o two
  local file
  for file in estimates.csv report.json trajectory.tum last_pose.json; do cmp one/$file two/$file; done
  # shellcheck disable=SC2086
  expect 2 $common --start anywhere --estimator features -o e
  says anywhere
  { cat sim/config.toml; printf '[recovery]\nsearches = false\n'; } >no_search.toml
  # shellcheck disable=SC2086
  expect 2 ${common/sim\/config/no_search} --start anywhere -o e
  says searches
  # shellcheck disable=SC2086
  expect 2 $common --start nowhere -o e
  says anywhere
  absent e
}

# The last pose of a run begins the next.
resume() {
  gallery_drive
  local common="localize --map sim/plan.csv --config sim/config.toml"
  # the first half of the drive, and the rest
  awk '/^ROBOTLASER1/ { n++ } n <= 12 { print > "first.clf"; next } { print > "rest.clf" }' sim/log.clf
  # shellcheck disable=SC2086
  {
    expect 0 $common --log first.clf --start 5,3,0 -o one
    expect 0 $common --log rest.clf --resume one/last_pose.json -o two
  }
  there one/last_pose.json
  has_form two rest.clf
  grep '^[^#]' sim/truth.tum | tail -n +13 >rest.tum
  judged two/estimates.csv rest.tum 0.05 0.2
  grep -q '"start": "resumed"' two/report.json || die 'the report does not say how it began'
  awk -F, 'NR > 1 && $11 != "ok" { exit 1 }' two/estimates.csv || die 'a right pose is not taken up'
  # the last row of the estimates is what was saved
  local row
  row=$(tail -n 1 one/estimates.csv)
  grep -q "\"x\": $(cut -d, -f2 <<<"$row")" one/last_pose.json || die 'another pose was saved'
  # a wrong one is not trusted: elsewhere in the mine, and surely so
  sed 's/"x": .*/"x": 33.0,/; s/"y": .*/"y": 2.0,/' one/last_pose.json >wrong.json
  # shellcheck disable=SC2086
  expect 0 $common --log rest.clf --resume wrong.json -o three
  awk -F, 'NR == 1 || $11 == "ok"' three/estimates.csv >ok.csv
  [ "$(lines_of ok.csv)" -gt 5 ] || die 'a wrong pose is never mended'
  expect 0 evaluate --estimate ok.csv --truth sim/truth.tum --json
  in_range 'largest error of an ok pose' "$(json_number out position max)" 0 0.3
  # one that was lost begins anywhere
  sed 's/"status": .*/"status": "lost"/' one/last_pose.json >lost.json
  # shellcheck disable=SC2086
  {
    expect 0 $common --log rest.clf --resume lost.json -o four
    expect 0 $common --log rest.clf --start anywhere -o five
    cmp four/estimates.csv five/estimates.csv
    # what is no saved pose
    printf '{"x": 1}' >short.json
    printf 'x: 1\n' >text.json
    sed 's/"status": .*/"status": "fine"/' one/last_pose.json >word.json
    local file
    for file in short.json text.json word.json absent.json one; do
      expect 1 $common --log rest.clf --resume $file -o e
      says "$file"
      [ "$(lines_of err)" -eq 1 ] || die 'more than one line of complaint'
    done
    expect 2 $common --log rest.clf --resume one/last_pose.json --start 5,3,0 -o e
    expect 2 $common --log rest.clf --resume one/last_pose.json --moved 1 -o e
    expect 0 $common --log rest.clf --resume one/last_pose.json --moved 0,0 -o six
  }
  absent e
}

# sorted PLAN: its walls, whatever their order and direction
sorted() {
  awk -F, '/^[-0-9]/ { a = $1 "," $2; b = $3 "," $4; print (a < b ? a " " b : b " " a) }' "$1" | LC_ALL=C sort
}
maps() {
  room_plan plan.csv
  expect 0 map info plan.csv
  prints '6 segments, 6 walls'
  prints '8\.0 x 7\.0 m'
  expect 0 map check plan.csv
  prints '^clean'
  # a crossing, a T-junction, a duplicate
  { cat plan.csv && printf -- '-1,3,2,3\n0,0,8,0\n'; } >dirty.csv
  expect 1 map check dirty.csv
  prints '1 duplicates'
  prints '1 crossings'
  prints 'needs cleaning'
  expect 0 map convert dirty.csv -o clean.csv
  expect 0 map check clean.csv
  expect 0 map convert clean.csv -o again.csv
  cmp <(sorted clean.csv) <(sorted again.csv) || die 'cleaning a clean plan changes it'
  expect 2 map convert dirty.csv
}

plots() {
  expect 0 simulate mockup --clutter 8 --seed 3 -o d
  cd d
  local start
  start=$(first_pose truth.tum)
  expect 0 localize --map plan.csv --log log.clf --config config.toml -o run
  expect 0 plot map --map plan.csv -o map.png
  expect 0 plot scan --scan log.clf:4 --config config.toml -o scan.png
  expect 0 plot features --map plan.csv --pose "$start" -o features.png
  expect 0 plot match --map plan.csv --scan log.clf:0 --pose "$start" --config config.toml -o match.png
  prints '^ok'
  expect 0 plot trajectory --map plan.csv --trajectory run/trajectory.tum -o tum.png
  expect 0 plot trajectory --map plan.csv --estimate run/estimates.csv --truth truth.tum -o csv.png
  local kind
  for kind in map scan features match tum csv; do is_png $kind.png; done
  expect 0 plot map --map plan.csv -o map.svg
  grep -q '<svg' map.svg || die 'map.svg is no SVG'
  expect 0 plot map --map plan.csv -o map.pdf
  [ "$(head -c 5 map.pdf)" = %PDF- ] || die 'map.pdf is no PDF'
  # a wrong call is one before any file is read
  expect 2 plot match --map plan.csv --scan log.clf:0 --pose 1,2 -o bad.png
  local scan
  for scan in log.clf log.clf: log.clf:x log.clf:-1 log.clf:1x :1 log.clf:99999999999999999999; do
    expect 2 plot scan --scan "$scan" -o bad.png
    expect 2 plot match --map none.csv --scan "$scan" --pose "$start" -o bad.png
  done
  expect 2 plot features --map none.csv --pose 1,2,x -o bad.png
  for kind in map 'features --pose 1,1,0' 'match --scan log.clf:0 --pose 1,1,0' \
    'trajectory --trajectory truth.tum'; do
    # shellcheck disable=SC2086
    expect 2 plot $kind --map none.csv -o picture.jpeg
    says 'picture.jpeg'
  done
  absent bad.png picture.jpeg
  # under the configuration, as localize
  printf '[map]\nsnap_m = 0.01\n[scanner]\nmax_range_m = 6\n' >near.toml
  expect 0 plot scan --scan log.clf:4 --config near.toml -o near.png
  ! cmp -s scan.png near.png || die 'plot scan does not heed the maximum range'
}

demo() {
  expect 0 demo -o d
  prints 'Table I:'
  prints 'Table II:'
  prints 'position, adit'
  there d/{plan.csv,log.clf,truth.tum,config.toml,trajectory.tum,estimates.csv}
  local figure
  for figure in 04 05 09 10 11 12 13; do
    there d/fig$figure-*.png
    is_png d/fig$figure-*.png
  done
  judged d/estimates.csv d/truth.tum 0.04 0.25
  # the same experiment from its files
  expect 0 localize --map d/plan.csv --log d/log.clf --config d/config.toml -o e
  judged e/estimates.csv d/truth.tum 0.04 0.25
  expect 1 demo -o d/plan.csv
  says plan.csv
}

# ring_drive FOLDER: once round a gallery with niches and on, with bad dead reckoning
ring_drive() {
  printf '%s\n' 0,0,20,0 20,0,20,14 20,14,0,14 0,14,0,0 3,3,3,11 3,11,17,11 17,11,17,3 17,3,12,3 12,3,12,4 \
    12,4,9,4 9,4,9,3 9,3,3,3 7,14,7,13 7,13,8,13 8,13,8,14 >ring.csv
  local quarter='0.7071067812 0.7071067812'
  printf '%s\n' '0 1.5 1.5 0 0 0 0 1' '1 18.5 1.5 0 0 0 0 1' "2 18.5 1.5 0 0 0 $quarter" "3 18.5 12.5 0 0 0 $quarter" \
    '4 18.5 12.5 0 0 0 1 0' '5 1.5 12.5 0 0 0 1 0' "6 1.5 12.5 0 0 0 -$quarter" "7 1.5 1.5 0 0 0 -$quarter" \
    '8 1.5 1.5 0 0 0 0 1' '9 10 1.5 0 0 0 0 1' >path.tum
  expect 0 simulate ring.csv --path path.tum --scanner sick --speed 3 --odometry 0.04,2,0.04 --seed 3 -o "$1"
}

# A drive from dead reckoning and scans alone: its poses, its walls, and the same from run to run.
survey() {
  ring_drive sim
  local call='survey --log sim/log.clf --config sim/config.toml'
  # shellcheck disable=SC2086
  expect 0 $call --threads 1 --trajectory one.tum --walls one_walls.csv --report one.json --picture one.png -o one.csv
  prints ' loop closures'
  [ "$(grep -c '^[^#]' one.tum)" -eq "$(grep -c ^ROBOTLASER1 sim/log.clf)" ] || die 'not one pose for each scan'
  is_png one.png
  in_range closures "$(grep -c earlier_s one.json)" 3 1000
  in_range 'length of wall' "$(json_number one.json walls length_m)" 112 120
  in_range segments "$(json_number one.json walls segments)" 14 24
  [ "$(lines_of one_walls.csv)" -eq $(($(lines_of one.csv) + 1)) ] || die 'not one row of the table for each wall'
  # the first pose is the odometry's, whose heading is off by what the drive does not tell: two relations
  local stamps
  stamps=$(awk '{ t[NR] = $1; p[NR] = $2 " " $3 } END { print t[1], t[NR] }' sim/truth.tum)
  awk -v stamps="$stamps" 'BEGIN { split(stamps, s, " ") }
    $1 == s[1] { x = $2; y = $3; h = 2 * atan2($7, $8) }
    $1 == s[2] { c = cos(h); n = sin(h); dx = $2 - x; dy = $3 - y
      print s[1], s[2], c * dx + n * dy, c * dy - n * dx, 0, 0, 0, 2 * atan2($7, $8) - h }' sim/truth.tum >ends.relations
  expect 0 evaluate --estimate one.tum --relations ends.relations --json
  in_range 'error from end to end' "$(json_number out relations translation_mean)" 0 0.08
  # shellcheck disable=SC2086
  expect 0 $call --threads 2 --trajectory two.tum --walls two_walls.csv --report two.json --picture two.png -o two.csv
  local ending
  for ending in .csv .tum _walls.csv .json .png; do cmp one$ending two$ending; done
}

# A plan is compared with what is there, and changes only where that is asked for.
survey_update() {
  ring_drive sim
  # a wall that is new, and one that is gone
  { grep -v '^17,11,17,3$' ring.csv && echo 5,0,5,1.4; } >old.csv
  cp old.csv kept.csv
  local call='survey --log sim/log.clf --config sim/config.toml --update old.csv --start 1.5,1.5,0'
  # shellcheck disable=SC2086
  expect 0 $call --trajectory poses.tum --picture changes.png -o changes.json
  prints 'wall gone .* at 5.0'
  prints 'new obstacle .* at 17.0'
  is_png changes.png
  judged poses.tum sim/truth.tum 0.03 0.1
  cmp old.csv kept.csv
  in_range changes "$(grep -c '"number"' changes.json)" 2 2
  # shellcheck disable=SC2086
  expect 0 $call -o changes.csv
  [ "$(grep -c ',removed,\|,added,' changes.csv)" -ge 2 ] || die 'the table lacks a change'
  local number
  number=$(awk -F, '$2 == "new obstacle" { print $1; exit }' changes.csv)
  # shellcheck disable=SC2086
  expect 0 $call --apply "$number" -o new.csv
  grep -q '^5,0,5,1' new.csv || die 'a change was made that nobody asked for'
  in_range 'walls added' $(($(lines_of new.csv) - $(lines_of old.csv))) 1 3
  # shellcheck disable=SC2086
  expect 0 $call --apply all -o old.csv
  ! grep -q '^5,0,5,1' old.csv || die 'the wall that is gone is still there'
  cp kept.csv old.csv
  # shellcheck disable=SC2086
  expect 1 $call --apply 7 -o new7.csv
  says 'no change 7'
  absent new7.csv
  # of another mine no scan is
  printf '0,0,1,0\n' >other.csv
  expect 1 survey --log sim/log.clf --config sim/config.toml --update other.csv --start 900,900,0 -o e.json
  says 'other.csv: no scan'
  absent e.json
}

# Positions that are known, headings that are not.
survey_positions() {
  ring_drive sim
  awk 'NR % 12 == 1 { print $1, $2, $3, 0, 0, 0, 0, 1 }' sim/truth.tum >positions.tum
  awk 'FILENAME == "positions.tum" { t[$1 + 0] = 1; next }
    /^ROBOTLASER1/ { if (($(NF - 2) + 0) in t) print; next } { print }' positions.tum sim/log.clf >stations.clf
  expect 0 survey --log stations.clf --config sim/config.toml --poses positions.tum --trajectory poses.tum -o plan.csv
  prints 'stations'
  awk 'FILENAME == "positions.tum" { t[$1 + 0] = 1; next } ($1 + 0) in t' positions.tum sim/truth.tum >truth.tum
  judged poses.tum truth.tum 0.01 0.01
  in_range 'heading error' "$(json_number out heading_deg median)" 0 0.5
  expect 0 map info plan.csv
  expect 1 survey --log stations.clf --poses absent.tum -o e
  says absent.tum
  absent e
}

survey_bad_input() {
  ring_drive sim
  local call='survey --log sim/log.clf'
  # shellcheck disable=SC2086
  {
    expect 2 survey -o e
    says '--log'
    expect 2 $call
    expect 2 $call --apply all -o e
    says '--update'
    expect 2 $call --start 0,0,0 -o e
    expect 2 $call --update ring.csv --apply 3-1 -o e
    expect 2 $call --update ring.csv --apply 0 -o e
    expect 2 $call --update ring.csv --start 0,0 -o e.json
    expect 2 $call --update ring.csv -o e.txt
    expect 2 $call --picture e.gif -o e
    expect 2 $call --walls e.txt -o e
    expect 2 $call -o e.dxf
    expect 2 $call --trajectory e -o ./e
    says 'two outputs'
    expect 1 $call -o none/e.csv
    says 'no such folder'
    cp ring.csv plan.csv
    expect 2 $call --update plan.csv -o plan.csv
    says 'what is read'
    expect 2 $call --update plan.csv --apply all --walls plan.csv -o e
    expect 2 $call --trajectory sim/../sim/log.clf -o e
    says 'what is read'
    cmp ring.csv plan.csv
  }
  : >empty.clf
  printf 'ODOM 0 0 0 0 0 0 1 h 1\nODOM 1 0 0 0 0 0 2 h 2\n' >scanless.clf
  head -c 3000 /dev/urandom >binary.clf
  awk '/^ROBOTLASER1/ { n = 9 + $9 + 1; n += $n; for (i = 1; i <= 6; i++) $(n + i) = 0 } { print }' sim/log.clf >still.clf
  local log
  for log in empty.clf scanless.clf binary.clf absent.clf still.clf; do bad "$log" survey --log $log -o e; done
  says 'odometry reports no move'
  printf '0,0,1,0\nx,0,1,1\n' >letters.csv
  bad letters.csv:2 survey --log sim/log.clf --update letters.csv -o e.json
  mkdir levels
  cp ring.csv levels/upper.csv
  cp ring.csv levels/lower.csv
  bad levels survey --log sim/log.clf --update levels -o e.json
  printf '1 2 3\n' >short.tum
  bad short.tum:1 survey --log sim/log.clf --poses short.tum -o e
  printf '[survey_loops]\nleast_scor = 1\n' >key.toml
  bad key.toml:2 survey --log sim/log.clf --config key.toml -o e
  # what cannot be written takes the rest with it
  : >file
  bad . survey --log sim/log.clf --trajectory e.tum -o /dev/null/e
  mkdir folder.json
  bad folder.json survey --log sim/log.clf --trajectory e.tum --report folder.json -o e
  absent e.tum e.json
  # but not what was there before
  echo kept >e.tum
  bad folder.json survey --log sim/log.clf --trajectory e.tum --report folder.json -o e
  [ -f e.tum ] || die 'a file that was there before is gone'
}

"$3"
cd "$scratch/.."
rm -rf "$scratch"
