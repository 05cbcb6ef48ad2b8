#!/usr/bin/python3
"""Writes the tables of docs/benchmarks/roofline.md between its markers.

    bench/roofline.py

builds build/release/bench/roofline_benchmark, runs it on one core for a minute or two and puts its output in place.
Times are those of the machine it runs on.
"""

import os
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs/benchmarks/roofline.md"
BEGIN, END = "<!-- tables: bench/roofline.py -->\n", "<!-- end of tables -->"


def model():
    """Name of the processor."""
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return "unknown processor"


def main():
    subprocess.run(["cmake", "--preset", "release", "-DNDA_BUILD_BENCHMARKS=ON"], cwd=ROOT, check=True)
    subprocess.run(["cmake", "--build", ROOT / "build/release", "--target", "roofline_benchmark"], check=True)
    os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})
    program = ROOT / "build/release/bench/roofline_benchmark"
    tables = subprocess.run([program], check=True, stdout=subprocess.PIPE, text=True).stdout
    head, rest = PAGE.read_text().split(BEGIN)
    PAGE.write_text(head + BEGIN + f"\n{model()}.  " + tables + "\n" + END + rest.split(END)[1])
    print(tables)


if __name__ == "__main__":
    main()
