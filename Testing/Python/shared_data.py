# SPDX-License-Identifier: BSD-3-Clause
"""Reads the real geometry of FOOTPOINT_SHARED_DATA for tests."""

import json
import os
from pathlib import Path
import sys

import numpy as np

import footpoint

SKIP = 125  # ctest: skipped


def folder():
    """The folder, or the end of the program as a skipped test where there is none."""
    path = Path(os.environ.get("FOOTPOINT_SHARED_DATA", ""))
    if not (path / "json").is_dir():
        print(f"skipped: FOOTPOINT_SHARED_DATA ('{path}') holds no folder json")
        sys.exit(SKIP)
    return path


def records(path, kind):
    """The JSON objects of one type ('face' or 'edge') of a file; edges that are a point left out."""
    with open(path, encoding="utf-8") as lines:
        objects = [json.loads(line) for line in lines]
    return [record for record in objects if record["type"] == kind and "cp" in record]


def make_face(record):
    """The surface of a face, without its trim loops."""
    cp = np.asarray(record["cp"])
    weights = cp[..., 3] if record["rational"] else None
    return footpoint.nurbs_surface(cp[..., :3], record["knotsU"], record["knotsV"], weights)


def make_curve(record):
    cp = np.asarray(record["cp"])
    return footpoint.nurbs_curve(cp[:, :3], record["knots"], cp[:, 3])


def domain(record):
    """Lower and upper corner of the domain of a face ((2,) arrays) or an edge ((1,) arrays)."""
    if record["type"] == "edge":
        knots, p = record["knots"], record["degree"]
        return np.array([knots[p]]), np.array([knots[-p - 1]])
    pu, pv = record["degreeU"], record["degreeV"]
    u, v = record["knotsU"], record["knotsV"]
    return np.array([u[pu], v[pv]]), np.array([u[-pu - 1], v[-pv - 1]])


def size(*data):
    """Diagonal of the bounding box of all control points."""
    boxes = np.array([d.GetBounds() for d in data]).reshape(-1, 3, 2)
    return np.linalg.norm(boxes[:, :, 1].max(axis=0) - boxes[:, :, 0].min(axis=0))
