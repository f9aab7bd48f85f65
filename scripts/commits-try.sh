#!/usr/bin/env bash
# Tests the commit hook in a temporary repository: it accepts subjects that keep the rule, and refuses others.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
export GIT_CONFIG_GLOBAL=/dev/null GIT_CONFIG_SYSTEM=/dev/null
export GIT_AUTHOR_NAME=t GIT_AUTHOR_EMAIL=t@localhost GIT_COMMITTER_NAME=t GIT_COMMITTER_EMAIL=t@localhost
# If a hook or a rebase runs this script, git has set these variables to another repository.
unset GIT_DIR GIT_WORK_TREE GIT_INDEX_FILE

wrong() {
  printf 'commits-try: %s\n' "$1" >&2
  exit 1
}

cd "$place"
git init -q -b main .
mkdir scripts
git commit -q --allow-empty -m 'What was before; of any length, as no rule applied to it at that time of the project'
cp "$here"/commit* scripts/
git add scripts
git commit -q -m 'Add the commit hook'
bash scripts/commit-hook.sh

accepts() { git commit -q --allow-empty -m "$1" 2>/dev/null || wrong "refuses: $1"; }
refuses() { if git commit -q --allow-empty -m "$1" 2>/dev/null; then wrong "accepts: $1"; fi; }

accepts 'Compute exact curve intersections'
accepts "Report a cutter that is too large

A body may say more; and at any length that its lines need, which is no concern of the rule at all."
# 72 letters, not bytes
accepts 'Read ЛКП-01Ф tapes with the parity of rows, eight tracks and no leaders.'
accepts 'fixup! Compute exact curve intersections'
git reset -q --hard HEAD~
refuses 'Read ЛКП-01Ф tapes with the parity of rows, eight tracks and no leaders..'
refuses 'Compute intersections; report them'
refuses 'Intersections of curves are exact'
refuses 'Computes exact intersections'
refuses 'add a machine'
refuses 'Compute exact intersections
of all curves and lines, which without an empty line is still the subject'
refuses 'Merge what belongs together; also more'

# The subject that git writes for a merge is accepted.
git checkout -q -b 'a-branch-with-a-name-so-long-that-the-subject-of-its-merge-exceeds-seventy-two' HEAD~
accepts 'Add a branch'
git checkout -q main
git merge -q --no-ff --no-edit '-' 2>/dev/null || wrong 'refuses a merge by git'
bash scripts/commits.sh || wrong 'refuses commits that keep to the rule'

# commits.sh finds a commit that was made without the hook.
git commit -q --no-verify --allow-empty -m 'Subjects without a verb'
if bash scripts/commits.sh 2>/dev/null; then wrong 'overlooks a commit'; fi

# A shallow clone and sources without history do not fail.
git clone -q --depth 1 "file://$place" shallow
bash shallow/scripts/commits.sh || wrong 'fails in a shallow clone'
git reset -q --hard HEAD~
git clone -q --depth 2 "file://$place" deeper
bash deeper/scripts/commits.sh || wrong 'fails in a shallow clone of two commits'
rm -rf deeper/.git .git
bash deeper/scripts/commits.sh || wrong 'fails without git'
bash deeper/scripts/commit-hook.sh || wrong 'fails to install without git'
