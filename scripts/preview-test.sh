#!/usr/bin/env bash
# Tests the page of the preview: lint, its pure modules with Node.js, the page in Chromium against a mock of
# the server, and the program partc with files on the disk. PARTC names the program.
# Screenshots go to build/preview.
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
export SHOTS=$PWD/build/preview
mkdir -p "$SHOTS"

test/browser/node_modules/.bin/eslint --config test/browser/eslint.config.mjs preview test/browser/*.mjs
cd test/browser
node --test --test-reporter spec unit.test.mjs page.test.mjs partc.test.mjs
