# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of what inversion_benchmark measured.

    plot.py <folder of inversion.csv> [folder for the pictures, the same by default]

Writes inversion-shapes.png, inversion-accuracy.png and, where everything was measured,
inversion-scaling.png; panels of what was left out are left out. Needs matplotlib.
"""

import csv
import math
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")  # no display
import matplotlib.pyplot as plt  # noqa: E402

OURS = "Footpoint"
BATCH = "Footpoint batch"  # all points in one call
MAIN_CLASSES = ("on", "near", "off", "far")
# Colours that colour-blind readers tell apart (M. Okabe and K. Ito 2008), and shapes for print.
STYLES = {OURS: ("#d55e00", "o"), BATCH: ("#e69f00", "v"),
          "OCCT": ("#0072b2", "s"), "SISL": ("#009e73", "^"),
          "VTK locator": ("#cc79a7", "D"), "VTK locator 1e-4": ("#56b4e9", "P")}
TIME = "time a point [µs]"
# Shades from light to dark for what gets newer or larger, and hatches for print.
SHADES = (("#f6c9a8", ""), ("#e8915a", "//"), ("#d55e00", ""), ("#7a3600", ""))
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
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=(len(STYLES) + 1) // 2,
                frameon=False)


def finish(figure, axes, path):
    for one in axes:
        one.grid(True, which="major", alpha=0.3)
        one.set_axisbelow(True)
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
    axes.set_ylabel("largest error of a distance / size\n(none: drawn at 1e-17)")
    legend_above(axes)
    finish(figure, [axes], path)


def curve(axes, rows, key, style, **more):
    """Markers and a line of a column against `scale`."""
    color, marker = style
    axes.plot([row["scale"] for row in rows], [row[key] for row in rows], marker + "-",
              color=color, **more)


def pieces_legend(axes):
    axes.set_ylim(top=axes.get_ylim()[1] * 30)  # room for it
    axes.legend(loc="upper left", ncols=2, fontsize="small", frameon=False)


def draw_pieces(axes, rows):
    for program in programs(rows):
        if not part(rows, "pieces", program):
            continue  # asked about the shapes alone
        label = f"{program}, 200 × 200 mesh" if program == "VTK locator" else program
        curve(axes, part(rows, "pieces", program), "microseconds", STYLES[program], label=label)
    axes.set(xscale="log", yscale="log", xlabel="Bézier pieces", ylabel=TIME,
             title="Points in the order of a scan, half a piece off")
    pieces_legend(axes)


def draw_build(axes, rows):
    for program in programs(rows):
        if program == BATCH or not part(rows, "pieces", program):
            continue  # built like another, or asked about the shapes alone
        shown = part(rows, "pieces", program)
        curve(axes, [row for row in shown if row["build_ms"] > 0], "build_ms", STYLES[program],
              label=program)
    axes.set(xscale="log", yscale="log", xlabel="Bézier pieces", ylabel="time once a geometry [ms]",
             title="Building what is searched")
    pieces_legend(axes)


def draw_net(axes, rows):
    for shape, color, marker in (("bumpy40", "#e8915a", "o"), ("bumpy200", "#7a3600", "s")):
        shown = [row for row in part(rows, "net") if row["shape"] == shape]
        poles = shape.removeprefix("bumpy")
        curve(axes, shown, "microseconds", (color, marker),
              label=f"{poles} × {poles} control points")
    axes.set(xlabel="distance from the surface [sizes of a piece]", ylabel=TIME, ylim=(0, None),
             title="One query at a time, points in blocks")
    axes.legend(frameon=False)


def draw_points(axes, rows):
    curve(axes, part(rows, "points"), "microseconds", STYLES[OURS])
    axes.set(xscale="log", xlabel="points, 0.1 × size off", ylabel=TIME, ylim=(0, None),
             title="Filter on 40 × 40, one thread")


def draw_threads(axes, rows):
    shown = part(rows, "threads")
    counts = [row["scale"] for row in shown]
    times = [shown[0]["microseconds"] / row["microseconds"] for row in shown]
    color, marker = STYLES[OURS]
    axes.plot(counts, counts, ":", color="grey", label="ideal")
    axes.plot(counts, times, marker + "-", color=color, label="measured")
    axes.set(xlabel="threads", ylabel="speed-up", xticks=counts, ylim=(0, 1.1 * max(counts)),
             title=f"Filter on 40 × 40, {shown[0]['points']:,.0f} points")
    axes.legend(loc="upper left", frameon=False)


def draw_vectors(axes, rows):
    shown = part(rows, "vectors")
    targets = list(dict.fromkeys(row["program"] for row in shown))
    width = 0.8 / len(targets)
    for k, target in enumerate(targets):
        times = [row["microseconds"] for query in MAIN_CLASSES
                 for row in shown if row["query"] == query and row["program"] == target]
        color, hatch = SHADES[k]
        axes.bar([place + (k - (len(targets) - 1) / 2) * width for place in range(len(times))],
                 times, width, color=color, hatch=hatch, edgecolor="white", label=target)
    axes.set(xticks=range(len(MAIN_CLASSES)), xlabel="points", ylabel=TIME,
             title="40 × 40 by vector instructions, in one call")
    axes.set_xticklabels(MAIN_CLASSES)
    axes.legend(frameon=False)


def draw_scaling(rows, path):
    """Time against pieces, distance, points, threads and vector instructions, as far as measured."""
    panels = [(name, draw) for name, draw in (
        ("pieces", draw_pieces), ("pieces", draw_build), ("net", draw_net), ("points", draw_points),
        ("threads", draw_threads), ("vectors", draw_vectors)) if part(rows, name)]
    columns = 2 if len(panels) == 4 else min(3, len(panels))
    lines = -(-len(panels) // columns)
    figure, grid = plt.subplots(lines, columns, figsize=(4.4 * columns, 3.8 * lines),
                                layout="constrained", squeeze=False)
    for axes, (_, draw) in zip(grid.flat, panels):
        draw(axes, rows)
    for axes in grid.flat[len(panels):]:
        axes.remove()
    finish(figure, grid.flat[:len(panels)], path)


def main():
    source = pathlib.Path(sys.argv[1])
    target = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else source)
    target.mkdir(parents=True, exist_ok=True)
    rows = read(source / "inversion.csv")
    draw_shapes(rows, target / "inversion-shapes.png")
    draw_accuracy(rows, target / "inversion-accuracy.png")
    if part(rows, "pieces"):
        draw_scaling(rows, target / "inversion-scaling.png")


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    main()
