# SPDX-License-Identifier: BSD-3-Clause
"""Puts what inversion_benchmark printed into Documentation/Benchmarks.md.

    fill_page.py <folder of inversion.md and the pictures> <Benchmarks.md>

Between the two marks of the page goes what was printed down to the means of each shape; the tables
of single classes stay in inversion.md. Pictures go into images/benchmarks beside the page. With
cad.md as the first argument only the table of CAD models is filled in, between its own marks.
"""

import pathlib
import shutil
import sys

BEGIN = "<!-- printed by inversion_benchmark: begin -->\n"
END = "<!-- printed by inversion_benchmark: end -->\n"
CAD_BEGIN = "<!-- printed by cad_benchmark: begin -->\n"
CAD_END = "<!-- printed by cad_benchmark: end -->\n"
SINGLE_CLASSES = "\nµs a point:\n"  # the heading of the first table that does not go into the page


def replaced(text, begin, end, shown, page):
    """The text with what stands between two marks replaced."""
    if text.count(begin) != 1 or text.count(end) != 1:
        sys.exit(f"{page} has lost the marks of what is printed")
    before, rest = text.split(begin)
    return f"{before}{begin}\n{shown.strip()}\n\n{end}{rest.split(end)[1]}"


def main():
    source = pathlib.Path(sys.argv[1])
    page = pathlib.Path(sys.argv[2])
    if source.name == "cad.md":
        printed = source.read_text(encoding="utf-8")
        if "Footpoint" not in printed:
            sys.exit(f"{source} is not of a run of everything")
        text = page.read_text(encoding="utf-8")
        page.write_text(replaced(text, CAD_BEGIN, CAD_END, printed, page), encoding="utf-8")
        print(f"filled {page}")
        return
    printed = (source / "inversion.md").read_text(encoding="utf-8")
    text = page.read_text(encoding="utf-8")
    if SINGLE_CLASSES not in printed or "| aim |" not in printed:
        sys.exit(f"{source / 'inversion.md'} is not of a run of everything")
    shown = printed.split(SINGLE_CLASSES)[0].strip()
    page.write_text(replaced(text, BEGIN, END, shown, page), encoding="utf-8")
    pictures = page.parent / "images" / "benchmarks"
    pictures.mkdir(parents=True, exist_ok=True)
    for picture in sorted(source.glob("inversion-*.png")):
        shutil.copy(picture, pictures)
    print(f"filled {page}")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main()
