#!/bin/bash
# Measures point inversion on CAD models beside Open CASCADE and VTK's cell locator: builds
# cad_benchmark in build/inversion-benchmark and writes a table (cad.md) and numbers (cad.csv) into
# benchmark-output. Two minutes.
#
#   Utilities/benchmark_cad.sh                    everything
#   Utilities/benchmark_cad.sh --points 10000     rough figures
#   Utilities/benchmark_cad.sh --fill-page [...]  also into Documentation/Benchmarks.md
#
# The files are bearing.iges of the package occt-misc and, where it is found below
# FOOTPOINT_CAD_FILES or in the documentation of gmsh, the assembly as1-tu-203.stp.gz. Other
# arguments go to cad_benchmark, which lists them with --help. Leave the machine alone meanwhile.
set -euo pipefail
cd "$(dirname "$0")/.."

fill_page=
if [ "${1:-}" = --fill-page ]; then
  fill_page=yes
  shift
fi

Utilities/set_up.sh benchmarks || echo "benchmark: measuring with what is installed" >&2
cmake --preset inversion-benchmark -DFOOTPOINT_CORE_ONLY=OFF -DFOOTPOINT_WITH_OCCT=ON >/dev/null
cmake --build --preset inversion-benchmark --target cad_benchmark

files=()
for folder in "${FOOTPOINT_CAD_FILES:-}" /usr/share/doc/gmsh-doc; do
  if [ -d "$folder" ] && [ ${#files[@]} -eq 0 ]; then
    mapfile -t files < <(find "$folder" -name 'as1-tu-203.stp.gz' | sort | head -n 1)
  fi
done
[ ${#files[@]} -gt 0 ] || echo "benchmark: no as1-tu-203.stp.gz; see FOOTPOINT_CAD_FILES" >&2
files+=(/usr/share/opencascade/data/iges/bearing.iges)

mkdir -p benchmark-output
build/inversion-benchmark/bin/cad_benchmark --output benchmark-output "$@" "${files[@]}"
if [ -n "$fill_page" ]; then
  /usr/bin/python3 Testing/Benchmarks/fill_page.py benchmark-output/cad.md Documentation/Benchmarks.md
fi
