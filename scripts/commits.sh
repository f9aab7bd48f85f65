#!/usr/bin/env bash
# Holds to the rule of scripts/commit-subjects.sh every commit that descends from the one which introduced
# the hook. Merges are let through. Without git's history there is nothing to check.
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
top=$(git rev-parse --show-toplevel 2>/dev/null) || exit 0
[[ $top -ef . ]] || exit 0

# Of a shallow clone the oldest commit counts as the one that introduced it.
first=$(git log --diff-filter=A --format=%H -- scripts/commit-msg 2>/dev/null | tail -n 1)
[[ -n $first ]] || exit 0
git log --no-merges --ancestry-path --format=%s "$first..HEAD" | bash scripts/commit-subjects.sh
