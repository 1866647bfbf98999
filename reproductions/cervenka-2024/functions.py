"""Functions, their condition numbers, and signals along a line (chapter 3, sections 5.2, 5.5 and 5.7)."""
import math
from fractions import Fraction

from charts import Field, Series, published
from runs import groups, log, table


def printed(page, name, points):
    """What the published formula of this function has at the points; Wendland's end at 1."""
    formula = compile(page.text(name).replace("^", "**"), name, "eval")
    return [(s, 0 if name.startswith("wendland") and s > 1 else eval(formula, {"__builtins__": {}, "r": s, "exp": math.exp, "log": math.log}))
            for s, _ in points if s > 0]


def kernels(page):
    """Tables 3.1 and 3.2, and Figure 5.2."""
    curves = {name: [(row["s"], row["value"]) for row in rows] for name, rows in groups(table(page, "kernels"), "kernel").items()}
    for name, points in curves.items():
        told = dict(printed(page, name, points))
        page.put(name, max(abs(value - told[s]) for s, value in points if s in told))
    for figure, is_local in (("table_3_1", True), ("table_3_2", False)):
        which = [name for name in curves if name.startswith("wendland") == is_local]
        dots = [point for name in which for point in printed(page, name, curves[name][::4])]
        shown = [Series(f"{i} {name}" if is_local else name, curves[name]) for i, name in enumerate(which, 1)]
        page.draw(figure, shown + [published("published", dots, marks=True, size=1.7)])
    page.draw("figure_5_2", [Series(f"α = {exponent:g}", [(row["s"], row["value"]) for row in rows])
                             for exponent, rows in groups(table(page, "powers"), "exponent").items()])


def halton(page):
    """Section 3.1.3."""
    points = [[str(Fraction(row[base]).limit_denominator(100)) for base in ("base_2", "base_3")] for row in table(page, "halton")]
    for number, point in enumerate(points[:3], 1):
        page.put(f"halton_{number}", " ".join(point))
    page.put("halton_base_2", " ".join(point[0] for point in points))


def conditions(page):
    """Figure 5.7."""
    maps = groups(table(page, "conditions"), "map")
    for name, told in maps.items():
        rows = groups(told, "functions")
        counts = sorted(rows)
        alphas, sides = [row["log_alpha"] for row in rows[counts[0]]], [math.sqrt(count) for count in counts]
        half, step = (alphas[1] - alphas[0]) / 2, (sides[1] - sides[0]) / 2
        field = Field([[min(row["log_condition"], 20) for row in rows[count]] for count in counts], (alphas[0] - half, alphas[-1] + half),
                      (sides[0] - step, sides[-1] + step), "log10 of the condition number", 0, 8 if name.startswith("thin-plate") else 20)
        page.draw("figure_5_7_" + name.replace(" ", "_").replace("-", "_").lower(), [], field=field)
    pairs = [(a["log_condition"], b["log_condition"]) for a, b in zip(maps["gaussian grid"], maps["gaussian Halton"])]
    better, among = ([100 * (b < a - 1e-3) for a, b in each] for each in (pairs, [pair for pair in pairs if min(pair) < 16]))
    page.put("halton_better", sum(better) / len(better), well=sum(among) / max(len(among), 1))


def singular(page):
    """Section 5.7."""
    peaks = groups(table(page, "peaks"), "map", "functions")
    found = {key: [row["log_alpha"] for row in rows if row["log_alpha"] is not None] for key, rows in peaks.items()}

    def counts(name):
        most = [len(alphas) for (key, _), alphas in found.items() if key == name]
        return min(most) if min(most) == max(most) else f"{min(most)} to {max(most)}"

    page.put("grid_peaks", max(len(alphas) for (key, _), alphas in found.items() if key == "gaussian grid"))
    page.put("plate_peaks", counts("thin-plate grid"), halton=counts("thin-plate Halton"))
    page.draw("thin_plate_peaks", [Series(label, [(math.sqrt(functions), alpha) for (key, functions), alphas in sorted(found.items()) if key == name for alpha in alphas],
                                          marks=True) for name, label in (("thin-plate grid", "on a grid"), ("thin-plate Halton", "on the Halton sequence"))])


def signals(page):
    """Section 5.2."""
    page.draw("signals", [Series(name, [(row["x"], row["height"]) for row in rows]) for name, rows in groups(table(page, "signal_curves"), "signal").items()])
    errors = groups(table(page, "signals"), "kernel")
    names, bound = list(errors), page.value("gaussian_error")
    page.draw("signal_errors", [published(f"published: below {bound:g} %", [(11, log(bound)), (13, log(bound))])] +
              [Series(signal, [(names.index(row["kernel"]) + 1, log(row["percent"])) for row in rows], marks=True)
               for signal, rows in groups(table(page, "signals"), "signal").items()])
    own = {"gaussian_error": "gaussian", "thin_plate_error": "thin-plate", "proposed_error": "power-minus-1"}
    for key, name in own.items():
        worst = max(errors[name], key=lambda row: row["percent"])
        page.put(key, worst["percent"], signal=worst["signal"])
    best = [min(rows, key=lambda row: row["percent"])["kernel"] for rows in zip(*(errors[name] for name in own.values()))]
    page.put("proposed_best", f"{best.count('power-minus-1')} of {len(best)}", gaussians=best.count("gaussian"), plates=best.count("thin-plate"))


def exponents(page):
    """Figure 5.5."""
    tables = groups(table(page, "exponents"), "signal")
    whole = [published(f"peak at {n}", [(n, -20), (n, 25)], dash=True, legend="published: peaks at whole numbers" if n == 1 else "") for n in range(1, 7)]
    error = [Series(name, [(row["exponent"], log(row["percent"])) for row in rows if row["percent"] is not None]) for name, rows in tables.items()]
    values = [y for s in error for _, y in s.points]
    room = 0.05 * (max(values) - min(values))
    page.draw("figure_5_5", whole + error, y_range=(min(values) - room, max(values) + room))
    rows = next(iter(tables.values()))
    page.draw("figure_5_5_condition", whole + [Series("condition number", [(row["exponent"], min(row["log_condition"], 20)) for row in rows])])
    page.put("exponent_peaks", ", ".join(f"{row['exponent']:g}" for row in rows if row["exponent"] == int(row["exponent"]) and row["log_condition"] > 15.6))


def tell(page):
    for part in (kernels, halton, conditions, singular, signals, exponents):
        part(page)
