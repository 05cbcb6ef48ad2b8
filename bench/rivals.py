#!/usr/bin/python3
"""nda against CBC, GLPK and HiGHS: time to a proof and to good solutions, on every family.

    bench/rivals.py [--quick] [--csv FILE] [--time-limit S] [--repeat N] [--rivals NAME,...] [--setups NAME,...]
                    [--again SOLVER] [--nda FILE] [--warm FILE] [--core N] [--page FILE] [--tables] [PATTERN...]

runs each solver on each problem on one thread and writes a row per run into the CSV file; what stands there is not
run again, so it can be stopped at any time and go on.  `--again nda` measures nda alone once more, with a newer binary;
`--tables` runs nothing.  Tables, as docs/benchmarks.md has them, go to standard output, or with --page into that file, and the
pictures into docs/images.  What is counted is described in docs/benchmarks.md.  Exit code 1 where two answers contradict each
other or one is no solution.

    bench/rivals.py --quick                                        # small problems, about a minute
    bench/rivals.py --csv docs/benchmarks/rivals.csv --page docs/benchmarks.md     # all; hours
    bench/rivals.py --csv docs/benchmarks/rivals.csv --page docs/benchmarks.md --again nda

Needs Debian's python3-scipy and python3-matplotlib; coinor-cbc and glpk-utils, and a program `highs` on
the PATH, are used where they are there.
"""

import argparse
import functools
import hashlib
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time


def use_python_with_scipy():
    """Starts again under a python3 that has SciPy, if this one has not."""
    try:
        import scipy.optimize  # noqa: F401
        return
    except ImportError:
        pass
    for folder in ["/usr/bin", *os.environ.get("PATH", "").split(os.pathsep)]:
        python = shutil.which("python3", path=folder)
        if python and subprocess.run([python, "-c", "import scipy.optimize"], capture_output=True, check=False).returncode == 0:
            os.execv(python, [python, *sys.argv])
    sys.exit("no python3 with SciPy: install python3-scipy")


for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
    os.environ[variable] = "1"
use_python_with_scipy()

from instances import references  # noqa: E402
from rivals import child, families, figures, libraries, ours, page, problem, program, setups, solvers, store  # noqa: E402
from shared import build, processor  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent
DEFAULT_NDA = ROOT / "build/release/nda"
LOOP_S = 0.1
LARGEST_STRETCH = 5.0
RIVALS = {rival.name: rival for rival in (solvers.Highs, libraries.Cbc, program.HighsProgram, libraries.Glpk)}


def kill_after_s(limit_s):
    """A rival that runs so long does not heed its limit; building models is not in its time."""
    return 2 * limit_s + 20


def stretched(limit_s):
    """The limit by the wall's clock that gives a solver about limit_s of the processor, judged by a short loop."""
    wall, cpu = time.perf_counter(), time.process_time()
    while time.process_time() - cpu < LOOP_S:
        pass
    return limit_s * min(LARGEST_STRETCH, max(1.0, (time.perf_counter() - wall) / LOOP_S))


