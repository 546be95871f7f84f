# SPDX-License-Identifier: BSD-3-Clause
"""Inspection of a scan against a CAD file, which ./demo.sh runs: `python3 -m inspection --help`."""
