#!/usr/bin/env bash
# bench-random.sh COUNT SEED [LIMIT]: offsets random contours with the kernel and with cavalier_contours,
# and counts the differences of each class. Two judges decide which answer is right: cavalier_contours
# with slightly larger and smaller offsets, and GEOS if it can be fetched. The script lists at most
# LIMIT contours for which they do not find the kernel right. Run `make bench` before: it builds the
# programs of the benchmark.
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
