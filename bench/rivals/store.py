"""The raw rows, one per run, in a CSV file from which all tables can be made again."""

import csv
import dataclasses


@dataclasses.dataclass
class Row:
    """One run.  status: optimal, limit (of time), killed (did not heed it), infeasible, failed, or wrong (its answer is no solution)."""

    instance: str
    family: str
    arcs: int  # lines of the file
    kept: int  # after the cost shift
    components: int
    solver: str
    setup: str
    run: int
    limit_s: float
    status: str
    seconds: float
    cost: float
    bound: float
    incumbents: tuple  # (second, cost)
    best_known: float  # nan: none is listed
    program: str
    machine: str
    note: str

    @property
    def key(self):
        return self.instance, self.solver, self.setup

    @property
    def proven(self):
        return self.status in ("optimal", "infeasible")


FIELDS = [field.name for field in dataclasses.fields(Row)]
INTEGERS = ("arcs", "kept", "components", "run")
REALS = ("limit_s", "seconds", "cost", "bound", "best_known")
NEAR = 0.02


def relevant(incumbents, cost):
    """Those within NEAR of the last cost, where they get better."""
    kept = []
    for second, value in incumbents:
        if value <= cost + NEAR * abs(cost) + 1e-9 and (not kept or value < kept[-1][1]):
            kept.append((second, value))
    return tuple(kept)


def to_text(row):
    values = {name: getattr(row, name) for name in FIELDS}
    values["incumbents"] = " ".join(f"{second:.5f}:{value:.6f}" for second, value in row.incumbents)
    values.update({name: f"{values[name]:.10g}" for name in REALS})
    return values


def from_text(values):
    pairs = (pair.split(":") for pair in values["incumbents"].split())
    numbers = {name: int(values[name]) for name in INTEGERS} | {name: float(values[name]) for name in REALS}
    return Row(**{**values, **numbers, "incumbents": tuple((float(second), float(value)) for second, value in pairs)})


class Store:
    """Rows in memory and on disk; every new row is on disk at once."""

    def __init__(self, path):
        self.path = path
        self.rows = []
        if path and path.exists():
            with path.open(newline="") as file:
                self.rows = [from_text(values) for values in csv.DictReader(file)]

    def _write(self, rows, mode):
        if not self.path:
            return
        with self.path.open(mode, newline="") as file:
            writer = csv.DictWriter(file, FIELDS, lineterminator="\n")
            if mode == "w":
                writer.writeheader()
            writer.writerows(to_text(row) for row in rows)

    def add(self, row):
        is_new = not self.rows
        self.rows.append(row)
        self._write([row], "w" if is_new else "a")

    def forget(self, is_old):
        """Drops rows, also on disk."""
        self.rows = [row for row in self.rows if not is_old(row)]
        self._write(self.rows, "w")

    def missing_runs(self, key, limit_s, repeat):
        """Numbers of the runs yet to do; one that reached as long a limit in vain is not repeated."""
        done = [row for row in self.rows if row.key == key]
        if any(not row.proven and row.limit_s >= limit_s for row in done):
            return range(0)
        proven = sum(row.proven for row in done)
        return range(proven, max(proven, repeat))
