#!/usr/bin/env bash
# Checks the subjects of all commits after the one that introduced the hook, by the rule of
# scripts/commit-subjects.sh. Merges are not checked. Without a git history the script succeeds.
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
top=$(git rev-parse --show-toplevel 2>/dev/null) || exit 0
[[ $top -ef . ]] || exit 0

# In a shallow clone the oldest commit is taken for the one that introduced the hook.
first=$(git log --diff-filter=A --format=%H -- scripts/commit-msg 2>/dev/null | tail -n 1)
[[ -n $first ]] || exit 0
git log --no-merges --ancestry-path --format=%s "$first..HEAD" | bash scripts/commit-subjects.sh
