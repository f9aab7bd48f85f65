#!/usr/bin/env bash
# Installs the hook scripts/commit-msg if the sources are a git checkout. Does not replace another hook.
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
top=$(git rev-parse --show-toplevel 2>/dev/null) || exit 0
# The sources may lie inside the checkout of another project; then no hook is installed.
[[ $top -ef . ]] || exit 0
if [[ -n $(git config core.hooksPath || true) ]]; then exit 0; fi

hook=$(git rev-parse --git-path hooks)/commit-msg
if [[ -e $hook ]] && ! grep -q 'scripts/commit-msg' "$hook"; then
  printf 'setup: there is another commit-msg hook; call scripts/commit-msg from it\n'
  exit 0
fi
mkdir -p "$(dirname "$hook")"
# On a branch without scripts/commit-msg the hook accepts every commit.
cat >"$hook" <<'EOF'
#!/bin/sh
script=$(git rev-parse --show-toplevel)/scripts/commit-msg
[ ! -f "$script" ] || exec bash "$script" "$1"
EOF
chmod 755 "$hook"
