"""bench/rivals.py: its set-ups are exact, its costs and logs are read rightly, its ratios and contradictions are what they say."""

import itertools
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
NDA = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "build/release/nda"
NOT_INSTALLED = 77
sys.path.insert(0, str(ROOT / "bench"))

try:
    import numpy as np
    import scipy.optimize  # noqa: F401
except ImportError:
    print("SciPy is not installed")
    sys.exit(NOT_INSTALLED)

from rivals import child, figures, libraries, ours, page, problem, program, setups, solvers, store  # noqa: E402

RIVALS = [rival for rival in (solvers.Highs, libraries.Cbc, libraries.Glpk) if rival.find()]


class Folder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def read(self, text):
        path = self.folder / "problem.nda"
        path.write_text(text)
        return problem.read_problem(path)


class Reading(Folder):
    def test_refuses_bounds_on_uses(self):
        self.assertEqual(self.read("p nda 2 1 1 1\nb 1 1 1 1\na 1 1 -3\n").num_arcs, 1)
        with self.assertRaisesRegex(ValueError, "bounds on uses"):
            self.read("p nda 2 1 1 1\nb 1 1 1 2\na 1 1 -3\n")


class Problems(Folder):
    TWO_PARTS = "c parts\np nda 2 3 3 6\na 1 1 -5\na 1 2 -4\na 2 1 -4\na 3 3 2\na 3 0 5\na 0 3 1\n"

    def test_reads_arcs_and_singletons(self):
        read = self.read(self.TWO_PARTS)
        self.assertEqual((read.num_arcs, read.num_rows), (4, 6))
        self.assertEqual(list(read.singletons), [0, 0, 5, 0, 0, 1])
        self.assertEqual(list(read.shifted_costs()), [-5, -4, -4, -4])

    def test_takes_the_cheapest_of_equal_tuples(self):
        read = self.read("p nda 2 1 1 5\na 1 0 -3\na 1 0 -2\na 0 1 inf\na 0 1 4\na 1 1 9\n")
        self.assertEqual(list(read.singletons), [-3, 4])

    def test_splits_what_shares_no_index(self):
        self.assertEqual([list(part.arcs) for part in self.read(self.TWO_PARTS).parts()], [[3], [0, 1, 2]])

    def test_drops_what_cannot_save_anything(self):
        read = self.read("p nda 2 2 2 3\na 1 1 -1\na 2 2 0\na 1 2 3\n")
        self.assertEqual(list(read.kept()), [0])

    def test_keeps_what_covers_an_index_that_must_be(self):
        read = self.read("p nda 2 1 1 2\na 1 1 3\na 1 0 inf\n")
        self.assertEqual(list(read.kept()), [0])
        self.assertEqual(list(read.parts()[0].lower), [1, 0])

    def test_computes_costs_and_finds_what_is_no_solution(self):
        read = self.read(self.TWO_PARTS)
        self.assertEqual(read.cost_of([1, 2]), -2)
        self.assertEqual(read.cost_of([1, 2, 3]), -6)
        self.assertEqual(read.cost_of([]), 6)
        self.assertIsNone(read.cost_of([0, 1]))
        self.assertIsNone(self.read("p nda 2 1 1 2\na 1 1 3\na 1 0 inf\n").cost_of([]))


def enumerated(read):
    """The least cost, by trying all sets of arcs."""
    arcs = range(read.num_arcs)
    costs = (read.cost_of(list(chosen)) for size in range(5) for chosen in itertools.combinations(arcs, size))
    return min((cost for cost in costs if cost is not None), default=math.inf)


def random_problem(generator):
    """Three dimensions of three indices; some singletons cost something, some are forbidden."""
    tuples = np.unique(generator.integers(0, 4, (12, 3)), axis=0)
    tuples = tuples[(tuples > 0).sum(axis=1) > 1]
    singletons = generator.choice([0.0, 2.0, math.inf], 9, p=[0.6, 0.3, 0.1])
    return problem.Problem(np.array([3, 3, 3]), tuples, generator.normal(-1, 3, len(tuples)), singletons)


class Log:
    def take(self):
        return []


