"""Heights over a square: placements of centers and compression (sections 3.1.3, 5.1, 5.3 and 5.6)."""
from charts import Field, Series, published
from tables import groups, log

SHOWN = ("grid", "Halton", "extrema, stationary curvature and borders", "greedy")


def short(name):
    return name.split(" (")[0]


def field_of(rows, column, label, reach=None):
    """The heights, or with `reach` differences, as colors over the unit square."""
    lines = groups(rows, "y")
    values = [[row[column] for row in lines[y]] for y in sorted(lines)]
    every = [value for line in values for value in line]
    half = 0.5 / (len(values) - 1)
    low, high = (-reach, reach) if reach else (min(every), max(every))
    return Field(values, (-half, 1 + half), (-half, 1 + half), label, low, high, about_zero=bool(reach))


def pictures(results):
    heights = groups(results.table("heights"), "field")
    centers = groups(results.table("centers"), "field", "placement")

    def points(field, placement):
        return [(row["x"], row["y"]) for row in centers[field, placement]]

    names = list(heights)
    for name in names[:2]:
        field = field_of(heights[name], "height", "height")
        results.page.chart(f"figure_5_1_{short(name).replace(' ', '_')}", f"Figure 5.1: points of inflection, {short(name)}",
                           "Nodes beside which the curvature, half the Laplacian, changes its sign.",
                           [Series("points of inflection", points(name, "points of inflection"), "#d55e00", marks=True, size=2.4)],
                           "x over the side", "y over the side", field=field, square=True, height=308)
    bumps = heights[names[0]]
    results.page.chart("figure_5_3", "Figure 5.3: an approximation", f"The {short(names[0])} by functions at extrema, stationary curvature and borders (dots).",
                       [Series("centers", points(names[0], SHOWN[2]), "#d55e00", marks=True, size=2.4)],
                       "x over the side", "y over the side", field=field_of(bumps, "placed", "height"), square=True, height=308)
    off = [dict(row, off=1000 * (row["placed"] - row["height"])) for row in bumps]
    reach = max(abs(row["off"]) for row in off)
    results.page.chart("figure_5_3_error", "Figure 5.3: its error", "Approximated less given.", [], "x over the side", "y over the side",
                       field=field_of(off, "off", "error, 1/1000", reach), square=True, height=308)
    for placement in SHOWN:
        results.page.chart(f"figure_5_6_{placement.split(',')[0].lower()}", f"Figure 5.6: placement, {placement}",
                           f"Centers on the {short(names[0])}.", [Series("centers", points(names[0], placement), "#d55e00", marks=True, size=2.4)],
                           "x over the side", "y over the side", field=field_of(bumps, "height", "height"), square=True, height=308)


def placements(results):
    table = results.table("placements")
    names = list(groups(table, "placement"))
    count = int(table[0]["functions"])
    legend = "; ".join(f"{i} {name}" for i, name in enumerate(names, 1))
    results.page.chart("placement_errors", "Sections 5.1, 5.3, 5.6: placements beside each other", f"{count} Gaussians with the best of four reaches: {legend}.",
                       [Series(short(field), [(names.index(row["placement"]) + 1, log(row["percent"])) for row in rows], marks=True)
                        for field, rows in groups(table, "field").items()],
                       "placement", "log10 of the error, % of variance")
    for field, rows in groups(table, "field").items():
        errors = {row["placement"]: row["percent"] for row in rows}
        best = min(errors, key=errors.get)
        results.add("sections 5.1 to 5.6", f"{short(field)}: error of a grid over that of the best placement", "", errors["grid"] / errors[best],
                    f"{best}, {count} functions")


def compression(results):
    table = results.table("compression")
    series = [Series(f"{short(field)}, {placement}", [(row["share_percent"], log(row["percent"])) for row in rows], dash=placement == "greedy")
              for (field, placement), rows in groups(table, "field", "placement").items()]
    band = float(results.told("compression_low")), float(results.told("compression_high"))
    bottom = min(y for s in series for _, y in s.points) - 0.3
    lines = [published(f"published: {band[0]:g} and {band[1]:g} %" if i == 0 else "", [(x, bottom), (x, 3)], dash=True) for i, x in enumerate(band)]
    results.page.chart("compression", "Section 5.6: compression of height fields", "Error by the share of the 1681 heights that are kept as centers.",
                       lines + series, "share of the heights that are centers, %", "log10 of the error, % of variance",
                       y_range=(bottom, 2.3), width=480)
    least = {}
    for field, rows in groups(table, "field").items():
        kept = [row["share_percent"] for row in rows if row["placement"] == "Halton" and row["percent"] < 1]
        if kept:
            least[short(field)] = min(kept)
    if least:
        for key, pick in (("compression_low", min), ("compression_high", max)):
            field = pick(least, key=least.get)
            results.put(key, least[field], f"{field}, for an error below 1 %, of the shares that were tried; the fields are smooth, the papers' own not told")


def add_to(results):
    for part in (pictures, placements, compression):
        part(results)
