#!/usr/bin/env bash
# Packs the program that `make build` has built.
#
#   package.sh deb PARTC DIR    DIR/partc_VERSION_ARCH.deb, for dpkg
#   package.sh dist PARTC DIR   DIR/partc-VERSION-linux-ARCH.tar.gz, to be unpacked anywhere
#
# Prints the name of the file that it writes.
set -euo pipefail

kind=$1
partc=$2
out=$3
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
version=$(sed -n 's/^version: *//p' "$root/package.yaml")
arch=$(dpkg --print-architecture)
mkdir -p "$out"
out=$(cd "$out" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# All files get the time of the last commit, so that the same sources give the same package.
SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git -C "$root" log -1 --format=%ct 2>/dev/null || date +%s)}
export SOURCE_DATE_EPOCH

put() { install -D -m 644 "$1" "$2"; }
packed() { mkdir -p "$(dirname "$2")" && gzip -9nc "$1" >"$2" && chmod 644 "$2"; }

# Copies the files that both the package and the archive contain into a folder, which corresponds to /usr.
fill() {
  local usr=$1 file
  install -D -m 755 "$partc" "$usr/bin/partc"
  strip --strip-unneeded "$usr/bin/partc"
  packed "$root/docs/partc.1" "$usr/share/man/man1/partc.1.gz"
  mkdir -p "$usr/share/bash-completion/completions" "$usr/share/zsh/vendor-completions" "$usr/share/fish/vendor_completions.d"
  (
    # The completion scripts contain the name by which partc was called, so it is called without a path.
    PATH=$usr/bin:$PATH
    partc --bash-completion-script partc >"$usr/share/bash-completion/completions/partc"
    partc --zsh-completion-script partc >"$usr/share/zsh/vendor-completions/_partc"
    partc --fish-completion-script partc >"$usr/share/fish/vendor_completions.d/partc.fish"
  )
  for file in "$root"/machines/*.machine; do put "$file" "$usr/share/partc/machines/${file##*/}"; done
  for file in "$root"/explain/*.md; do put "$file" "$usr/share/partc/explain/${file##*/}"; done
  (cd "$root" && find editors -type f ! -path 'editors/vscode/*' ! -path '*/node_modules/*' ! -path '*/target/*') | while IFS= read -r file; do put "$root/$file" "$usr/share/partc/$file"; done
  (cd "$root" && find examples -type f ! -path 'examples/expected/*') | while IFS= read -r file; do
    put "$root/$file" "$usr/share/doc/partc/$file"
  done
  put "$root/README.md" "$usr/share/doc/partc/README.md"
  put "$root/LICENSE" "$usr/share/doc/partc/copyright"
  put "$root/NOTICE" "$usr/share/doc/partc/NOTICE"
  packed "$root/CHANGELOG.md" "$usr/share/doc/partc/changelog.gz"
}

same_times() { find "$1" -exec touch -h -d "@$SOURCE_DATE_EPOCH" {} +; }

deb() {
  local tree=$work/tree libraries size
  fill "$tree/usr"
  # dpkg-shlibdeps reads debian/control and prints the packages of the shared libraries.
  mkdir "$work/debian"
  printf 'Source: partc\n\nPackage: partc\nArchitecture: any\n' >"$work/debian/control"
  libraries=$(cd "$work" && dpkg-shlibdeps -O "$tree/usr/bin/partc" 2>/dev/null | sed -n 's/^shlibs:Depends=//p')
  size=$(du -sk "$tree" | cut -f 1)
  mkdir "$tree/DEBIAN"
  cat >"$tree/DEBIAN/control" <<EOF
Package: partc
Version: $version
Architecture: $arch
Maintainer: The partc authors <partc@localhost>
Installed-Size: $size
Depends: $libraries
Section: science
Priority: optional
Description: compiler from part programs to tapes for numerically controlled machines
 partc reads a part program, checks it, evaluates the geometry of the part,
 offsets its contours for the cutter and punches a tape for a chosen
 controller. It then reads the tape back, runs it on a model of that
 controller and compares the result with the part.
EOF
  (cd "$tree" && find usr -type f -print0 | sort -z | xargs -0 md5sum) >"$tree/DEBIAN/md5sums"
  same_times "$tree"
  dpkg-deb --root-owner-group --build "$tree" "$out/partc_${version}_$arch.deb" >/dev/null
  printf '%s\n' "$out/partc_${version}_$arch.deb"
}

dist() {
  local name=partc-$version-linux-$arch tree library path
  tree=$work/$name
  fill "$tree"
  # All shared libraries except those of the C library, which every system has.
  mkdir -p "$tree/lib/partc"
  ldd "$tree/bin/partc" | while read -r library _ path _; do
    case $library in
      libc.so.* | libm.so.* | libpthread.so.* | libdl.so.* | librt.so.* | linux-vdso.so.* | /lib*) ;;
      *) put "$path" "$tree/lib/partc/$library" ;;
    esac
  done
  patchelf --set-rpath '$ORIGIN/../lib/partc' "$tree/bin/partc"
  same_times "$tree"
  tar -C "$work" --sort=name --owner=0 --group=0 --numeric-owner -c "$name" | gzip -9n >"$out/$name.tar.gz"
  printf '%s\n' "$out/$name.tar.gz"
}

case $kind in
  deb | dist) "$kind" ;;
  *) printf 'package.sh: %s is neither deb nor dist\n' "$kind" >&2; exit 2 ;;
esac