class Setups(unittest.TestCase):
    def check_exact(self, rival):
        generator = np.random.default_rng(7)

        def task(log):
            solver, found = rival(log), []
            for read in (random_problem(generator) for _ in range(15)):
                best = enumerated(read)
                found += [(name, best, run(read, solver, 10.0)) for name, run in setups.RUN.items() if math.isfinite(best)]
            return found

        found, why = child.run(task, 60)
        self.assertEqual(why, "")
        self.assertGreater(len(found), 20)
        for name, best, outcome in found:
            self.assertEqual(outcome.status, "optimal", name)
            self.assertAlmostEqual(outcome.cost, best, places=6, msg=name)

    def test_finds_the_optimum_that_enumeration_finds(self):
        for rival in RIVALS:
            with self.subTest(rival.name):
                self.check_exact(rival)

    def test_core_grows_until_it_holds_the_optimum(self):
        setups.FIRST_CORE_COLUMNS, setups.CORE_COLUMNS_PER_ROW = 1, 0
        try:
            self.check_exact(solvers.Highs)
        finally:
            setups.FIRST_CORE_COLUMNS, setups.CORE_COLUMNS_PER_ROW = 100, 3

    def test_says_so_where_an_answer_is_no_solution(self):
        class Liar:
            def mip(self, model, limit_s):
                return solvers.Answer("optimal", 0.1, -9.0, -9.0, np.ones(len(model.costs), dtype=bool))

        read = problem.Problem(np.array([1, 2]), np.array([[1, 1], [1, 2]]), np.array([-4.0, -5.0]), np.zeros(3))
        self.assertEqual(setups.whole(read, Liar(), 1.0).status, "wrong")


