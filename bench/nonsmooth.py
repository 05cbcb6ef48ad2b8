#!/usr/bin/python3
"""Writes the tables of docs/nonsmooth.md between its markers.

    bench/nonsmooth.py

builds build/release/bench/nonsmooth_table_benchmark, runs it and puts its output in place.  Evaluations are counted, not seconds,
so the output is the same on every machine.
"""

import subprocess

from shared import ROOT, build, write_between

PAGE = ROOT / "docs/nonsmooth.md"
BEGIN, END = "<!-- tables: bench/nonsmooth.py -->\n", "<!-- end of tables -->"


def main():
    program = build("nonsmooth_table_benchmark") / "nonsmooth_table_benchmark"
    tables = subprocess.run([program], check=True, stdout=subprocess.PIPE, text=True).stdout
    write_between(PAGE, BEGIN, END, "\n" + tables + "\n")
    print(tables)


if __name__ == "__main__":
    main()
