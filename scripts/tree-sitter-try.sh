#!/usr/bin/env bash
# Tests the grammar for tree-sitter, editors/tree-sitter-part, with the program `tree-sitter`:
#
#   tree-sitter-try.sh PARTC
#
# - src/parser.c is what `tree-sitter generate` makes of grammar.js.
# - The tests in test/corpus and test/highlight pass.
# - Every program of examples, test/programs and the documents is parsed without an error, unless partc
#   refuses its form.
# - The queries fit the grammar, and every word of the grammar has a colour. Zed's copies are the same.
#
# PARTC is the program partc. TREE_SITTER names another program than `tree-sitter`.
set -euo pipefail

partc=$(realpath "$1")
tree_sitter=${TREE_SITTER:-tree-sitter}
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
version=$(sed -n 's/.*"tree-sitter-cli": "\(.*\)".*/\1/p' "$root/editors/tree-sitter-part/package.json")

fail() {
  printf 'tree-sitter: %s\n' "$@" >&2
  exit 1
}

found=$("$tree_sitter" --version 2>/dev/null || true)
[[ ${found#tree-sitter } == "$version"* ]] || fail \
  "version $version is needed, found: ${found:-none}." \
  "cargo install tree-sitter-cli --version $version --locked"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# The compiled grammar and the settings of tree-sitter are kept there, not in the home of the user.
export HOME=$work XDG_CACHE_HOME=$work/cache XDG_CONFIG_HOME=$work/config
cp -r "$root/editors/tree-sitter-part" "$work/grammar"
cd "$work/grammar"

"$tree_sitter" generate --abi 14
cmp -s src/parser.c "$root/editors/tree-sitter-part/src/parser.c" ||
  fail "src/parser.c is not what \`tree-sitter generate --abi 14\` makes of grammar.js."

"$tree_sitter" test >"$work/tests" 2>&1 || { cat "$work/tests" >&2; fail "a test failed."; }
tests=$(grep -c '✓' "$work/tests")

# The blocks marked `part` of the documents, each in a file of its own.
mkdir "$work/blocks"
for document in "$root"/README.md "$root"/docs/*.md; do
  awk -v name="$work/blocks/$(basename "$document" .md)" '
    /^```/ { inside = ($0 == "```part"); if (inside) n++; next }
    inside { print > (name "-" n ".part") }' "$document"
done

find "$root/examples" "$root/test/programs" "$work/blocks" -name '*.part' | sort >"$work/programs"
# The program prints a line for every file with an error, and gives the status 1.
"$tree_sitter" parse --quiet --paths "$work/programs" >"$work/parsed" 2>/dev/null || true
refused=0
while IFS= read -r line; do
  file=${line%%$'\t'*}
  file=${file%"${file##*[![:space:]]}"}
  codes=$("$partc" check --format json "$file" 2>&1 | grep -oE '"code":"E01(0[1-9]|1[01]|2[01])"' || true)
  [[ -n $codes ]] || fail "an error in a program that partc accepts: $line"
  refused=$((refused + 1))
done < <(grep -E '\((ERROR|MISSING)' "$work/parsed" || true)

for query in queries/*.scm; do
  "$tree_sitter" query --quiet "$query" "$root/examples/flange.part" >"$work/query" 2>&1 ||
    { cat "$work/query" >&2; fail "$query does not fit the grammar."; }
done
# The words of the grammar are its nodes without a name that consist of letters.
grep -B1 '"named": false' src/node-types.json | sed -nE 's/.*"type": "([a-z]+)".*/\1/p' | sort -u |
  while read -r word; do
    # Units are coloured as nodes.
    case $word in mm | cm | m | deg | rad | rpm | pi | true | false) continue ;; esac
    grep -qF "\"$word\"" queries/highlights.scm || fail "queries/highlights.scm has no colour for the word $word."
  done

for copy in "$root"/editors/zed/languages/part/*.scm; do
  cmp -s "queries/${copy##*/}" "$copy" || fail "$copy differs from queries/${copy##*/}."
done

printf 'tree-sitter: %d tests, %d programs parsed, %d of them with a mistake in their form\n' \
  "$tests" "$(wc -l <"$work/programs")" "$refused"