class Bench:
    """What all runs share."""

    def __init__(self, arguments):
        self.arguments = arguments
        self.store = store.Store(arguments.csv)
        self.machine = processor()
        self.found = {name: RIVALS[name].find() for name in arguments.rivals if RIVALS[name].find()}
        self._cached = (None, None)

    @functools.cached_property
    def ours(self):
        """Version of nda and the beginning of its binary's hash."""
        digest = hashlib.sha256(self.arguments.nda.read_bytes()).hexdigest()[:8]
        return f"{ours.version(self.arguments.nda)} ({digest})"

    def loaded(self, instance):
        """The problem and how many components it has; the last one is kept."""
        if self._cached[0] != instance.name:
            loaded = problem.read_problem(instance.path)
            self._cached = instance.name, (loaded, len(loaded.kept()), len(loaded.parts()))
        return self._cached[1]

    def run_ours(self, instance):
        return ours.solve(self.arguments.nda, instance.path, stretched(self.arguments.time_limit), self.arguments.warm)

    def run_rival(self, instance, solver, setup):
        loaded, limit_s = self.loaded(instance)[0], stretched(self.arguments.time_limit)

        def task(log):
            rival = RIVALS[solver](log)
            setups.warm_up(rival)
            return setups.RUN[setup](loaded, rival, limit_s)

        outcome, why = child.run(task, kill_after_s(limit_s))
        if outcome:
            return outcome, ""
        return setups.Outcome("killed" if why == "killed" else "failed", self.arguments.time_limit if why == "killed" else 0.0), why

    def measure(self, instance, solver, setup):
        """All runs that are missing of one solver on one problem."""
        limit_s = self.arguments.time_limit
        for run in self.store.missing_runs((instance.name, solver, setup), limit_s, self.arguments.repeat):
            outcome, note = self.run_ours(instance) if solver == "nda" else self.run_rival(instance, solver, setup)
            _, kept, components = self.loaded(instance)
            row = store.Row(
                instance.name, instance.family, instance.arcs, kept, components, solver, setup, run, limit_s, outcome.status,
                outcome.seconds, outcome.cost, outcome.bound, store.relevant(outcome.incumbents, outcome.cost),
                float("nan") if instance.best_known is None else instance.best_known,
                self.ours if solver == "nda" else self.found[solver], self.machine, note,
            )  # fmt: skip
            self.store.add(row)
            print(
                f"{instance.name:32} {instance.arcs:9} {solver:14} {setup:8} {row.status:10} {row.seconds:10.4f} {row.cost:16.6f}  {note}",
                file=sys.stderr,
                flush=True,
            )
            if not row.proven:
                return

    def run_all(self, instances):
        """GLPK, which seldom ends in time, comes last."""
        late = [name for name in self.found if name == "glpk"]
        early = [name for name in self.found if name != "glpk"]
        for instance in instances:
            self.measure(instance, "nda", "default")
            for solver in early:
                for setup in self.arguments.setups:
                    self.measure(instance, solver, setup)
        for instance in instances:
            for solver in late:
                for setup in self.arguments.setups:
                    self.measure(instance, solver, setup)

    def forget(self, instances):
        names = {instance.name for instance in instances}
        again = self.arguments.again
        self.store.forget(lambda row: row.solver in again and row.instance in names)


def parse_arguments():
    def names(text):
        return [name for name in text.split(",") if name]

    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true", help="six small problems, 5 s each, once")
    parser.add_argument("--csv", type=pathlib.Path, help="rows of all runs; without, nothing is kept")
    parser.add_argument("--time-limit", type=float, default=60.0)
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--rivals", type=names, default=list(RIVALS))
    parser.add_argument("--setups", type=names, default=list(setups.RUN))
    parser.add_argument("--again", type=names, default=[], metavar="SOLVER")
    parser.add_argument("--nda", type=pathlib.Path, default=DEFAULT_NDA)
    parser.add_argument("--warm", type=pathlib.Path, help="of the same nda, times its proofs; built for the nda of build/release")
    parser.add_argument("--core", type=int, help="stay on this core")
    parser.add_argument("--page", type=pathlib.Path, help="write the tables between the markers of this file")
    parser.add_argument("--tables", action="store_true", help="run nothing, make the tables of the CSV file")
    parser.add_argument("pattern", nargs="*")
    arguments = parser.parse_args()
    if arguments.again:
        arguments.rivals = [name for name in arguments.rivals if name in arguments.again]
    if arguments.quick:
        arguments.time_limit, arguments.repeat = min(5.0, arguments.time_limit), 1
    for given, known in ((arguments.rivals, RIVALS), (arguments.setups, setups.RUN), (arguments.again, {"nda", *RIVALS})):
        unknown = set(given) - set(known)
        if unknown:
            parser.error(f"unknown: {', '.join(sorted(unknown))}; there are {', '.join(known)}")
    return arguments


def main():
    arguments = parse_arguments()
    if arguments.core is not None:
        os.sched_setaffinity(0, {arguments.core})
    if not arguments.tables and not arguments.warm and arguments.nda == DEFAULT_NDA:
        arguments.warm = build("nda_cli", "warm_benchmark") / "warm_benchmark"
    bench = Bench(arguments)
    if not arguments.tables:
        with tempfile.TemporaryDirectory() as name:
            known = references() if families.ARCS.exists() else {}
            found = families.instances(arguments.nda, pathlib.Path(name), arguments.quick, arguments.pattern, known)
            bench.forget(found)
            bench.run_all(found)
    results = figures.Results(bench.store.rows)
    tables = page.tables(results)
    if arguments.page:
        page.write(arguments.page, tables)
        from rivals import pictures  # needs matplotlib, the rest does not

        pictures.draw(results, ROOT / "docs/images")
    else:
        print(tables)
    for line in results.contradictions:
        print(line, file=sys.stderr)
    return 1 if results.contradictions else 0


if __name__ == "__main__":
    sys.exit(main())
