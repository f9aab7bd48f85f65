#!/usr/bin/env bash
# Puts the bug of every test/mutants/*.mutant into a copy of the sources, one at a time, and runs the law
# that has to notice it. Fails at once if a mutant does not apply to the sources. Fails at the end if a
# law has not noticed its bug. Arguments are names of mutants; with arguments only these are tried.
set -u
top=$(cd "$(dirname "$0")/.." && pwd)
copy=$top/build/mutants
stack() { command stack --work-dir .stack-work "$@"; }
mutants() { python3 "$top/scripts/mutants.py" "$@"; }

mutants check "$@" || { echo "these mutants do not apply to the sources as they are"; exit 1; }

mkdir -p "$copy"
# Only files with other contents are copied: a copy has a new time, and would be compiled again.
(cd "$top" && git ls-files --cached --others --exclude-standard | while IFS= read -r f; do
  [ ! -f "$f" ] || cmp -s "$f" "$copy/$f" || cp --parents "$f" "$copy"
done)
cd "$copy" || exit 1
# Files that the sources no longer have are removed from the copy.
find app bench src test machines explain -type f | while IFS= read -r f; do [ -f "$top/$f" ] || rm -f "$f"; done

chosen=("$@")
if [ $# -eq 0 ]; then for f in "$top"/test/mutants/*.mutant; do chosen+=("$(basename "$f" .mutant)"); done; fi

survivors=0
for name in "${chosen[@]}"; do
  law=$(mutants law "$name")
  file=$(mutants file "$name")
  cp "$top/$file" "$file.sound"
  mutants apply "$name" "$copy"
  if ! stack build --fast --test --no-run-tests >build.log 2>&1; then
    echo "$name: does not build"; tail -n 20 build.log; survivors=$((survivors + 1))
  elif out=$(timeout 300 stack --verbosity error test --fast --test-arguments "--match '$law'" 2>&1); then
    echo "$name: SURVIVED ($law)"; printf '%s\n' "$out" | tail -n 5; survivors=$((survivors + 1))
  else
    echo "$name: noticed ($law)"
  fi
  cp "$file.sound" "$file"; rm -f "$file.sound"
done
[ "$survivors" = 0 ] || { echo "$survivors not noticed"; exit 1; }
