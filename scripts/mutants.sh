#!/usr/bin/env bash
# Puts the bug of every test/mutants/*.mutant into a copy of the sources, one at a time, and runs the law
# that has to notice it. Fails at once when a mutant no longer applies, and in the end when a law has
# not noticed its bug. Names as arguments choose some of the mutants. As many copies as there are
# processors share the mutants; MUTANTS_COPIES sets another number.
set -u
top=$(cd "$(dirname "$0")/.." && pwd)
stack() { command stack --work-dir .stack-work "$@"; }
mutants() { python3 "$top/scripts/mutants.py" "$@"; }

mutants check "$@" || { echo "these mutants do not apply to the sources as they are"; exit 1; }

# Makes the copy in the current folder equal to the sources. Only files that differ are copied,
# whatever their times: the build compares times.
refresh() {
  local copy=$PWD
  (cd "$top" && git ls-files -z --cached --others --exclude-standard | while IFS= read -r -d '' f; do
    [ ! -f "$f" ] || cmp -s "$f" "$copy/$f" || cp --parents "$f" "$copy"
  done)
  # Files that were removed since are removed here too.
  find app bench src test machines explain fonts -type f | while IFS= read -r f; do [ -f "$top/$f" ] || rm -f "$f"; done
}

# Tries the mutants with these names in the copy with this number.
try() {
  local copy=$top/build/mutants-$1 name law file out survivors=0
  shift
  mkdir -p "$copy"
  cd "$copy" || exit 1
  refresh
  for name in "$@"; do
    law=$(mutants law "$name")
    file=$(mutants file "$name")
    cp "$top/$file" "$file.sound"
    mutants apply "$name" "$copy"
    if ! stack build --fast --test --no-run-tests >build.log 2>&1; then
      echo "$name: does not build"; tail -n 20 build.log; survivors=$((survivors + 1))
    else
      # The arguments of a test know double quotes only.
      out=$(timeout 300 stack --verbosity error test --fast --test-arguments "--match \"$law\"" 2>&1)
      status=$?
      if [ $status = 124 ] || grep -qE '^[0-9]+ examples?, [1-9][0-9]* failures?' <<<"$out"; then
        echo "$name: noticed ($law)"
      elif grep -qE '^[1-9][0-9]* examples?, 0 failures' <<<"$out"; then
        echo "$name: SURVIVED ($law)"; survivors=$((survivors + 1))
      else
        echo "$name: its law did not run ($law)"; printf '%s\n' "$out" | tail -n 5; survivors=$((survivors + 1))
      fi
    fi
    cp "$file.sound" "$file"; rm -f "$file.sound"
  done
  [ "$survivors" = 0 ]
}

chosen=("$@")
if [ $# -eq 0 ]; then for f in "$top"/test/mutants/*.mutant; do chosen+=("$(basename "$f" .mutant)"); done; fi
copies=${MUTANTS_COPIES:-$(nproc)}
((copies <= ${#chosen[@]})) || copies=${#chosen[@]}

workers=()
for ((k = 0; k < copies; k++)); do
  share=()
  for ((i = k; i < ${#chosen[@]}; i += copies)); do share+=("${chosen[i]}"); done
  try "$k" "${share[@]}" &
  workers+=($!)
done
failed=0
for worker in "${workers[@]}"; do wait "$worker" || failed=1; done
[ "$failed" = 0 ] || { echo "not every bug was noticed"; exit 1; }
