#!/bin/bash
# Builds the benchmarks of Core in build/benchmarks and prints their tables. Needs no VTK, but
# Google Benchmark (on Debian: libbenchmark-dev). Leave the machine alone meanwhile.
set -euo pipefail
cd "$(dirname "$0")/.."
cmake --preset benchmarks >/dev/null
cmake --build --preset benchmarks
