"""Heights over a square: placements of centers and compression (sections 3.1.3, 5.1, 5.3 and 5.6)."""
from charts import Field, Series, published
from runs import groups, log, table

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


def pictures(page):
    """Figures 5.1, 5.3 and 5.6."""
    heights, centers = groups(table(page, "heights"), "field"), groups(table(page, "centers"), "field", "placement")

    def dots(name, placement):
        return [Series("points of inflection" if placement == "points of inflection" else "centers",
                       [(row["x"], row["y"]) for row in centers[name, placement]], "#d55e00", marks=True, size=2.4)]

    names = list(heights)
    for name in names[:2]:
        page.draw(f"figure_5_1_{short(name).replace(' ', '_')}", dots(name, "points of inflection"), {"field": short(name)},
                  field=field_of(heights[name], "height", "height"))
    bumps = heights[names[0]]
    off = [dict(row, off=1000 * (row["placed"] - row["height"])) for row in bumps]
    told = {"field": short(names[0])}
    page.draw("figure_5_3", dots(names[0], SHOWN[2]), told, field=field_of(bumps, "placed", "height"))
    page.draw("figure_5_3_error", [], field=field_of(off, "off", "error, 1/1000", max(abs(row["off"]) for row in off)))
    for placement in SHOWN:
        page.draw(f"figure_5_6_{placement.split(',')[0].lower()}", dots(names[0], placement), {**told, "placement": placement},
                  field=field_of(bumps, "height", "height"))


def placements(page):
    rows = table(page, "placements")
    names, count = list(groups(rows, "placement")), int(rows[0]["functions"])
    by_field = {short(field): each for field, each in groups(rows, "field").items()}
    page.draw("placement_errors", [Series(field, [(names.index(row["placement"]) + 1, log(row["percent"])) for row in each], marks=True)
                                   for field, each in by_field.items()],
              {"functions": count, "placements": "; ".join(f"{i} {name}" for i, name in enumerate(names, 1))})
    for field, each in by_field.items():
        errors = {row["placement"]: row["percent"] for row in each}
        best = min(errors, key=errors.get)
        page.put(f"grid_over_best_{field}", errors["grid"] / errors[best], best=best, functions=count)


def compression(page):
    """Section 5.6."""
    rows = table(page, "compression")
    series = [Series(f"{short(field)}, {placement}", [(row["share_percent"], log(row["percent"])) for row in each], dash=placement == "greedy")
              for (field, placement), each in groups(rows, "field", "placement").items()]
    band = page.value("compression_low"), page.value("compression_high")
    bottom = min(y for s in series for _, y in s.points) - 0.3
    told = [published(f"{x:g} %", [(x, bottom), (x, 3)], dash=True, legend=f"published: {band[0]:g} and {band[1]:g} %" if x == band[0] else "") for x in band]
    page.draw("compression", told + series, y_range=(bottom, 2.3))
    kept = groups([row for row in rows if row["placement"] == "Halton" and row["percent"] < 1], "field")
    least = {short(field): min(row["share_percent"] for row in each) for field, each in kept.items()}
    for key, pick in (("compression_low", min), ("compression_high", max)) if least else ():
        field = pick(least, key=least.get)
        page.put(key, least[field], field=field)


def tell(page):
    for part in (pictures, placements, compression):
        part(page)
