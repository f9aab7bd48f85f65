# Read by the scripts of the benchmark: the peers of the kernel, from crates.io and PyPI.
# Each function says what is missing and goes on. They want $root and $work and set
#   cavalier  the folder of the Rust programs, or nothing
#   chords    the command of the libraries that know chords only, or nothing
#   venv      where they are installed

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
