#!/bin/bash
# Builds everything and runs every test, on a fresh Debian 12 too: installs packages where any are
# missing (as root or through sudo), then configures, builds and tests
#   build/vtk       against VTK 9.1
#   build/paraview  against ParaView 5.11, without the tests that know no VTK
#   build/sanitize  Core alone, with address and undefined-behaviour sanitizers
#   build/sanitize-threads  Core alone, with the thread sanitizer
# Goes on after a failure, sums up at the end, and exits with 1 if anything failed.
set -uo pipefail
cd "$(dirname "$0")" || exit 1

jobs=$(nproc)
# Core is the same for VTK and ParaView, but for folders: compiled once. (What is under sanitizers goes
# past the cache, because of its precompiled headers.)
export CMAKE_CXX_COMPILER_LAUNCHER=ccache CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1
summary=()
failed=0

# step <what it is> <command>...: runs it, and notes how it went and how long it took.
step() {
  local what=$1 start=$SECONDS verdict=ok
  shift
  echo "=== $what"
  "$@" || verdict=FAILED
  [ "$verdict" = ok ] || failed=1
  summary+=("$(printf '%-6s %5d s  %s' "$verdict" $((SECONDS - start)) "$what")")
  [ "$verdict" = ok ]
}

# Rendering needs an X server; one for all tests of a build is safest. It must not start anew when
# its last client leaves (-noreset): a test that connects at that moment is refused. The preset makes
# ctest fail where there are no tests.
run_tests() {
  xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" ctest --preset "$1" -j "$jobs"
}

build_and_test() {
  step "$1: configure" cmake --preset "$1" -DFOOTPOINT_WERROR=ON -DBUILD_TESTING=ON &&
    step "$1: build" cmake --build --preset "$1" -j "$jobs" &&
    step "$1: test" run_tests "$1"
}

step "set-up for VTK" Utilities/set_up.sh vtk && {
  build_and_test vtk
  build_and_test sanitize
  build_and_test sanitize-threads
}
step "set-up for ParaView" Utilities/set_up.sh paraview && build_and_test paraview

echo
echo "=== Summary ($((SECONDS / 60)) min $((SECONDS % 60)) s)"
printf '%s\n' "${summary[@]}"
if [ $failed -eq 0 ]; then
  echo "Everything passed."
else
  echo "Something failed; the later steps of that build were left out."
fi
exit $failed
