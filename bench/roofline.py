#!/usr/bin/python3
"""Writes the tables of docs/benchmarks/roofline.md between its markers.

    bench/roofline.py

builds build/release/bench/roofline_benchmark, runs it on one core for a minute or two and puts its output in place.
Times are those of the machine it runs on.
"""

import os
import subprocess

from shared import ROOT, build, processor, write_between

PAGE = ROOT / "docs/benchmarks/roofline.md"
BEGIN, END = "<!-- tables: bench/roofline.py -->\n", "<!-- end of tables -->"


def main():
    program = build("roofline_benchmark") / "roofline_benchmark"
    os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})
    tables = subprocess.run([program], check=True, stdout=subprocess.PIPE, text=True).stdout
    write_between(PAGE, BEGIN, END, f"\n{processor()}.  " + tables + "\n")
    print(tables)


if __name__ == "__main__":
    main()
