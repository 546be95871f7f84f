# SPDX-License-Identifier: BSD-3-Clause
"""The parts of demo.py: a simulated scan, what is found in its deviations, a picture and a report."""
