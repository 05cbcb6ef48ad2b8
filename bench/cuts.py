#!/usr/bin/python3
"""Cuts over three indices: rows of a linear program, or of the Lagrangian dual; writes docs/benchmarks/cuts.md.

    bench/cuts.py BUILD_DIR [--limit S] [--solve S] [--no-write] [PATTERN...]

Needs a Release build with -DNDA_BUILD_BENCHMARKS=ON.  Files are those of ../shared/data/arcs named below, if they are there, and tracking problems and groups that are
generated, up to some hundred thousand indices in one component; PATTERN selects files by a part of their name.  S of --solve goes into the packing to which the gap is
measured, S of --limit to each way to close it, both by the clock.
"""

import argparse
import pathlib
import subprocess
import sys
import tempfile

import shared

ARCS = shared.ROOT.parent / "shared/data/arcs"
SHARED = ["simulated/tracking-*", "simulated/poore51-f*", "real/ais60-w000-n6*", "real/ucy-hard*"]
TARGETS = [4000, 8000, 20000]  # of the preset `large`, at the density that it has with 2,000


def generated():
    """Names and what `nda generate` is asked for."""
    files = {"groups": ["tracking", "--preset", "largegroup"], "six-scan": ["six-scan"]}
    for targets in TARGETS:
        side = 5000 * (targets / 2000) ** 0.5
        files[f"tracking-{targets}"] = ["tracking", "--preset", "large", "--targets", str(targets), "--side", f"{side:.0f}", "--clutter", str(targets // 2)]
    return files


def table(build, limit, solve, patterns):
    def wanted(name):
        return not patterns or any(pattern in name for pattern in patterns)

    with tempfile.TemporaryDirectory() as folder:
        files = [path for pattern in SHARED for path in sorted(ARCS.glob(pattern + ".nda.gz")) if wanted(path.name)]
        for name, command in generated().items():
            if not wanted(name):
                continue
            files.append(pathlib.Path(folder) / f"{name}.nda.gz")
            subprocess.run([build / "nda", "generate", *command, "-o", files[-1]], check=True, stderr=subprocess.DEVNULL)
        command = [build / "bench/cut_rounds_benchmark", "--limit", str(limit), "--solve", str(solve), *files]
        return subprocess.run(command, check=True, capture_output=True, text=True).stdout.strip()


PAGE = """# Cuts as rows of the Lagrangian dual, measured

Written by `bench/cuts.py build/release --limit {limit:g} --solve {solve:g}`, on {processor}; [cuts and branching](../cuts.md) says what is compared. Of the largest component of each file, with
the arcs that multipliers and the best packing found in {solve:g} s leave, the *gap* is what lies between the bound of the relaxation and that packing, per cent of its cost.

- *Program*: seconds to the first bound of the exact linear program by column generation, without cuts, and the share of the gap that it closes.
- *Averages by then*: the share that rounds of the volume algorithm had closed at that time, with the cuts that their averages violate.
- *With cuts*: the end of the same linear program with cuts over three indices, and no others.
- *Averages*: the end of the rounds; evaluations of the dual function.
- *Program from there*: seconds to the end of the linear program with cuts when it begins with those of the rounds.

Seconds are those of the processor. `-`: no bound within {limit:g} s of the clock. Files whose largest component the best packing and the multipliers settle have 0 arcs.

{table}
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--limit", type=float, default=60)
    parser.add_argument("--solve", type=float, default=10)
    parser.add_argument("--no-write", action="store_true")
    parser.add_argument("patterns", nargs="*")
    arguments = parser.parse_args()
    rows = table(arguments.build, arguments.limit, arguments.solve, arguments.patterns)
    page = PAGE.format(table=rows, limit=arguments.limit, solve=arguments.solve, processor=shared.processor())
    print(page)
    if not arguments.no_write:
        (shared.ROOT / "docs/benchmarks/cuts.md").write_text(page, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
