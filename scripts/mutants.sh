#!/usr/bin/env bash
# Puts the bug of every test/mutants/*.mutant into a copy of the sources, one at a time, and runs the law
# that should notice it. Fails when a law does not. Names as arguments choose some of them.
set -u
top=$(cd "$(dirname "$0")/.." && pwd)
copy=$top/build/mutants
stack() { command stack --work-dir .stack-work "$@"; }

mkdir -p "$copy"
# Only what differs is copied, whatever its time: the build takes files by their times.
(cd "$top" && git ls-files --cached --others --exclude-standard | while IFS= read -r f; do
  [ ! -f "$f" ] || cmp -s "$f" "$copy/$f" || cp --parents "$f" "$copy"
done)
cd "$copy" || exit 1
# What was removed since is removed here too.
find app bench src test machines explain -type f | while IFS= read -r f; do [ -f "$top/$f" ] || rm -f "$f"; done

chosen=()
if [ $# -gt 0 ]; then for n in "$@"; do chosen+=("test/mutants/$n.mutant"); done; else chosen=(test/mutants/*.mutant); fi

survivors=0
for mutant in "${chosen[@]}"; do
  name=$(basename "$mutant" .mutant)
  law=$(sed -n 's/^law: //p' "$mutant")
  file=$(sed -n 's/^file: //p' "$mutant")
  cp "$top/$file" "$file.sound"
  perl -0777 -e '
    my ($mutant, $file) = @ARGV;
    open my $m, "<", $mutant; my $t = do { local $/; <$m> };
    my ($old, $new) = $t =~ /--- instead of\n(.*)\n--- put\n(.*)\n/s or die "not a mutant\n";
    open my $s, "<", $file; my $c = do { local $/; <$s> };
    my $at = index($c, $old);
    die "its text is not in $file exactly once\n" if $at < 0 || index($c, $old, $at + 1) >= 0;
    substr($c, $at, length $old) = $new;
    open my $o, ">", $file; print $o $c;
  ' "$mutant" "$file" || { echo "$name: cannot be put in"; survivors=$((survivors + 1)); cp -p "$file.sound" "$file"; continue; }
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
