# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of what inversion_benchmark measured.

    plot.py <folder of inversion.csv> [folder for the pictures, the same by default]

Writes inversion-shapes.png, inversion-accuracy.png and inversion-scaling.png. Needs matplotlib.
"""

import csv
import math
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")  # no display
import matplotlib.pyplot as plt  # noqa: E402

MAIN_CLASSES = ("on", "near", "off", "far")
# Colours that colour-blind readers tell apart (M. Okabe and K. Ito 2008), and shapes for print.
STYLES = {"Footpoint": ("#d55e00", "o"), "OCCT": ("#0072b2", "s"), "SISL": ("#009e73", "^"),
          "VTK locator": ("#cc79a7", "D")}
TIME = "time a point [µs]"
SMALLEST_ERROR = 1e-17  # what an error of 0 is drawn as
RESOLUTION = 110  # dots an inch


def read(path):
    """Rows of the file; what is a number becomes one."""
    def value(text):
        try:
            return float(text)
        except ValueError:
            return text
    with open(path, encoding="utf-8", newline="") as file:
        return [{key: value(text) for key, text in row.items()} for row in csv.DictReader(file)]


def part(rows, name, program=None):
    """The rows of a part of the measurement, of one program where one is named."""
    return [row for row in rows
            if row["part"] == name and program in (None, row["program"])]


def programs(rows):
    """Those that were measured, in the order of STYLES."""
    return [name for name in STYLES if part(rows, "comparison", name)]


def legend_above(axes):
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=len(STYLES), frameon=False)


def finish(figure, axes, path):
    for one in axes:
        one.grid(True, which="major", alpha=0.3)
        one.spines[["top", "right"]].set_visible(False)
    figure.savefig(path, dpi=RESOLUTION)
    plt.close(figure)
    print(path)


def draw_shapes(rows, path):
    """Mean time over the four classes, a line a shape."""
    shapes = list(dict.fromkeys(row["shape"] for row in part(rows, "comparison")))
    figure, axes = plt.subplots(figsize=(8, 1 + 0.27 * len(shapes)), layout="constrained")
    for program in programs(rows):
        color, marker = STYLES[program]
        means, places = [], []
        for place, shape in enumerate(shapes):
            times = [row["microseconds"] for row in part(rows, "comparison", program)
                     if row["shape"] == shape and row["query"] in MAIN_CLASSES]
            if times:
                means.append(sum(times) / len(times))
                places.append(place)
        axes.plot(means, places, marker, color=color, label=program)
    axes.set_xscale("log")
    axes.set_xlabel(f"{TIME}, mean of on, near, off and far")
    axes.set_yticks(range(len(shapes)), shapes)
    axes.invert_yaxis()
    legend_above(axes)
    finish(figure, [axes], path)


def draw_accuracy(rows, path):
    """Largest error against time, a mark for every shape and class."""
    figure, axes = plt.subplots(figsize=(8, 4.5), layout="constrained")
    for program in programs(rows):
        color, marker = STYLES[program]
        shown = [row for row in part(rows, "comparison", program)
                 if row["query"] in MAIN_CLASSES and math.isfinite(row["error"])]
        axes.plot([row["microseconds"] for row in shown],
                  [max(row["error"], SMALLEST_ERROR) for row in shown],
                  marker, color=color, label=program, alpha=0.6, markersize=5)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel(TIME)
    axes.set_ylabel("largest error of the distance / size")
    legend_above(axes)
    finish(figure, [axes], path)


def draw_scaling(rows, path):
    """Time against pieces, points and threads."""
    figure, (pieces, points, threads) = plt.subplots(1, 3, figsize=(12, 4), layout="constrained")
    for program in programs(rows):
        color, marker = STYLES[program]
        shown = part(rows, "pieces", program)
        pieces.plot([row["scale"] for row in shown], [row["microseconds"] for row in shown],
                    marker + "-", color=color, label=program)
    pieces.set(xscale="log", yscale="log", xlabel="Bézier pieces", ylabel=TIME,
               title="One query at a time, half a piece off")
    color, marker = STYLES["Footpoint"]
    shown = part(rows, "points")
    points.plot([row["scale"] for row in shown], [row["microseconds"] for row in shown],
                marker + "-", color=color)
    points.set(xscale="log", xlabel="points", ylabel=TIME,
               ylim=(0, 1.2 * max(row["microseconds"] for row in shown)),
               title="Filter on 40 × 40, one thread")
    shown = part(rows, "threads")
    counts = [row["scale"] for row in shown]
    threads.plot(counts, [shown[0]["microseconds"] / row["microseconds"] for row in shown],
                 marker + "-", color=color)
    threads.plot(counts, counts, ":", color="grey")
    threads.set(xlabel="threads", ylabel="speed-up (dotted: ideal)", xticks=counts, ylim=(0, 1.1 * max(counts)),
                title="Filter on 40 × 40, threads")
    pieces.legend(frameon=False)
    finish(figure, [pieces, points, threads], path)


def main():
    source = pathlib.Path(sys.argv[1])
    target = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else source)
    target.mkdir(parents=True, exist_ok=True)
    rows = read(source / "inversion.csv")
    draw_shapes(rows, target / "inversion-shapes.png")
    draw_accuracy(rows, target / "inversion-accuracy.png")
    if all(part(rows, name) for name in ("pieces", "points", "threads")):
        draw_scaling(rows, target / "inversion-scaling.png")


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    main()
