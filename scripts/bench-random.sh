#!/usr/bin/env bash
# bench-random.sh COUNT SEED [LIMIT]: offsets random contours with the kernel and with cavalier_contours and lists at most LIMIT
# that differ. After `make bench`, or after stack has built the benchmark as make bench does.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
work=$root/build/bench
mkdir -p "$work"
cd "$root"

source scripts/bench-peers.sh
fetch_cavalier
if [[ -z $cavalier ]]; then exit 1; fi

dist=$(stack --work-dir .stack-work-bench path --dist-dir)
"$dist/build/random/random" "${1:-100000}" "${2:-1}" "$work/random.bin" "$cavalier/areas" "${3:-20}"
