#!/usr/bin/env bash
# bench-random.sh COUNT SEED [LIMIT]: offsets random contours with the kernel and with cavalier_contours, counts how many differ in
# which way, and lists at most LIMIT on which the judges do not find the kernel right: cavalier_contours beside the offset, and
# GEOS if it can be fetched. After `make bench`, or after stack has built the benchmark as make bench does.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
work=$root/build/bench
mkdir -p "$work"
cd "$root"

source scripts/bench-peers.sh
fetch_cavalier
if [[ -z $cavalier ]]; then exit 1; fi
fetch_chords
judge=()
if [[ -n $chords ]]; then judge=("$venv/bin/python" "$root/bench/peers/judge.py"); fi

dist=$(stack --work-dir .stack-work-bench path --dist-dir)
"$dist/build/random/random" "${1:-100000}" "${2:-1}" "$work/random.bin" "$cavalier/areas" "${3:-20}" ${judge[@]+"${judge[@]}"}
