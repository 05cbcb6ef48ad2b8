"""Three ways to set a rival on a problem; each is exact, and each counts the time of its solver alone.

whole: the costs less what singletons cost, arcs left out that cannot save anything: a set packing problem.  Rivals solve it
faster than the set partitioning problem of all arcs and singletons.
parts: what shares no index is solved apart; of each part the linear relaxation first, the integer program only where
its solution is not integral.
core:  the clever user's way.  As before, but the integer program first gets the columns of small reduced cost only; its
solution v leaves as candidates those whose reduced cost does not exceed v - (bound of the relaxation), and if there are
columns among them that it had not, it is solved again with these.
"""

import dataclasses

import numpy as np

from scipy.sparse import csc_matrix

from rivals.problem import Model
from rivals.solvers import Answer, relax

FIRST_CORE_COLUMNS = 100
CORE_COLUMNS_PER_ROW = 3  # of the first core, besides


@dataclasses.dataclass
class Outcome:
    """How a problem ended: status and seconds; cost recomputed from the arcs; bound; (second, cost) pairs."""

    status: str
    seconds: float
    cost: float = np.inf
    bound: float = -np.inf
    incumbents: list = dataclasses.field(default_factory=list)


def whole(problem, solver, limit_s):
    model = problem.whole()
    answer = solver.mip(model, limit_s)
    answer.bound += problem.constant
    answer.incumbents = [(second, value + problem.constant) for second, value in answer.incumbents]
    if answer.chosen is None:
        return Outcome(answer.status, answer.seconds, bound=answer.bound)
    return _verified(problem, answer, model.arcs[answer.chosen])


def parts(problem, solver, limit_s):
    return _decomposed(problem, solver, limit_s, lambda model, relaxation, limit: solver.mip(model, limit))


def core(problem, solver, limit_s):
    def solve(model, relaxation, limit):
        return solve_core(model, relaxation, solver, limit)

    return _decomposed(problem, solver, limit_s, solve)


def _verified(problem, answer, arcs):
    """The outcome, "wrong" where the arcs are no solution."""
    cost = problem.cost_of(arcs)
    if cost is None:
        return Outcome("wrong", answer.seconds)
    bound = cost if answer.status == "optimal" else answer.bound
    return Outcome(answer.status, answer.seconds, cost, bound, answer.incumbents)


def solve_core(model, relaxation, solver, limit_s):
    """The integer program of one part by way of its core."""
    reduced = model.costs - model.matrix.T @ relaxation.duals
    bound = relaxation.duals.sum() + np.minimum(0.0, reduced).sum()
    order = np.sort(reduced)
    size = FIRST_CORE_COLUMNS + CORE_COLUMNS_PER_ROW * len(model.lower)
    total = Answer("limit", 0.0, bound=bound)
    while total.seconds < limit_s:
        reach = order[min(size, len(order)) - 1]
        chosen = np.flatnonzero(reduced <= reach)
        answer = solver.mip(model.columns(chosen), limit_s - total.seconds)
        _add(total, answer, chosen, len(model.costs))
        if answer.status == "infeasible" and len(chosen) < len(order):
            size *= 4
            continue
        if answer.status != "optimal":
            total.status = answer.status
            return total
        if len(chosen) == len(order) or answer.value - bound <= reach:
            total.status, total.bound = "optimal", total.value
            return total
        size = max(len(chosen) + 1, np.count_nonzero(reduced <= answer.value - bound))
    return total


def _add(total, answer, chosen, num_columns):
    """Takes what another call has found."""
    total.incumbents += [(total.seconds + second, value) for second, value in answer.incumbents if value < total.value]
    total.seconds += answer.seconds
    if answer.chosen is not None and answer.value < total.value:
        total.value = answer.value
        total.chosen = np.zeros(num_columns, dtype=bool)
        total.chosen[chosen[answer.chosen]] = True


def _decomposed(problem, solver, limit_s, solve):
    """Part by part, smallest first, until all are solved or the time is over."""
    total = Answer("optimal", 0.0, bound=problem.constant, incumbents=[])
    value, arcs = problem.constant, []
    complete = not problem.obligatory.any()
    for model in problem.parts():
        answer = solve_part(model, limit_s - total.seconds, solve)
        if complete:
            total.incumbents += [(total.seconds + second, value + found) for second, found in answer.incumbents]
        total.seconds += answer.seconds
        total.bound += answer.bound
        if answer.chosen is not None:
            value += answer.value
            arcs.append(model.arcs[answer.chosen])
        if answer.status != "optimal":
            total.status = answer.status
            total.bound = -np.inf
            break
    if total.status != "optimal" and not complete:
        return Outcome(total.status, total.seconds)
    if total.status == "optimal" and not complete:
        total.incumbents = [(total.seconds, value)]
    return _verified(problem, total, np.concatenate([*arcs, np.zeros(0, dtype=int)]))


def solve_part(model, limit_s, solve):
    """One part: its relaxation and, where that is not integral, solve(model, relaxation, seconds left)."""
    if limit_s <= 0:
        return Answer("limit", 0.0)
    relaxation = relax(model, limit_s)
    if relaxation.status != "optimal":
        return Answer(relaxation.status, relaxation.seconds)
    if relaxation.integral():
        chosen = relaxation.x > 0.5
        value = float(model.costs[chosen].sum())
        return Answer("optimal", relaxation.seconds, value, value, chosen, [(relaxation.seconds, value)])
    answer = solve(model, relaxation, limit_s - relaxation.seconds)
    answer.seconds += relaxation.seconds
    answer.incumbents = [(relaxation.seconds + second, value) for second, value in answer.incumbents]
    return answer


def warm_up(solver):
    """Loads what is loaded at the first call only: a triangle, whose relaxation is not integral."""
    triangle = csc_matrix(np.array([[1.0, 1, 0], [0, 1, 1], [1, 0, 1]]))
    model = Model(np.array([-1.0, -1, -1]), triangle, np.zeros(3), np.arange(3))
    relax(model, 1.0)
    solver.mip(model, 1.0)


RUN = {"whole": whole, "parts": parts, "core": core}