class Children(unittest.TestCase):
    def test_kills_what_runs_too_long(self):
        self.assertEqual(child.run(lambda log: time.sleep(30), 0.2), (None, "killed"))

    def test_tells_why_there_is_no_result(self):
        self.assertEqual(child.run(lambda log: 1 // 0, 10)[1], "ZeroDivisionError: integer division or modulo by zero")
        self.assertEqual(child.run(lambda log: os._exit(1), 10), (None, "died"))


class Logs(unittest.TestCase):
    def test_reads_the_log_of_highs(self):
        log = """
     Proc. InQueue |  Leaves   Expl. | BestBound       BestSol              Gap |   Cuts   InLp Confl. | LpIters     Time
         0       0         0   0.00%   -825.2521       inf                  inf        0      0      0         0     0.2s
 S       0       0         0   0.00%   -825.2521       -250.656         229.24%        0      0      0         0     0.3s
 R      12       3         4  10.00%   -313.663625     -250.8154         25.06%        0      0      0       178    12.5s
         0       0         0   0.00%   -312.088025     -250.8154         21.63%       70      4      0       188    12.9s
"""
        self.assertEqual(solvers.highs_incumbents(log.splitlines()), [(0.3, -250.656), (12.5, -250.8154)])

    def test_reads_the_log_of_cbc(self):
        log = """Cbc0038I Solution found of -250.656
Cbc0038I Mini branch and bound improved solution from -250.656 to -300.401 (0.33 seconds)
Cbc0012I Integer solution of -308.0046 found by feasibility pump after 0 iterations and 0 nodes (0.56 seconds)
Cbc0010I After 0 nodes, 1 on tree, 1e+50 best solution, best possible -450 (0.60 seconds)
Cbc0004I Integer solution of -309.5 found after 12 iterations and 3 nodes (1.25 seconds)
"""
        self.assertEqual(libraries.cbc_incumbents(log.splitlines()), [(0.33, -300.401), (0.56, -308.0046), (1.25, -309.5)])

    def test_reads_the_log_of_nda(self):
        log = """   time (s)               cost        lower bound      gap %    done  event
      0.001                inf         -12.500000        inf       0  relaxation
      0.010          -7.000000         -12.500000    78.5714       0  greedy
      0.020          -7.000000         -10.000000    42.8571       0  relaxation
      0.030          -8.000000          -8.000000     0.0000       1  branch and cut
"""
        self.assertEqual(ours.incumbents(log.splitlines()), [(0.01, -7.0), (0.03, -8.0)])

    def test_scales_the_times_of_a_log_to_the_time_that_counts(self):
        self.assertEqual(solvers.Spent(wall=4.0, cpu=1.0).scaled([(2.0, -7.0), (9.0, -8.0)]), [(0.5, -7.0), (1.0, -8.0)])


class HighsProgram(Folder):
    SCRIPT = """#!/bin/sh
echo 'HiGHS run time      :          0.00'
echo '  Dual bound        -8.5'
grep -q '^ x1 cost -5.0$' model.mps && grep -q '^ x1 r2 1$' model.mps || exit 1
cat > solution <<END
Model status
Time limit reached

# Primal solution values
Feasible
Objective -5
# Columns 2
x0 0
x1 1
# Rows 3
END
"""

    def test_believes_the_solution_file(self):
        script = self.folder / "highs"
        script.write_text(self.SCRIPT)
        script.chmod(0o755)
        before = os.environ["PATH"]
        os.environ["PATH"] = f"{self.folder}:{before}"
        self.addCleanup(os.environ.__setitem__, "PATH", before)
        read = problem.Problem(np.array([1, 2]), np.array([[1, 1], [1, 2]]), np.array([-4.0, -5.0]), np.zeros(3))
        outcome = setups.whole(read, program.HighsProgram(Log()), 1.0)
        self.assertEqual((outcome.status, outcome.cost, outcome.bound), ("limit", -5, -8.5))
        self.assertLessEqual(outcome.seconds, program.HALF_A_HUNDREDTH)


def row(solver="highs", setup="whole", status="optimal", seconds=1.0, cost=-10.0, **other):
    values = {"instance": "a", "family": "f", "arcs": 9000, "kept": 9, "components": 1, "solver": solver, "setup": setup, "run": 0,
              "limit_s": 20.0, "status": status, "seconds": seconds, "cost": cost, "bound": cost, "incumbents": (),
              "best_known": math.nan, "program": "p", "machine": "m", "note": ""}  # fmt: skip
    return store.Row(**{**values, **other})


def results(*rows):
    return figures.Results(rows)


NDA_ROW = {"solver": "nda", "setup": "default"}


class Figures(unittest.TestCase):
    def test_takes_medians_and_the_best_rival(self):
        found = results(
            row(**NDA_ROW, seconds=0.5), row(seconds=3.0), row(seconds=1.0, run=1), row(seconds=2.0, run=2), row("cbc", seconds=1.5)
        )
        self.assertEqual(str(found.time("a", ("highs", "whole"))), "2")
        self.assertEqual([str(item) for item in found.ratios(["a"], ("highs", "whole"))], ["4"])
        self.assertEqual([str(item) for item in found.ratios(["a"], None)], ["3"])
        self.assertEqual(found.losses(["a"]), [])

    def test_marks_bounds(self):
        vain = {"status": "limit", "seconds": 20.0, "bound": -11.0}
        self.assertEqual(str(results(row(**NDA_ROW), row(**vain)).ratios(["a"], None)[0]), ">20")
        slower = results(row(**NDA_ROW, **vain), row())
        self.assertEqual(str(slower.ratios(["a"], None)[0]), "<0.05")
        self.assertEqual([name for name, _ in slower.losses(["a"])], ["a"])
        self.assertEqual(results(row(**NDA_ROW, **vain), row(**vain)).ratios(["a"], None), [])

    def test_forgets_shorter_limits_that_did_not_suffice(self):
        found = results(row(status="limit", seconds=20.0, bound=-11.0), row(seconds=31.0, limit_s=60.0))
        self.assertEqual(str(found.time("a", ("highs", "whole"))), "31")

    def test_counts_most_runs_not_one(self):
        vain = row(status="limit", seconds=20.0, bound=-11.0)
        self.assertEqual(str(results(row(), vain, vain).time("a", ("highs", "whole"))), ">20")

    def test_averages_ratios(self):
        mean = figures.geometric_mean([figures.Ratio(4.0, ">"), figures.Ratio(1.0, "")])
        self.assertEqual(str(mean), ">2")
        self.assertEqual(str(figures.geometric_mean([figures.Ratio(4.0, ">"), figures.Ratio(1.0, "<")])), "~2")
        self.assertIsNone(figures.geometric_mean([]))

    def test_finds_the_time_to_good_solutions(self):
        found = results(row(incumbents=((0.1, -9.0), (0.2, -9.95), (0.7, -10.0)), seconds=0.9))
        self.assertEqual([found.target_time("a", ("highs", "whole"), share).seconds for share in (0.2, 0.01, 0.0001)], [0.1, 0.2, 0.7])
        told_nothing = results(row("glpk", seconds=0.9))
        self.assertEqual(told_nothing.target_time("a", ("glpk", "whole"), 0.01).seconds, 0.9)

    def test_names_contradictions(self):
        self.assertEqual(results(row(), row(**NDA_ROW)).contradictions, [])
        for wrong in (
            row(**NDA_ROW, cost=-9.0),
            row(**NDA_ROW, status="limit", cost=-9.0, bound=-9.5),
            row(**NDA_ROW, status="wrong"),
            row(**NDA_ROW, status="infeasible", cost=math.inf, bound=-math.inf),
        ):
            found = results(row(), wrong).contradictions
            self.assertEqual(len(found), 1, found)
            self.assertTrue(found[0].startswith("a: nda default"), found)
        self.assertEqual(len(results(row(best_known=-11.0)).contradictions), 1)


class Stores(Folder):
    def test_reads_what_it_wrote(self):
        kept = store.Store(self.folder / "rows.csv")
        kept.add(row(incumbents=((0.5, -9.0), (1.0, -10.0)), note="a, b"))
        kept.add(row(**NDA_ROW, cost=math.inf, bound=-math.inf, status="killed"))
        again = store.Store(self.folder / "rows.csv")
        self.assertEqual([store.to_text(item) for item in again.rows], [store.to_text(item) for item in kept.rows])

    def test_knows_what_is_missing(self):
        kept = store.Store(self.folder / "rows.csv")
        key = ("a", "highs", "whole")
        self.assertEqual(list(kept.missing_runs(key, 20, 3)), [0, 1, 2])
        kept.add(row())
        self.assertEqual(list(kept.missing_runs(key, 20, 3)), [1, 2])
        kept.add(row(status="limit", bound=-11.0, run=1))
        self.assertEqual(list(kept.missing_runs(key, 20, 3)), [])
        self.assertEqual(list(kept.missing_runs(key, 60, 3)), [1, 2])
        kept.forget(lambda item: item.status == "limit")
        self.assertEqual(len(store.Store(self.folder / "rows.csv").rows), 1)

    def test_keeps_what_is_near_the_end(self):
        self.assertEqual(store.relevant([(1, -5.0), (2, -9.9), (3, -9.9), (4, -10.0)], -10.0), ((2, -9.9), (4, -10.0)))


class EndToEnd(Folder):
    def run_bench(self, *options):
        command = [ROOT / "bench/rivals.py", "--quick", "--nda", NDA, "--csv", self.folder / "rows.csv", *options, "gadgets"]
        return subprocess.run(command, capture_output=True, text=True, check=False)

    def test_measures_goes_on_and_makes_the_page(self):
        first = self.run_bench("--rivals", "highs")
        self.assertEqual(first.returncode, 0, first.stderr)
        self.assertEqual(len(first.stderr.splitlines()), 4)
        self.assertIn("| gadgets-30 | 287 |", first.stdout)
        self.assertEqual(self.run_bench("--rivals", "highs").stderr, "")
        self.assertEqual(len(self.run_bench("--rivals", "highs", "--again", "nda").stderr.splitlines()), 1)

    def test_fails_where_answers_contradict_each_other(self):
        self.run_bench("--rivals", "highs", "--setups", "parts")
        kept = store.Store(self.folder / "rows.csv")
        kept.add(row(instance="gadgets-30", cost=-1.0))
        failed = self.run_bench("--tables")
        self.assertEqual(failed.returncode, 1)
        self.assertIn("claims the optimum -1, but -4848 is known", failed.stderr)

    def test_replaces_the_tables_of_the_page_only(self):
        path = self.folder / "page.md"
        path.write_text(f"before\n{page.BEGIN}old\n{page.END}\nafter\n")
        page.write(path, "new")
        self.assertEqual(path.read_text(), f"before\n{page.BEGIN}\nnew\n\n{page.END}\nafter\n")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
