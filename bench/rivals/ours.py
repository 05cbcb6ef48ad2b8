"""nda on one thread, by its own clock, its answer verified by `nda check`."""

import json
import math
import pathlib
import subprocess
import tempfile

import numpy as np

from rivals.setups import Outcome
from rivals.solvers import children_cpu_s


def version(nda):
    return subprocess.run([nda, "--version"], capture_output=True, text=True, check=True).stdout.strip()


def solve(nda, path, limit_s, warm=None):
    """(outcome, why it is wrong or ""): costs against time from a run of the program, with its log.

    A proof is timed once more, by the program `warm` if there is one (bench/warm_benchmark.cpp).
    """
    with tempfile.TemporaryDirectory() as name:
        output = pathlib.Path(name) / "solution.json"
        seconds, log = _run(nda, path, limit_s, output, "--log-interval", "0")
        solution = json.loads(output.read_text())
        if solution["proven"]:
            again = _warm(warm, path, limit_s) if warm else _run(nda, path, limit_s, output, "--quiet")[0]
            seconds = min(seconds, again)
        check = subprocess.run([nda, "check", path, output], capture_output=True, text=True, check=False)
    outcome = _outcome(solution, seconds, log)
    if check.returncode != 0:
        outcome.status = "wrong"
        return outcome, (check.stdout.splitlines() or ["nda check failed"])[-1]
    return outcome, ""


def _warm(warm, path, limit_s):
    """Seconds; infinitely many where there was no proof in time."""
    run = subprocess.run([warm, path, str(limit_s)], check=False, capture_output=True, text=True)
    return float(run.stdout) if run.returncode == 0 else math.inf


def _run(nda, path, limit_s, output, *options):
    """Seconds (of its clock or of the processor, reading included, whichever is less) and lines of the log."""
    command = [nda, "solve", path, "--threads", "1", "--time-limit", str(limit_s), "--output", output, *options]
    before = children_cpu_s()
    log = subprocess.run(command, check=False, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True).stderr
    cpu = children_cpu_s() - before
    return min(json.loads(output.read_text())["stats"]["solve_seconds"], cpu), log.splitlines()


def incumbents(log):
    """Pairs (second, cost) from the log of nda, where the cost gets better."""
    found = []
    for line in log:
        words = line.split()
        try:
            second, cost = float(words[0]), float(words[1])
        except (IndexError, ValueError):
            continue
        if np.isfinite(cost) and (not found or cost < found[-1][1]):
            found.append((second, cost))
    return found


def _outcome(solution, seconds, log):
    cost = solution["cost"] if solution["solutions"] else np.inf
    status = "optimal" if solution["proven"] else "limit" if solution["status"] == "time_limit" else "failed"
    if solution["status"] == "infeasible":
        status = "infeasible"
    return Outcome(status, seconds, float(cost), float(solution["lower_bound"]), incumbents(log))
