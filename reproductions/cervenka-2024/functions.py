"""Functions, their condition numbers, and signals along a line (chapter 3, sections 5.2, 5.5 and 5.7)."""
import math
from fractions import Fraction

from charts import Field, Series, published
from tables import groups, log

def formula(text, r):
    """A published formula at r."""
    return eval(text.replace("^", "**"), {"__builtins__": {}}, {"r": r, "exp": math.exp, "log": math.log})


def told_curve(text, points, ends):
    return [(s, 0.0 if ends and s > 1 else formula(text, s)) for s, _ in points if s > 0]


def kernels(results):
    curves = {name: [(row["s"], row["value"]) for row in rows] for name, rows in groups(results.table("kernels"), "kernel").items()}
    remarks = {
        "wendland-33": "the printed 3 at the end makes a kink at the center; with 1, as in Wendland 1995, there is none",
        "wendland-51": "the printed power 3 makes a function that grows from its center; with 5, as in Wendland 1995, it falls",
        "gaussian": "the table's exponent lacks the square that eq. 6.11 has; here exp(-s²)"}
    for name, points in curves.items():
        ends = name.startswith("wendland")
        told = dict(told_curve(results.told(name), points, ends))
        off = max(abs(value - told[s]) for s, value in points if s in told)
        results.put(name, off, remarks.get(name, name if off < 1e-12 else ""))
    for figure, title, remark, which in (
            ("table_3_1", "Table 3.1: local functions", "They end at their reach. Dots: as printed; numbers 7 and 9 are not Wendland's functions there.",
             [name for name in curves if name.startswith("wendland")]),
            ("table_3_2", "Table 3.2: global functions", "Dots: as printed, with α = 1, and 1.5 for the proposed one; the Gaussian lacks its square there.",
             [name for name in curves if not name.startswith("wendland")])):
        dots = [p for name in which for p in told_curve(results.told(name), curves[name][::4], name.startswith("wendland"))]
        shown = [Series(f"{i + 1} {name}" if name.startswith("wendland") else name, curves[name]) for i, name in enumerate(which)]
        results.page.chart(figure, title, remark, shown + [published("published", dots, marks=True, size=1.7)],
                           "distance over reach", "value")
    powers = groups(results.table("powers"), "exponent")
    results.page.chart("figure_5_2", "Figure 5.2: the proposed function", "r² (r^α - 1) for some α. The published figure has no numbers.",
                       [Series(f"α = {exponent:g}", [(row["s"], row["value"]) for row in rows]) for exponent, rows in powers.items()],
                       "distance over reach", "value")


def halton(results):
    rows = results.table("halton")
    of = lambda value: Fraction(value).limit_denominator(100)  # noqa: E731
    ours = {f"halton_{k}": f"{of(row['base_2'])} {of(row['base_3'])}" for k, row in enumerate(rows[:3], 1)}
    ours["halton_base_2"] = " ".join(str(of(row["base_2"])) for row in rows)
    for key, value in ours.items():
        results.put(key, value, "the same" if value == results.told(key) else "not the same")


def conditions(results):
    maps = groups(results.table("conditions"), "map")
    for name, title, remark in (
            ("gaussian grid", "Figure 5.7: Gaussians on a grid", "Condition number in the 1-norm by shape parameter and number of functions on the "
             "unit square. 16 is where nothing is left of double precision."),
            ("gaussian Halton", "Figure 5.7: Gaussians on the Halton sequence", "The same; the two closest points decide, and of the Halton sequence they are closer than a grid's."),
            ("thin-plate grid", "Figure 5.7: thin plates on a grid", "Thin plates of r √α, without a polynomial. Columns this coarse mostly miss the one parameter at which the matrix is singular."),
            ("thin-plate Halton", "Figure 5.7: thin plates on the Halton sequence", "The same; two parameters, close to each other.")):
        rows = groups(maps[name], "functions")
        counts = sorted(rows)
        values = [[min(row["log_condition"], 20) for row in rows[count]] for count in counts]
        alphas = [row["log_alpha"] for row in rows[counts[0]]]
        half = (alphas[1] - alphas[0]) / 2
        sides = [math.sqrt(count) for count in counts]
        step = (sides[1] - sides[0]) / 2
        most = 8 if name.startswith("thin-plate") else 20
        field = Field(values, (alphas[0] - half, alphas[-1] + half), (sides[0] - step, sides[-1] + step), "log10 of the condition number", 0, most)
        results.page.chart("figure_5_7_" + name.replace(" ", "_").replace("-", "_").lower(), title, remark, [],
                           "log10 of the shape parameter α", "√(number of functions)", field=field)
    pairs = list(zip(maps["gaussian grid"], maps["gaussian Halton"]))
    better = sum(b["log_condition"] < a["log_condition"] - 1e-3 for a, b in pairs)
    results.put("halton_better", 100 * better / len(pairs), f"{100 * share_better(pairs):.0f} % of those where either is below 10^16: the two closest points decide, "
                "and a grid's are farther apart")


