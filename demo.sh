#!/bin/bash
# Runs the main job, on a fresh Debian 12 too: installs packages where any are missing (as root or
# through sudo), builds build/vtk, and inspects a scan of a part against its CAD file:
#
#   ./demo.sh                          a part that comes with Open CASCADE, and a simulated scan
#   ./demo.sh FILE.step SCAN.ply       files of your own
#   ./demo.sh --help                   kinds of files, units, tolerance, where results go
#
# Writes a report, pictures, a .vtp, a .csv and a ParaView state into demo-output/.
set -euo pipefail
root=$(cd "$(dirname "$0")" && pwd)

"$root/Utilities/set_up.sh" vtk

echo "demo: building the Python package in build/vtk"
(
  cd "$root"
  [ -f build/vtk/build.ninja ] || cmake --preset vtk
  cmake --build --preset vtk --target footpoint_python
)

echo "demo: running Documentation/examples/inspection"
PYTHONPATH=$root/build/vtk/lib/python3/dist-packages:$root/Documentation/examples \
  xvfb-run -a -s "-screen 0 1280x1024x24" \
  /usr/bin/python3 -m inspection --output "$root/demo-output" "$@"
