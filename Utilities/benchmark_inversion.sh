#!/bin/bash
# Measures point inversion beside Open CASCADE, SISL and VTK's cell locator, on a fresh Debian 12
# too: installs packages where any are missing (as root or through sudo; without them what is
# there is measured), builds build/inversion-benchmark, and writes tables (inversion.md), numbers
# (inversion.csv) and pictures (PNG) into benchmark-output.
#
#   Utilities/benchmark_inversion.sh                              everything, 5 minutes
#   Utilities/benchmark_inversion.sh --budget 0.01 --repeats 1    rough figures, 2 minutes
#   Utilities/benchmark_inversion.sh --fill-page [...]            also into Documentation/Benchmarks.md
#
# Other arguments go to build/inversion-benchmark/bin/inversion_benchmark, which lists them with
# --help. Leave the machine alone meanwhile.
set -euo pipefail
cd "$(dirname "$0")/.."

fill_page=
if [ "${1:-}" = --fill-page ]; then
  fill_page=yes
  shift
fi

Utilities/set_up.sh benchmarks || echo "benchmark: measuring with what is installed" >&2
if ! cmake --preset inversion-benchmark -DFOOTPOINT_CORE_ONLY=OFF >/dev/null; then
  echo "benchmark: measuring without VTK, that is, without its locator and the filter" >&2
  cmake --preset inversion-benchmark -DFOOTPOINT_CORE_ONLY=ON >/dev/null
fi
cmake --build --preset inversion-benchmark
mkdir -p benchmark-output
build/inversion-benchmark/bin/inversion_benchmark --output benchmark-output "$@" |
  tee benchmark-output/inversion.md
if /usr/bin/python3 -c 'import matplotlib' 2>/dev/null; then
  /usr/bin/python3 Testing/Benchmarks/plot.py benchmark-output
else
  echo "benchmark: no pictures without matplotlib (on Debian: python3-matplotlib)" >&2
fi
if [ -n "$fill_page" ]; then
  /usr/bin/python3 Testing/Benchmarks/fill_page.py benchmark-output Documentation/Benchmarks.md
fi
