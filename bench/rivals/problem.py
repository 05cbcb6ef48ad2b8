"""Arc files as numpy arrays, the integer programs that rivals get, and the cost of what they answer.

Nothing here shares code with nda: the costs of rivals are recomputed from the arcs by these lines.
"""

import dataclasses
import gzip

import numpy as np
from scipy.sparse import coo_matrix, csc_matrix, csgraph


@dataclasses.dataclass
class Model:
    """Minimise costs x, lower <= matrix x <= 1, x binary; `arcs` names the arc of each column."""

    costs: np.ndarray
    matrix: csc_matrix
    lower: np.ndarray
    arcs: np.ndarray

    def columns(self, chosen):
        """The same rows with these columns only."""
        return Model(self.costs[chosen], self.matrix[:, chosen], self.lower, self.arcs[chosen])


@dataclasses.dataclass
class Problem:
    """tuples[a][k] is the index of arc a in dimension k, 0 for none; rows are the indices, dimension by dimension."""

    sizes: np.ndarray
    tuples: np.ndarray
    costs: np.ndarray
    singletons: np.ndarray  # cost of each row's singleton; inf where it is forbidden

    @property
    def num_rows(self):
        return len(self.singletons)

    @property
    def num_arcs(self):
        return len(self.costs)

    @property
    def obligatory(self):
        """Rows that an arc must use."""
        return np.isinf(self.singletons)

    @property
    def constant(self):
        """Cost of leaving every index alone that may be."""
        return self.singletons[~self.obligatory].sum()

    def incidence(self, arcs):
        """One column per arc, one row per index, as a csc matrix."""
        first = np.concatenate([[0], np.cumsum(self.sizes)[:-1]])
        used = self.tuples[arcs] > 0
        rows = (self.tuples[arcs] - 1 + first)[used]
        starts = np.concatenate([[0], np.cumsum(used.sum(axis=1))])
        return csc_matrix((np.ones(len(rows)), rows, starts), shape=(self.num_rows, len(arcs)))

    def shifted_costs(self):
        """Costs less those of the singletons that an arc spares."""
        spared = np.where(self.obligatory, 0.0, self.singletons)
        return self.costs - self.incidence(np.arange(self.num_arcs)).T @ spared

    def kept(self):
        """Arcs that can be of use: they save something or cover what must be covered."""
        covers = self.incidence(np.arange(self.num_arcs)).T @ self.obligatory.astype(float)
        return np.flatnonzero((self.shifted_costs() < 0) | (covers > 0))

    def whole(self):
        """Set packing with shifted costs: a column per arc that is kept, a row per index that these use."""
        arcs = self.kept()
        return self._model(self.incidence(arcs), self.shifted_costs()[arcs], arcs, np.arange(len(arcs)))

    def parts(self):
        """The same for each connected component, smallest first."""
        arcs = self.kept()
        matrix, costs = self.incidence(arcs), self.shifted_costs()[arcs]
        entries = matrix.tocoo()
        size = self.num_rows + len(arcs)
        graph = coo_matrix((entries.data, (entries.row, self.num_rows + entries.col)), shape=(size, size))
        labels = csgraph.connected_components(graph, directed=False)[1]
        order = np.argsort(labels[self.num_rows :], kind="stable")
        cuts = np.flatnonzero(np.diff(labels[self.num_rows :][order])) + 1
        groups = [group for group in np.split(order, cuts) if len(group)]
        return [self._model(matrix, costs, arcs, group) for group in sorted(groups, key=len)]

    def _model(self, matrix, costs, arcs, group):
        columns = matrix[:, group]
        rows, renamed = np.unique(columns.indices, return_inverse=True)
        small = csc_matrix((columns.data, renamed, columns.indptr), shape=(len(rows), len(group)))
        return Model(costs[group], small, self.obligatory[rows].astype(float), arcs[group])

    def cost_of(self, arcs):
        """Cost of the solution with these arcs and singletons elsewhere; None if it is none."""
        uses = np.asarray(self.incidence(np.asarray(arcs, dtype=int)).sum(axis=1)).ravel()
        if uses.max(initial=0) > 1:
            return None
        cost = self.costs[arcs].sum() + self.singletons[uses == 0].sum()
        return float(cost) if np.isfinite(cost) else None


def read_text(path):
    data = path.read_bytes()
    return gzip.decompress(data) if data[:2] == b"\x1f\x8b" else data


def read_problem(path):
    """A problem from a .nda file, compressed or not; one with bounds on uses is refused."""
    lines = read_text(path).split(b"\n")
    if any(line.startswith(b"b") and line.split()[3:] != [b"1", b"1"] for line in lines):
        raise ValueError(f"{path}: bounds on uses are not supported")
    header = next(line for line in lines if line.startswith(b"p")).split()
    num_dimensions = int(header[2])
    sizes = np.array([int(word) for word in header[3 : 3 + num_dimensions]])
    body = b" ".join(line[1:] for line in lines if line.startswith(b"a"))
    table = np.array(body.split(), dtype=float).reshape(-1, num_dimensions + 1)
    tuples, costs = table[:, :-1].astype(int), table[:, -1]
    single = (tuples > 0).sum(axis=1) == 1
    first = np.concatenate([[0], np.cumsum(sizes)[:-1]])
    singletons = np.full(sizes.sum(), np.nan)
    rows = (tuples[single] - 1 + first)[tuples[single] > 0]
    np.fmin.at(singletons, rows, costs[single])  # of equal tuples the cheapest counts
    singletons[np.isnan(singletons)] = 0.0
    useful = ~single & np.isfinite(costs)
    return Problem(sizes, tuples[useful], costs[useful], singletons)
