# SPDX-License-Identifier: BSD-3-Clause
"""Puts what inversion_benchmark printed into Documentation/Benchmarks.md.

    fill_page.py <folder of inversion.md and the pictures> <Benchmarks.md>

Between the two marks of the page goes what was printed down to the means of each shape; the tables
of single classes stay in inversion.md. Pictures go into images/benchmarks beside the page.
"""

import pathlib
import shutil
import sys

BEGIN = "<!-- printed by inversion_benchmark: begin -->\n"
END = "<!-- printed by inversion_benchmark: end -->\n"
SINGLE_CLASSES = "\nµs a point:\n"  # the heading of the first table that does not go into the page


def main():
    source = pathlib.Path(sys.argv[1])
    page = pathlib.Path(sys.argv[2])
    printed = (source / "inversion.md").read_text(encoding="utf-8")
    text = page.read_text(encoding="utf-8")
    if SINGLE_CLASSES not in printed or "| aim |" not in printed:
        sys.exit(f"{source / 'inversion.md'} is not of a run of everything")
    if text.count(BEGIN) != 1 or text.count(END) != 1:
        sys.exit(f"{page} has lost the marks of what is printed")
    before, rest = text.split(BEGIN)
    after = rest.split(END)[1]
    shown = printed.split(SINGLE_CLASSES)[0].strip()
    page.write_text(f"{before}{BEGIN}\n{shown}\n\n{END}{after}", encoding="utf-8")
    pictures = page.parent / "images" / "benchmarks"
    pictures.mkdir(parents=True, exist_ok=True)
    for picture in sorted(source.glob("inversion-*.png")):
        shutil.copy(picture, pictures)
    print(f"filled {page}")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main()
