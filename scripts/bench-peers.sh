# Functions for the scripts of the benchmark. They fetch the peers of the offset kernel from crates.io
# and PyPI. If a peer cannot be fetched, they print the reason and continue. They use $root, the folder
# of the sources, and $work, a folder for files of the benchmark. They set these variables:
#   cavalier  the folder of the Rust programs, or nothing
#   chords    the command that runs the libraries without arcs (GEOS, Clipper2), or nothing
#   venv      the Python environment in which these libraries are installed

cavalier=
chords=
venv=$work/python

fetch_cavalier() {
  if ! command -v cargo >/dev/null; then
    printf 'bench: cargo is not installed; cavalier_contours is left out\n'
  elif ! cargo build --quiet --release --locked --manifest-path "$root/bench/peers/cavalier/Cargo.toml" --target-dir "$work/cavalier" 2>"$work/cargo.log"; then
    printf 'bench: cavalier_contours cannot be fetched or built and is left out: %s\n' "$(grep -m 1 '^error' "$work/cargo.log" || tail -n 1 "$work/cargo.log")"
  else
    cavalier=$work/cavalier/release
  fi
}

fetch_chords() {
  local wanted=$root/bench/peers/requirements.txt
  if [[ ! -e $venv/fetched || $wanted -nt $venv/fetched ]]; then
    if ! python3 -m venv "$venv" >"$work/pip.log" 2>&1; then
      printf 'bench: python3 has no venv (package python3-venv); GEOS and Clipper2 are left out\n'
      return
    elif ! "$venv/bin/pip" install --quiet --disable-pip-version-check -r "$wanted" >>"$work/pip.log" 2>&1; then
      printf 'bench: GEOS and Clipper2 cannot be fetched and are left out: %s\n' "$(grep -m 1 -i '^error' "$work/pip.log" || tail -n 1 "$work/pip.log")"
      return
    fi
    touch "$venv/fetched"
  fi
  chords="$venv/bin/python $root/bench/peers/chords.py"
}
