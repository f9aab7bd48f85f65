#!/usr/bin/env bash
# Drives the language server by a client in Python, pytest-lsp, which checks every message against the
# protocol. The argument is the program partc. The libraries of the client are fetched into build/client.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
venv=$root/build/client
if [[ ! -x $venv/bin/pytest ]]; then
  python3 -m venv "$venv"
  "$venv/bin/pip" --quiet install --requirement "$root/test/client/requirements.txt"
fi
PARTC=$1 PYTHONDONTWRITEBYTECODE=1 "$venv/bin/pytest" -c "$root/test/client/pytest.ini" "$root/test/client"
