#!/usr/bin/env bash
# Runs a command and keeps its output to itself. When the command fails, shows
# all of it; when it succeeds, only the compiler's warnings.
set -uo pipefail

log=$(mktemp)
trap 'rm -f "$log"' EXIT

"$@" </dev/null >"$log" 2>&1
status=$?

if ((status != 0)); then
  cat "$log"
else
  # A warning is a line that says so and the indented lines after it.
  awk '/: warning:/ { shown = 1; print; next }
       shown && /^[[:space:]]/ { print; next }
       shown && /^[[:digit:]]* *\|/ { print; next }
       { shown = 0 }' "$log"
fi
exit "$status"
