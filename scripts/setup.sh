#!/usr/bin/env bash
# Installs the Debian packages of scripts/packages.txt that are missing.
# If none is missing, it prints nothing and changes nothing.
#
#   setup.sh build test    the packages of these groups
#   setup.sh               the packages of build, test and check, which work on partc needs
#
# With PARTC_NO_SETUP=1 it does nothing. Use this on a system whose compiler and libraries are not Debian's.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
list=$here/packages.txt

fail() {
  printf 'setup: %s\n' "$@" >&2
  exit 1
}

if [[ ${PARTC_NO_SETUP:-} == 1 ]]; then
  exit 0
fi

groups=("$@")
if ((${#groups[@]} == 0)); then groups=(build test check); fi
for group in "${groups[@]}"; do
  grep -qxF "[$group]" "$list" || fail "scripts/packages.txt has no group $group."
done

wanted=()
group=
while read -r name _; do
  case $name in
    '' | '#'*) ;;
    '['*) group=${name//[\[\]]/} ;;
    *) if [[ " ${groups[*]} " == *" $group "* ]]; then wanted+=("$name"); fi ;;
  esac
done <"$list"

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  fail "this system does not install packages with apt-get." \
    "partc is built with the compiler and libraries of Debian 12; their names are in scripts/packages.txt." \
    "Install their counterparts (GHC 9.0.2) and run make again with PARTC_NO_SETUP=1."
fi

# dpkg-query fails if it does not know a name. Such a package counts as missing.
declare -A have=()
while read -r name status; do
  if [[ $status == installed ]]; then have[$name]=1; fi
done < <(dpkg-query -W -f '${Package} ${db:Status-Status}\n' "${wanted[@]}" 2>/dev/null || true)

missing=()
for name in "${wanted[@]}"; do
  [[ -n ${have[$name]:-} ]] || missing+=("$name")
done

if ((${#missing[@]} == 0)); then
  exit 0
fi

as_root=()
if ((EUID != 0)); then
  if ! command -v sudo >/dev/null; then
    fail "these packages are missing, and installing them needs root or sudo:" \
      "  ${missing[*]}" \
      "As root: apt-get install ${missing[*]}"
  elif [[ -t 0 ]]; then
    as_root=(sudo)
  else
    as_root=(sudo -n)
  fi
fi

printf 'setup: installing %s\n' "${missing[*]}"

log=$(mktemp)
trap 'rm -f "$log"' EXIT

apt() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get -q -y -o DPkg::Lock::Timeout=300 "$@" </dev/null >>"$log" 2>&1
}

# A failed update is ignored, because the packages may be known or cached already.
apt update || true
if ! apt install --no-install-recommends "${missing[@]}"; then
  cat "$log" >&2
  fail "apt-get could not install: ${missing[*]}" \
    "The list is that of Debian 12 (bookworm); the lines above say what went wrong."
fi
