#!/bin/bash
# Runs the main job, on a fresh Debian 12 too: installs packages where any are missing (as root or
# through sudo), builds build/vtk, and writes a picture, a .vtp and a report into demo-output/.
set -euo pipefail
cd "$(dirname "$0")"

Utilities/set_up.sh vtk

echo "demo: building the Python package in build/vtk"
[ -f build/vtk/build.ninja ] || cmake --preset vtk
cmake --build --preset vtk --target footpoint_python

echo "demo: running Documentation/examples/demo.py"
mkdir -p demo-output
PYTHONPATH=build/vtk/lib/python3/dist-packages \
  xvfb-run -a -s "-screen 0 1280x1024x24" \
  /usr/bin/python3 Documentation/examples/demo.py demo-output
echo "demo: written into demo-output/:"
ls -l demo-output
