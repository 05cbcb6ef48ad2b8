"""HiGHS as a program on the PATH, newer as a rule than the one inside SciPy.

Counted is what it prints as its run time, or the time of the processor that its process took, whichever is less.
"""

import pathlib
import re
import shutil
import subprocess
import tempfile

import numpy as np

from rivals.solvers import Spent, children_cpu_s, highs_incumbents, rounded

HALF_A_HUNDREDTH = 0.005  # what a printed 0.00 may stand for


def write_mps(model, path):
    """Free MPS with columns x0, x1, ... and rows r0, r1, ..."""
    num_rows, num_columns = model.matrix.shape
    with path.open("w") as file:
        file.write("NAME rival FREE\nROWS\n N cost\n")
        file.writelines(f" {'E' if model.lower[row] > 0 else 'L'} r{row}\n" for row in range(num_rows))
        file.write("COLUMNS\n M1 'MARKER' 'INTORG'\n")
        starts, rows = model.matrix.indptr, model.matrix.indices
        for column in range(num_columns):
            file.write(f" x{column} cost {model.costs[column]!r}\n")
            file.writelines(f" x{column} r{row} 1\n" for row in rows[starts[column] : starts[column + 1]])
        file.write(" M2 'MARKER' 'INTEND'\nRHS\n")
        file.writelines(f" b r{row} 1\n" for row in range(num_rows))
        file.write("BOUNDS\n")
        file.writelines(f" UP b x{column} 1\n" for column in range(num_columns))
        file.write("ENDATA\n")


def read_solution(lines, num_columns):
    """Status and values (None: there are none) of a solution file of HiGHS."""
    status, x = "failed", None
    words = {"Optimal": "optimal", "Time limit reached": "limit", "Infeasible": "infeasible"}
    for number, line in enumerate(lines):
        if line == "Model status":
            status = words.get(lines[number + 1], "failed")
        if line == "# Primal solution values" and lines[number + 1] == "Feasible":
            begin = next(k for k in range(number, len(lines)) if lines[k].startswith("# Columns")) + 1
            pairs = [line.split() for line in lines[begin : begin + num_columns]]
            x = np.zeros(num_columns)
            for name, value in pairs:
                x[int(name[1:])] = float(value)
            break
    return status, x


def last_number(lines, label):
    """The number that follows the label in the last line that has it; None where there is none."""
    found = [match for match in (re.search(rf"{label}\s*:?\s+(-?[\d.]+(e[-+]?\d+)?)", line) for line in lines) if match]
    return float(found[-1][1]) if found else None


class HighsProgram:
    """The program `highs`."""

    name = "highs-program"

    def __init__(self, log):
        del log

    @staticmethod
    def find():
        path = shutil.which("highs")
        if not path:
            return None
        printed = subprocess.run([path, "--version"], capture_output=True, text=True, check=False).stdout
        return (printed.splitlines() or ["HiGHS"])[0]

    def mip(self, model, limit_s):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            write_mps(model, folder / "model.mps")
            (folder / "options").write_text("mip_rel_gap = 0\nthreads = 1\nparallel = off\n")
            command = ["highs", "--options_file", "options", "--time_limit", str(max(0.01, limit_s))]
            before = children_cpu_s()
            output = subprocess.run(
                [*command, "--solution_file", "solution", "model.mps"], cwd=folder, capture_output=True, text=True, check=False
            ).stdout.splitlines()
            cpu = children_cpu_s() - before
            solution = folder / "solution"
            lines = solution.read_text().splitlines() if solution.exists() else []
        printed = last_number(output, "HiGHS run time")
        spent = Spent(cpu if printed is None else max(printed, HALF_A_HUNDREDTH), cpu)
        status, x = read_solution(lines, len(model.costs))
        bound = last_number(output, "Dual bound")
        return rounded(model, status, spent, x, -np.inf if bound is None else bound, highs_incumbents(output))
