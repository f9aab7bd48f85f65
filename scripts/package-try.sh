#!/usr/bin/env bash
# Tries the Debian package and the archive, each in a Debian 12 of its own without Haskell: installs or
# unpacks it, compiles an example, and compares the tape with the one that PARTC makes on this system.
#
#   package-try.sh PARTC DEB ARCHIVE
#
# Needs root. The new Debian 12 is kept in build/try. PARTC_MIRROR names another mirror of Debian.
set -euo pipefail

partc=$1
deb=$2
archive=$3
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
try=$root/build/try
mirror=${PARTC_MIRROR:-http://deb.debian.org/debian}

if ((EUID != 0)); then
  exec sudo --preserve-env=PARTC_MIRROR bash "${BASH_SOURCE[0]}" "$@"
fi

fail() {
  printf 'deb-try: %s\n' "$@" >&2
  exit 1
}

mkdir -p "$try"
if [[ ! -f $try/bare.done ]]; then
  rm -rf "$try/bare"
  debootstrap --variant=minbase bookworm "$try/bare" "$mirror" >"$try/debootstrap.log" 2>&1 ||
    fail "debootstrap could not make a Debian 12; build/try/debootstrap.log says why."
  touch "$try/bare.done"
fi

"$partc" compile "$root/examples/flange.part" -o "$try/here.tape"

# Makes a copy of the new Debian 12 for one trial. For the archive, the libraries that it contains are removed from the copy below.
fresh() {
  rm -rf "$try/system"
  cp -a "$try/bare" "$try/system"
  cp /etc/resolv.conf "$try/system/etc/resolv.conf"
  cp "$root/examples/flange.part" "$try/system/root/"
}

# Runs a command inside the copy. The command has a /proc of its own, by which the archive's program finds
# its libraries; it is unmounted when the command ends.
inside() { unshare --pid --fork --mount-proc --root="$try/system" /usr/bin/env -i HOME=/root PATH="$path" "$@"; }

compiles() {
  local how=$1
  if inside sh -c 'command -v ghc || command -v stack' >/dev/null; then fail "there is a Haskell compiler in the Debian 12."; fi
  inside sh -c 'cd /root && partc compile flange.part && partc verify flange.part | tail -n 1 && partc explain E0101 >explained'
  cmp "$try/here.tape" "$try/system/root/flange.lkp-01f.tape" || fail "$how: the tape is another one."
  printf '%s: %s compiles examples/flange.part to the same tape\n' "$how" "$(inside partc --version)"
}

path=/usr/sbin:/usr/bin:/sbin:/bin
fresh
cp "$deb" "$try/system/root/"
inside env DEBIAN_FRONTEND=noninteractive sh -c \
  "dpkg -i /root/${deb##*/} || { apt-get -q update && apt-get -q -y -f install; }" >"$try/install.log" 2>&1 ||
  fail "the package could not be installed; build/try/install.log says why."
inside dpkg -s partc | grep '^Depends:'
contents=$(dpkg-deb -c "$deb")
for file in share/man/man1/partc.1.gz share/bash-completion/completions/partc share/zsh/vendor-completions/_partc \
  share/fish/vendor_completions.d/partc.fish share/partc/machines/lkp-01f.machine share/partc/explain/E0101.md; do
  # The contents of the package are examined, because the dpkg of a minimal system may not install manual pages.
  [[ $contents == *"./usr/$file"* ]] || fail "the package has no $file."
done
compiles "${deb##*/}"

fresh
tar -C "$try/system/root" -xzf "$archive"
folder=$(basename "$archive" .tar.gz)
# Remove from the system the libraries that the archive contains, so that those of the archive are used.
for library in "$try/system/root/$folder/lib/partc"/*; do
  find "$try/system/usr/lib" "$try/system/lib" -name "${library##*/}*" -delete 2>/dev/null || true
done
path=/root/$folder/bin:/usr/bin:/bin
compiles "${archive##*/}"
rm -rf "$try/system"