def singular(results):
    peaks = groups(results.table("peaks"), "map", "functions")
    count = {key: sum(row["log_alpha"] is not None for row in rows) for key, rows in peaks.items()}
    of = lambda name: [n for (key, _), n in sorted(count.items()) if key == name]  # noqa: E731
    results.put("grid_peaks", max(of("gaussian grid")), "Gaussians at different points are independent for every α; what is seen is rounding, from some α down")
    plates, scattered = of("thin-plate grid"), of("thin-plate Halton")
    results.put("plate_peaks", span(plates), f"on a grid, without a polynomial; on the Halton sequence {span(scattered)}, close to each other")
    places = {name: [(math.sqrt(functions), row["log_alpha"]) for (key, functions), rows in sorted(peaks.items()) if key == name
                     for row in rows if row["log_alpha"] is not None] for name in ("thin-plate grid", "thin-plate Halton")}
    results.page.chart("thin_plate_peaks", "Section 5.7: where thin plates are singular", "Shape parameters at which interpolation by thin plates has no solution, by number of functions; "
                       "every maximum of the condition number followed to its top.",
                       [Series(name.replace("thin-plate ", "on a ").replace("a Halton", "the Halton sequence"), points, marks=True) for name, points in places.items()],
                       "√(number of functions)", "log10 of the shape parameter α")


def span(values):
    """One number, or from the least to the most."""
    return min(values) if min(values) == max(values) else f"{min(values)} to {max(values)}"


def share_better(pairs):
    told = [(a, b) for a, b in pairs if min(a["log_condition"], b["log_condition"]) < 16]
    return sum(b["log_condition"] < a["log_condition"] - 1e-3 for a, b in told) / max(len(told), 1)


def signals(results):
    by_signal = groups(results.table("signal_curves"), "signal")
    results.page.chart("signals", "Section 5.2: signals", "Each is hard for some function. The papers' own are not in the report.",
                       [Series(name, [(row["x"], row["height"]) for row in rows]) for name, rows in by_signal.items()], "place x", "height")
    errors = groups(results.table("signals"), "kernel")
    names = list(errors)
    bound = float(results.told("gaussian_error"))
    results.page.chart("signal_errors", "Section 5.2: errors of functions on signals", "20 functions at ends, extrema, inflections and Halton's points; the best of some reaches "
                       "and exponents. 1 to 10: Table 3.1; 11 Gaussian, 12 thin plate, 13 proposed. Line: published bound for the global ones.",
                       [published(f"published: below {bound:g} %", [(11, log(bound)), (13, log(bound))])] +
                       [Series(signal, [(names.index(row["kernel"]) + 1, log(row["percent"])) for row in rows], marks=True)
                        for signal, rows in groups(results.table("signals"), "signal").items()],
                       "function", "log10 of the error, % of variance", width=480)
    worst = {key: max(errors[name], key=lambda row: row["percent"])
             for key, name in (("gaussian_error", "gaussian"), ("thin_plate_error", "thin-plate"), ("proposed_error", "power-minus-1"))}
    for key, row in worst.items():
        results.put(key, row["percent"], f"on '{row['signal']}'" + (", for which 20 functions are few; the papers' signals and numbers are not told"
                                                                    if row["percent"] > bound else ""))
    globals_ = [errors[name] for name in ("gaussian", "thin-plate", "power-minus-1")]
    best = [min(rows, key=lambda row: row["percent"])["kernel"] for rows in zip(*globals_)]
    results.put("proposed_best", f"{best.count('power-minus-1')} of {len(best)}", f"Gaussians on {best.count('gaussian')}, thin plates on {best.count('thin-plate')}; "
                "the papers' signals, centers and exponents are not told")


def exponents(results):
    tables = groups(results.table("exponents"), "signal")
    whole = [published("whole numbers" if n == 1 else "", [(n, -20), (n, 25)], dash=True) for n in range(1, 7)]
    remark = "Interpolation at 20 of Halton's points by r² (r^α - 1). "
    error = [Series(name, [(row["exponent"], log(row["percent"])) for row in rows if row["percent"] is not None]) for name, rows in tables.items()]
    results.page.chart("figure_5_5", "Figure 5.5: error by shape parameter", remark + "Gray: where the report sees peaks. No point where the system is singular.",
                       whole + error, "shape parameter α", "log10 of the error, % of variance", y_range=range_of(error))
    rows = next(iter(tables.values()))
    condition = [Series("condition number", [(row["exponent"], min(row["log_condition"], 20)) for row in rows])]
    results.page.chart("figure_5_5_condition", "Figure 5.5: condition by shape parameter", remark + "Even α make a polynomial of r², of which no more than α + 3 are independent.",
                       whole + condition, "shape parameter α", "log10 of the condition number", y_range=(0, 21))
    singular = [row["exponent"] for row in rows if row["exponent"] == int(row["exponent"]) and row["log_condition"] > 15.6]
    results.put("exponent_peaks", ", ".join(f"{value:g}" for value in singular), "of the whole numbers 1 to 6: even ones make a polynomial; odd ones do not, along a line")


def range_of(series):
    values = [y for s in series for _, y in s.points]
    room = 0.05 * (max(values) - min(values))
    return min(values) - room, max(values) + room


def add_to(results):
    for part in (kernels, halton, conditions, singular, signals, exponents):
        part(results)
