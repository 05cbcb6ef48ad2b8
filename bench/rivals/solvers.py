"""What a solver of integer programs answers, and HiGHS inside SciPy, which also solves the linear relaxations.

Only the call of HiGHS itself is timed: neither what SciPy does before and after, nor building the model.  All
rivals get one thread and the relative gap 0, and else their defaults.
"""

import dataclasses
import importlib
import re
import resource
import time
import warnings

import numpy as np
import scipy
from scipy.optimize import Bounds, LinearConstraint, linprog, milp

INTEGRAL = 1e-6


@dataclasses.dataclass
class Answer:
    """How one call ended: optimal, limit, infeasible or failed; value and bound of the model; chosen: mask of columns.

    incumbents: pairs (second, value) of ever better solutions, the last with `value`.
    """

    status: str
    seconds: float
    value: float = np.inf
    bound: float = -np.inf
    chosen: np.ndarray = None
    incumbents: list = dataclasses.field(default_factory=list)


@dataclasses.dataclass
class Relaxation:
    """Linear relaxation: x, and the duals of the rows, all of a sign that makes the bound valid."""

    status: str
    seconds: float
    x: np.ndarray = None
    duals: np.ndarray = None

    def integral(self):
        return self.x is not None and np.abs(self.x - np.round(self.x)).max() <= INTEGRAL


@dataclasses.dataclass
class Spent:
    """Time of a call: the wall's or the processor's, whichever is less; waiting for the processor is not solving."""

    wall: float = 0.0
    cpu: float = 0.0

    @property
    def seconds(self):
        return min(self.wall, self.cpu)

    def scaled(self, incumbents):
        """Pairs (second by the wall, value) with seconds as they are counted."""
        share = self.seconds / max(1e-9, self.wall)
        return [(min(self.seconds, share * second), value) for second, value in incumbents]


def children_cpu_s():
    """Time of the processor that all ended children of this process took."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def timed(spent, function, *arguments, **named):
    """The function's result; its time is added to `spent`."""
    wall, cpu = time.perf_counter(), time.process_time()
    result = function(*arguments, **named)
    spent.wall += time.perf_counter() - wall
    spent.cpu += time.process_time() - cpu
    return result


def rounded(model, status, spent, x, bound, incumbents):
    """An answer from a vector of values (None: there is none) that may be off by the solver's tolerance."""
    incumbents = spent.scaled(incumbents)
    if x is None:
        return Answer(status, spent.seconds, bound=bound, incumbents=incumbents)
    chosen = x > 0.5
    value = float(model.costs[chosen].sum())
    last = incumbents[-1][1] if incumbents else np.inf
    if value < last - 1e-9 * max(1.0, abs(value)):
        incumbents.append((spent.seconds, value))
    return Answer(status, spent.seconds, value, bound if status != "optimal" else value, chosen, incumbents)


class _Stopwatch:
    """Times SciPy's calls of HiGHS, without what SciPy does before and after."""

    def __init__(self):
        self._spent = Spent()
        for name in ("scipy.optimize._milp", "scipy.optimize._linprog_highs"):
            module = importlib.import_module(name)
            module._highs_wrapper = self._watched(module._highs_wrapper)

    def _watched(self, function):
        return lambda *arguments, **named: timed(self._spent, function, *arguments, **named)

    def take(self):
        spent, self._spent = self._spent, Spent()
        return spent


_stopwatch = None


def _watch():
    global _stopwatch
    _stopwatch = _stopwatch or _Stopwatch()
    _stopwatch.take()
    return _stopwatch


def relax(model, limit_s):
    """The linear relaxation by HiGHS's dual simplex."""
    watch = _watch()
    must = model.lower > 0
    rows = model.matrix.tocsr()
    result = linprog(
        model.costs,
        A_ub=rows[~must] if (~must).any() else None,
        b_ub=np.ones((~must).sum()) if (~must).any() else None,
        A_eq=rows[must] if must.any() else None,
        b_eq=np.ones(must.sum()) if must.any() else None,
        bounds=(0, None),
        method="highs-ds",
        options={"time_limit": max(1e-3, limit_s)},
    )
    seconds = watch.take().seconds
    if result.status != 0:
        return Relaxation("limit" if result.status == 1 else "failed", seconds)
    duals = np.zeros(len(model.lower))
    if (~must).any():
        duals[~must] = np.minimum(0.0, result.ineqlin.marginals)
    if must.any():
        duals[must] = result.eqlin.marginals
    return Relaxation("optimal", seconds, result.x, duals)


def highs_incumbents(lines):
    """(second, value) from the log of HiGHS: the column BestSol where it gets better, times to a tenth of a second."""
    found = []
    for line in lines:
        words = re.sub(r"^ ?[A-Z]? ", "", line).split()
        if len(words) < 9 or not re.fullmatch(r"\d+(\.\d+)?s", words[-1]) or not words[3].endswith("%"):
            continue
        try:
            value = float(words[5])
        except ValueError:
            continue
        if np.isfinite(value) and (not found or value < found[-1][1]):
            found.append((float(words[-1][:-1]), value))
    return found


class Highs:
    """HiGHS inside SciPy."""

    name = "highs"

    def __init__(self, log):
        self._log = log

    @staticmethod
    def find():
        return f"SciPy {scipy.__version__}"

    def mip(self, model, limit_s):
        watch = _watch()
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            result = milp(
                model.costs,
                integrality=np.ones(len(model.costs)),
                bounds=Bounds(0, 1),
                constraints=LinearConstraint(model.matrix, np.where(model.lower > 0, 1, -np.inf), 1),
                options={"mip_rel_gap": 0.0, "time_limit": max(1e-3, limit_s), "disp": True, "threads": 1, "parallel": "off"},
            )
        spent = watch.take()
        status = {0: "optimal", 1: "limit", 2: "infeasible"}.get(result.status, "failed")
        bound = -np.inf if result.mip_dual_bound is None else float(result.mip_dual_bound)
        return rounded(model, status, spent, result.x, bound, highs_incumbents(self._log.take()))
