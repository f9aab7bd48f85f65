#!/usr/bin/env bash
# Runs a build and shows its progress: the modules that GHC compiles, as "[57 of 241] Geometry.Offset".
# On a terminal each of these lines overwrites the one before. Elsewhere every 20th and the last are
# printed. All other output is hidden. If the command fails, all of its output is shown; if it succeeds,
# only the compiler's warnings.
set -uo pipefail

log=$(mktemp)
trap 'rm -f "$log"' EXIT

if [[ -t 1 ]]; then terminal=1; else terminal=0; fi

# Debian's mawk reads a pipe in large portions; with -W interactive it reads line by line.
# Other versions of awk warn of this option, so only mawk gets it.
awk=(awk)
if awk -W version 2>&1 </dev/null | grep -q '^mawk'; then awk=(awk -W interactive); fi

"$@" </dev/null 2>&1 | tee "$log" | "${awk[@]}" -v terminal="$terminal" '
  match($0, /\[ *[0-9]+ of [0-9]+\] Compiling /) {
    count = substr($0, RSTART, RLENGTH - 11)
    rest = substr($0, RSTART + RLENGTH)
    sub(/ .*/, "", rest)
    gsub(/\[ +/, "[", count)
    split(substr(count, 2), number, " ")
    line = count " " rest
    if (terminal) {
      printf "\r\033[K%s", line
      shown = 1
    } else if (number[1] % 20 == 0 || number[1] == number[3] + 0) {
      print line
    }
    fflush()
  }
  END { if (shown) printf "\r\033[K" }'
status=${PIPESTATUS[0]}

if ((status != 0)); then
  cat "$log"
else
  # A warning is a line with "warning:" and the indented lines after it.
  awk '/: warning:/ { shown = 1; print; next }
       shown && /^[[:space:]]/ { print; next }
       shown && /^[[:digit:]]* *\|/ { print; next }
       { shown = 0 }' "$log"
fi
exit "$status"
