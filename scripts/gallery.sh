#!/usr/bin/env bash
# Draws the pictures of docs/gallery.md anew: runs each command of the page. The argument is the program partc.
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
sed -n 's/^    partc //p' docs/gallery.md | while read -r -a arguments; do
  "$1" "${arguments[@]}" </dev/null
done
