# SPDX-License-Identifier: BSD-3-Clause
"""The parts of demo.py: a simulated scan, what its deviations show, a picture and a report."""
