"""The tables of docs/benchmarks.md, made from the figures."""

from shared import write_between

from rivals.figures import OURS, TARGETS, TINY_ARCS, geometric_mean, ratio, seconds_text, shifted_mean

BEGIN, END = "<!-- tables: bench/rivals.py -->\n", "<!-- end of tables -->"
SOLVERS = {"highs": "HiGHS", "highs-program": "HiGHS program", "cbc": "CBC", "glpk": "GLPK"}


def title(method):
    return "nda" if method == OURS else f"{SOLVERS[method[0]]} {method[1]}"


def markdown(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    return "\n".join(lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows])


def dash(value):
    return "-" if value is None else str(value)


def class_title(many):
    return "5,000 arcs or more" if many else "fewer than 5,000 arcs"


def ratio_table(results):
    """How many times as long each rival took, as means over both classes."""
    rows = []
    for method in [None, *results.methods]:
        cells = ["**best rival**" if method is None else title(method)]
        for many in (True, False):
            ratios = results.ratios(results.names(many), method)
            bounds = sum(item.sign == ">" for item in ratios), sum(item.sign == "<" for item in ratios)
            cells += [dash(geometric_mean(ratios)), len(ratios), f"{bounds[0]}, {bounds[1]}"]
        rows.append(cells)
    header = ["rival"]
    for many in (True, False):
        header += [f"{class_title(many)}: mean ratio", "problems", "of them `>`, `<`"]
    return markdown(header, rows)


def proof_table(results):
    """How many problems each has proven, of those it was run on."""
    rows = []
    for method in [OURS, *results.methods]:
        cells = [title(method)]
        for many in (True, False):
            times = [results.time(name, method) for name in results.names(many)]
            times = [time for time in times if time]
            cells.append(f"{sum(time.proven for time in times)} of {len(times)}")
        rows.append(cells)
    return markdown(["", *(class_title(many) for many in (True, False))], rows)


def loss_text(results):
    lines = []
    for many in (True, False):
        names = results.names(many)
        losses = results.losses(names)
        told = "; ".join(f"{name} ({item})" for name, item in losses) or "none"
        lines.append(f"- {class_title(many)}: {len(losses)} of {len(names)}: {told}")
    return "\n".join(lines)


def open_text(results):
    """Problems that nda did not prove, and whether anyone did."""
    lines = []
    for many in (True, False):
        pairs = [(name, results.time(name, OURS), results.best_rival(name)) for name in results.names(many)]
        left = [f"{name} ({'a rival: ' + str(rival) + ' s' if rival.proven else 'nobody'})" for name, own, rival in pairs if not own.proven]
        lines.append(f"- {class_title(many)}: {len(left)}: {'; '.join(left) or 'none'}")
    return "\n".join(lines)


def tiny_text(results):
    times = [(results.time(name, OURS), name) for name, row in results.about.items() if row.arcs < TINY_ARCS]
    times = [(time, name) for time, name in times if time and time.proven]
    if not times:
        return "None was run."
    worst, name = max(times, key=lambda pair: pair[0].seconds)
    return f"{len(times)} problems, nda's slowest: {name}, {1e6 * worst.seconds:.0f} microseconds."


def target_table(results, many):
    """Reached by how many, and mean seconds, for every share."""
    rows = []
    for method in [OURS, None, *results.methods]:
        cells = ["**best rival**" if method is None else title(method)]
        for share in TARGETS:
            names = results.names(many)
            times = [results.target_time(name, method, share) if method else results.best_target_time(name, share) for name in names]
            times = [time for time in times if time]
            mean = shifted_mean([time.seconds for time in times]) if times else None
            cells += [f"{sum(time.proven for time in times)} of {len(times)}", "-" if mean is None else seconds_text(mean)]
        rows.append(cells)
    header = [class_title(many)]
    for share in TARGETS:
        header += [f"within {100 * share:g} %", "s"]
    return markdown(header, rows)


def family_table(results, names):
    methods = results.methods
    header = ["problem", "arcs", "kept", "parts", "nda", *map(title, methods), "/ HiGHS whole", "/ HiGHS parts", "/ best"]
    rows = []
    for name in names:
        about, own = results.about[name], results.time(name, OURS)
        compared = [results.time(name, ("highs", "whole")), results.time(name, ("highs", "parts")), results.best_rival(name)]
        rows.append(
            [name, about.arcs, about.kept, about.components, dash(own)]
            + [dash(results.time(name, method)) for method in methods]
            + [dash(ratio(rival, own)) for rival in compared]
        )
    return markdown(header, rows)


def run_text(results):
    limits = ", ".join(f"{limit:g} s ({', '.join(solvers)})" for limit, solvers in results.limits.items())
    return (
        f"Machine: {', '.join(results.machines)}, one core.  Programs: {', '.join(results.programs)}.  Time limit {limits}.\n"
        f"{len(results.about)} problems, of which {len(results.names(True)) + len(results.names(False))} were run by nda and a rival."
    )


def tables(results):
    """All of it as Markdown."""
    parts = [
        run_text(results),
        "### Ratios",
        ratio_table(results),
        "### Where a rival proved faster",
        loss_text(results),
        "### Not proven by nda within the limit",
        open_text(results),
        f"### Fewer than {TINY_ARCS} arcs",
        tiny_text(results),
        "### Proven within the limit",
        proof_table(results),
        "### Time to good solutions",
        target_table(results, True),
        target_table(results, False),
        "### Runs that failed",
        "\n".join(f"- {row.instance}, {row.solver} {row.setup}: {row.status} {row.note}".rstrip() for row in results.failures) or "None.",
        "### Contradictions",
        "\n".join(f"- {line}" for line in results.contradictions) or "None: no two answers contradict each other.",
    ]
    for family, names in results.families().items():
        parts += [f"### {family}", family_table(results, names)]
    return "\n\n".join(parts)


def write(path, text):
    """Puts the tables between the markers of a page."""
    write_between(path, BEGIN, END, f"\n{text}\n\n")
