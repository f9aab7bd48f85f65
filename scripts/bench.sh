#!/usr/bin/env bash
# Fetches and builds the available peers of the benchmark, and runs it. The argument is the folder in
# which stack has built the benchmark. The tables are written into docs/performance.md, all other files
# below build/bench.
#
# A second argument is the folder in which an earlier state was built. Then the kernels and the stages
# of both states take turns, there are no other peers, and the tables go to build/bench/before.md.
#
# PARTC_BENCH_MOST=10000 leaves out larger inputs. PARTC_BENCH_PARTS='kernel stages mills controllers whole' chooses
# the parts. PARTC_BENCH_SECONDS is the largest expected time, in seconds, of a run of the stages.
set -euo pipefail

dist=$1
before=${2:-}
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
work=$root/build/bench
page=$root/docs/performance.md
mkdir -p "$work"

source "$root/scripts/bench-peers.sh"

about() {
  sed -n 's/^model name[^:]*: */processor: /p' /proc/cpuinfo | head -n 1
  printf 'processors: %s, memory: %s GB\n' "$(nproc)" "$(awk '/^MemTotal/ { print int($2 / 1048576 + 0.5) }' /proc/meminfo)"
  printf 'system: %s, Linux %s\n' "$(. /etc/os-release && echo "$PRETTY_NAME")" "$(uname -r)"
  printf 'compiler: GHC %s\n' "$(ghc --numeric-version)"
  if [[ -n $cavalier ]]; then
    printf 'cavalier_contours %s, rustc %s\n' "$(grep -A 1 'name = "cavalier_contours"' "$root/bench/peers/cavalier/Cargo.lock" | sed -n 's/version = "\(.*\)"/\1/p')" "$(rustc --version | cut -d ' ' -f 2)"
  fi
  if [[ -n $chords ]]; then "$venv/bin/python" "$root/bench/peers/chords.py" versions; fi
  if [[ -n $rs274 ]]; then printf 'LinuxCNC %s\n' "$(dpkg-query -W -f '${Version}' linuxcnc-uspace 2>/dev/null || echo 'of unknown version')"; fi
}

cavalier= chords= rs274=
if [[ -n $before ]]; then
  page=$work/before.md
  for table in machine times memory agreement chords differences before; do
    printf '<!-- %s -->\n<!-- end of %s -->\n' "$table" "$table"
  done >"$page"
  PARTC_BENCH_PARTS=${PARTC_BENCH_PARTS:-kernel}
else
  fetch_cavalier
  fetch_chords
  rs274=$(command -v rs274 || true)
  [[ -n $rs274 ]] || printf 'bench: rs274 is not installed; the whole compile is not compared with an interpreter\n'
fi

options=(
  "about=$(about)"
  "kernel=$dist/build/kernel/kernel"
  "stages=$dist/build/stages/stages"
  "pulses=$dist/build/pulses/pulses"
  "partc=$dist/build/partc/partc"
  "cost=python3 $root/bench/peers/cost.py"
  "parts=${PARTC_BENCH_PARTS:-kernel stages mills stock letters controllers whole}"
  "most=${PARTC_BENCH_MOST:-1000000}"
  "seconds=${PARTC_BENCH_SECONDS:-20}"
)
[[ -z $before ]] || options+=("before=$before")
[[ -z $cavalier ]] || options+=("cavalier=$cavalier/offset")
[[ -z $chords ]] || options+=("chords=$chords")
[[ -z $rs274 ]] || options+=("rs274=$rs274")

"$dist/build/bench/bench" "$page" "$work" "${options[@]}"
