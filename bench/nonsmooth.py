#!/usr/bin/python3
"""Writes the tables of docs/nonsmooth.md between its markers.

    bench/nonsmooth.py

builds build/release/bench/nonsmooth_table_benchmark, runs it and puts its output in place.  Evaluations are counted, not seconds,
so the output is the same on every machine.
"""

import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs/nonsmooth.md"
BEGIN, END = "<!-- tables: bench/nonsmooth.py -->\n", "<!-- end of tables -->"


def main():
    subprocess.run(["cmake", "--preset", "release", "-DNDA_BUILD_BENCHMARKS=ON"], cwd=ROOT, check=True)
    subprocess.run(["cmake", "--build", ROOT / "build/release", "--target", "nonsmooth_table_benchmark"], check=True)
    program = ROOT / "build/release/bench/nonsmooth_table_benchmark"
    tables = subprocess.run([program], check=True, stdout=subprocess.PIPE, text=True).stdout
    head, rest = PAGE.read_text().split(BEGIN)
    PAGE.write_text(head + BEGIN + "\n" + tables + "\n" + END + rest.split(END)[1])
    print(tables)


if __name__ == "__main__":
    main()
