#!/usr/bin/env bash
# Tries the editors that are installed, each with the language server:
#
#   editors-try.sh PARTC
#
# - Emacs with editors/emacs, through eglot and, if it is installed, lsp-mode
# - Neovim with the settings of editors/nvim/README.md for Neovim without the plugin
# - Kakoune with editors/kakoune
#
# An editor that is not installed is named and left out. After each editor no server may be left.
# PARTC is the program partc.
set -euo pipefail

partc=$(realpath "$1")
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"

fail() {
  printf 'editors: %s\n' "$@" >&2
  exit 1
}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# The `partc` on the path of the editors writes down its process and is then replaced by the real one.
mkdir "$work/bin"
cat >"$work/bin/partc" <<SHIM
#!/bin/sh
[ "\$1" = lsp ] && echo \$\$ >>"$work/servers"
exec "$partc" "\$@"
SHIM
chmod +x "$work/bin/partc"

# Runs an editor with a home of its own. NEEDS is the number of servers that it has to start at least.
try() {
  local name=$1 needs=$2 status=0
  shift 2
  rm -rf "$work/home" "$work/folder"
  mkdir -p "$work/home/.config" "$work/home/run" "$work/folder"
  : >"$work/servers"
  env HOME="$work/home" XDG_CONFIG_HOME="$work/home/.config" XDG_DATA_HOME="$work/home/data" \
    XDG_STATE_HOME="$work/home/state" XDG_CACHE_HOME="$work/home/cache" XDG_RUNTIME_DIR="$work/home/run" \
    LC_ALL=C.UTF-8 PARTC_TRY_FOLDER="$work/folder" PATH="$work/bin:$PATH" \
    timeout -k 5 180 "$@" >"$work/log" 2>&1 </dev/null || status=$?
  if ((status != 0)); then
    cat "$work/log" >&2
    fail "$name ended with the status $status."
  fi
  (($(wc -l <"$work/servers") >= needs)) || fail "$name started no server."
  while read -r server; do
    for _ in {1..50}; do
      kill -0 "$server" 2>/dev/null || continue 2
      sleep 0.1
    done
    kill "$server" 2>/dev/null || true
    fail "$name left the server behind."
  done <"$work/servers"
  grep -a "^$name:" "$work/log"
}

have() {
  command -v "$1" >/dev/null || {
    printf '%s: not installed\n' "$2"
    return 1
  }
}

if have emacs emacs; then
  try emacs 1 emacs -q --batch -L editors/emacs -l test/editors/emacs.el
  try emacs-lsp-mode 0 emacs -q --batch -L editors/emacs -l test/editors/emacs-lsp-mode.el
fi

if have nvim neovim; then
  # The block marked `lua` of the page is the whole configuration.
  awk '/^```/ { inside = ($0 == "```lua"); next } inside' editors/nvim/README.md >"$work/init.lua"
  try neovim 1 nvim --headless -n -i NONE -u "$work/init.lua" -c 'luafile test/editors/neovim.lua'
fi

if have kak kakoune; then
  try kakoune 0 python3 test/editors/kakoune.py
fi
