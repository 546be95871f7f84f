#!/bin/bash
# Installs what one flavour of the build needs on Debian 12 (bookworm):
#
#   Utilities/set_up.sh vtk         compiler and its cache, Eigen, GoogleTest, Open CASCADE, VTK 9.1,
#                                   Open MPI, Xvfb
#   Utilities/set_up.sh paraview    the same tools, and ParaView 5.11 in a private folder, with what
#                                   its help pages and the tests of its window need
#   Utilities/set_up.sh benchmarks  as vtk, and what Testing/Benchmarks needs and compares with
#
# Works as root or through sudo, says what it does, and does nothing where all is there already.
#
# Debian's python3-paraview conflicts with libvtk9-dev. To have both, ParaView's packages are
# unpacked, not installed, into $FOOTPOINT_PARAVIEW_ROOT
# (default: ${XDG_CACHE_HOME:-$HOME/.cache}/footpoint/paraview-5.11); the libraries that they
# depend on are installed as usual.
set -euo pipefail

paraview_root=${FOOTPOINT_PARAVIEW_ROOT:-${XDG_CACHE_HOME:-$HOME/.cache}/footpoint/paraview-5.11}

tools=(cmake ninja-build ccache g++ libeigen3-dev libgtest-dev libhwy-dev openmpi-bin python3-numpy
  xvfb xauth libgl1-mesa-dri)
# CAD files: brings all of Open CASCADE's development packages; and the parts of demo.sh.
cad=(libocct-data-exchange-dev zlib1g-dev occt-misc)
vtk=(libvtk9-dev python3-vtk9)
# What ParaView's CMake files ask for and paraview-dev does not depend on.
paraview=(libutfcpp-dev libdouble-conversion-dev liblz4-dev liblzma-dev libexpat1-dev
  libpython3-dev libopenmpi-dev zlib1g-dev libgl-dev libglew-dev libx11-dev libpng-dev
  libjpeg-dev libtiff-dev libfreetype-dev)
# The plugin's help pages; and ParaView's window under test: its widgets in Python, icons, a font.
paraview_help=(qttools5-dev qtxmlpatterns5-dev-tools qhelpgenerator-qt5 libqt5sql5-sqlite)
paraview_window=(python3-pyqt5 libqt5svg5 fonts-dejavu-core)
benchmarks=(libsisl-dev libbenchmark-dev python3-matplotlib)

say() { echo "set-up: $*"; }

as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  elif command -v sudo >/dev/null; then
    sudo "$@"
  else
    say "this needs root or sudo: $*" >&2
    return 1
  fi
}

# Prints those of the named packages that are neither installed nor provided by one that is.
missing() {
  dpkg-query -W -f '${db:Status-Status} ${Package},${Provides}\n' |
    sed -n 's/^installed //p' | sed 's/([^)]*)//g' | tr -s ', ' '\n' | sort -u |
    comm -13 - <(printf '%s\n' "$@" | sort -u)
}

# Package lists are fetched once a run, and only if something has to be installed.
lists_are_new=
update_lists() {
  [ -z "$lists_are_new" ] || return 0
  say "fetching the package lists"
  as_root apt-get -q -o DPkg::Lock::Timeout=600 update
  lists_are_new=yes
}

# apt_get <install|satisfy> <what>...: --no-remove, so that a system-wide ParaView stops us with a
# message rather than being removed for libvtk9-dev.
apt_get() {
  update_lists
  as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq -y -o DPkg::Lock::Timeout=600 \
    -o Dpkg::Use-Pty=0 --no-install-recommends --no-remove "$@"
}

install_packages() {
  local wanted
  mapfile -t wanted < <(missing "$@")
  [ ${#wanted[@]} -gt 0 ] || return 0
  say "installing ${wanted[*]}"
  apt_get install "${wanted[@]}"
}

# The root appears in one step (mv), so a root that exists is complete.
unpack_paraview() {
  [ ! -d "$paraview_root" ] || return 0
  say "unpacking ParaView 5.11 into $paraview_root"
  update_lists
  mkdir -p "$(dirname "$paraview_root")"
  local scratch
  scratch=$(mktemp -d "$paraview_root.XXXXXX")
  # shellcheck disable=SC2064 # the folder of now is meant
  trap "rm -rf '$scratch'" EXIT
  chmod 755 "$scratch"
  mkdir "$scratch/packages" "$scratch/root"
  (cd "$scratch/packages" &&
    apt-get -q -o APT::Sandbox::User= download paraview paraview-dev python3-paraview)
  local package
  for package in "$scratch"/packages/*.deb; do
    dpkg-deb -x "$package" "$scratch/root"
  done
  dpkg-deb -f "$scratch"/packages/paraview_*.deb Depends >"$scratch/root/depends"
  mv -T "$scratch/root" "$paraview_root"
  rm -rf "$scratch"
}

# The libraries that ParaView's programs load: of alternatives (a | b) the first.
install_paraview_libraries() {
  local depends names
  depends=$(cat "$paraview_root/depends")
  read -r -a names <<<"$(sed 's/([^)]*)//g; s/|[^,]*//g; s/,/ /g' <<<"$depends")"
  [ -n "$(missing "${names[@]}")" ] || return 0
  say "installing the libraries of ParaView: $(missing "${names[@]}" | paste -sd ' ')"
  apt_get satisfy "$depends"
}

case "${1:-}" in
vtk)
  install_packages "${tools[@]}" "${cad[@]}" "${vtk[@]}"
  ;;
paraview)
  install_packages "${tools[@]}" "${cad[@]}" "${paraview[@]}" "${paraview_help[@]}" \
    "${paraview_window[@]}"
  unpack_paraview
  install_paraview_libraries
  ;;
benchmarks)
  install_packages "${tools[@]}" "${cad[@]}" "${vtk[@]}" "${benchmarks[@]}"
  ;;
*)
  echo "usage: $0 vtk | paraview | benchmarks" >&2
  exit 2
  ;;
esac
say "$1: all there"
