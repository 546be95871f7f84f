#!/bin/bash
# Measures point inversion beside Open CASCADE, SISL and VTK's cell locator, on a fresh Debian 12
# too: installs packages where any are missing (as root or through sudo), builds
# build/inversion-benchmark, and writes tables (inversion.md), numbers (inversion.csv) and pictures
# (PNG) into benchmark-output. Arguments go to build/inversion-benchmark/bin/inversion_benchmark,
# which lists them with --help.
set -euo pipefail
cd "$(dirname "$0")/.."

Utilities/set_up.sh benchmarks
cmake --preset inversion-benchmark >/dev/null
cmake --build --preset inversion-benchmark
mkdir -p benchmark-output
build/inversion-benchmark/bin/inversion_benchmark --output benchmark-output "$@" |
  tee benchmark-output/inversion.md
/usr/bin/python3 Testing/Benchmarks/plot.py benchmark-output
