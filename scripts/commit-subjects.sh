#!/usr/bin/env bash
# Reads the subjects of commits, one in each line, and fails if one breaks the rule: a subject is an
# order of at most 72 characters that begins with a verb of scripts/commit-verbs.txt. It has no semicolon.
set -euo pipefail

verbs=$(dirname "${BASH_SOURCE[0]}")/commit-verbs.txt
export LC_ALL=C.UTF-8
status=0

refuse() {
  printf 'commit subject: %s\n  %s\n' "$2" "$1" >&2
  status=1
}

while IFS= read -r subject || [[ -n $subject ]]; do
  verb=${subject%% *}
  if ((${#subject} > 72)); then refuse "$subject" "${#subject} characters; at most 72 are allowed"; fi
  if [[ $subject == *';'* ]]; then refuse "$subject" "it has a semicolon; one commit does one thing"; fi
  if [[ -z $verb ]]; then
    refuse "$subject" "it is empty"
  elif ! grep -qxF -- "$verb" "$verbs"; then
    refuse "$subject" "\"$verb\" is not a verb in scripts/commit-verbs.txt; begin with an order, such as Add, Compute, Mend"
  fi
done
exit "$status"
