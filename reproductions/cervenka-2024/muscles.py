"""Gluteus maximus as an implicit surface, its curvature, and a flexed hip (sections 5.6, 5.8, 5.13, chapter 6)."""
import statistics

import runs
from charts import Field, Series
from runs import groups, log, table

MODELS = {"published": ("rbf-2024, as published", "#d55e00"), "completed": ("rbf, completed", "#0072b2"), "pbd": ("pbd-2020", "#009e73")}


def solids(page):
    """Section 5.6 on a muscle."""
    by_muscle = groups(table(page, "solids"), "muscle")
    for figure, column, of in (("solid_volume", "volume_error_percent", log), ("solid_distance", "mean_mm", float)):
        page.draw(figure, [Series(name, [(row["share_percent"], of(row[column])) for row in rows]) for name, rows in by_muscle.items()])
    for name, rows in by_muscle.items():
        most = rows[-1]
        page.put(f"solid_{name}", most["volume_error_percent"], share=most["share_percent"], vertices=most["vertices"], mean=most["mean_mm"],
                 hausdorff=most["hausdorff_mm"])


def zero_points(rows):
    """Where the field changes its sign between neighbors along a line of the slice or across."""
    found = []
    for lines, moving in ((groups(rows, "across_mm"), "along_mm"), (groups(rows, "along_mm"), "across_mm")):
        for a, b in (pair for line in lines.values() for pair in zip(line, line[1:])):
            if (a["field_mm"] < 0) != (b["field_mm"] < 0):
                share = a["field_mm"] / (a["field_mm"] - b["field_mm"])
                point = {**a, moving: a[moving] + share * (b[moving] - a[moving])}
                found.append((point["along_mm"], point["across_mm"]))
    return found


def curvature(page):
    """Figure 5.13."""
    rows = table(page, "curvature")
    lines = groups(rows, "across_mm")
    heights = sorted(lines)
    widths = [row["along_mm"] for row in lines[heights[0]]]
    half = (heights[1] - heights[0]) / 2
    surface = [Series("implicit surface", zero_points(rows), "#222", marks=True, size=0.9),
               Series("triangles", [(row["along_mm"], row["across_mm"]) for row in table(page, "crossings")], "#009e73", marks=True, size=1.3)]
    for name, column, label in (("field", "field_mm", "distance to the surface, mm"), ("curvature", "field_curvature", "curvature of the field, 1/m")):
        reach = sorted(abs(row[column]) for row in rows)[int(0.98 * len(rows))]
        page.draw(f"figure_5_13_{name}", surface,
                  field=Field([[row[column] for row in lines[y]] for y in heights], (widths[0] - half, widths[-1] + half),
                              (heights[0] - half, heights[-1] + half), label, -reach, reach, about_zero=True))


def gradient(page):
    """Equations 6.8 to 6.12."""
    rows = [row for row in table(page, "gradient") if abs(row["by_differences"]) > 0]
    for key, column in (("gradient", "closed_form"), ("gradient_printed", "without_weight")):
        page.put(key, statistics.median(row[column] / row["by_differences"] for row in rows))
    descent = table(page, "descent")
    page.draw("descent", [Series("cost", [(row["steps"], row["cost_share"]) for row in descent])])
    page.put("descent", descent[-1]["cost_share"], steps=descent[-1]["steps"])


def by_frame(rows, column, pick):
    return [(frame, pick([row[column] for row in each])) for frame, each in groups(rows, "frame").items()]


def hip(page):
    """Chapter 6 and section 5.8 on the built-in hip."""
    measures = {name: rows for name in MODELS if (rows := runs.measures(f"{page.out}/{name}"))}
    for figure, column, pick in (("hip_volume", "volume_ratio", lambda values: 100 * max((value - 1 for value in values), key=abs)),
                                 ("hip_edges", "edge_ratio_mean", max), ("hip_cost", "cost", lambda values: log(sum(values)))):
        page.draw(figure, [Series(MODELS[name][0], [point for point in by_frame(rows, column, pick) if column != "cost" or point[1] > -29], MODELS[name][1])
                           for name, rows in measures.items() if column in rows[0]])
    lengths = {name: runs.fibers(f"{page.out}/{name}") for name in measures}
    for muscle in ("gluteus_maximus_r", "iliacus_r"):
        page.draw(f"fibers_{muscle}", [Series(MODELS[name][0], [(x, statistics.mean(each)) for x, each in lengths[name][muscle]], MODELS[name][1]) for name in measures],
                  {"muscle": muscle.replace("_", " ")})
    for name, rows in measures.items():
        worst = max(rows, key=lambda row: abs(row["volume_ratio"] - 1))
        change = 100 * abs(worst["volume_ratio"] - 1)
        page.put(f"hip_volume_{name}", change, muscle=worst["muscle"], last=rows[-1]["frame"], muscles=len(groups(rows, "muscle")),
                 time=statistics.median(runs.frame_times(f"{page.out}/{name}")))
        if name == "pbd":
            page.put("pbd_volume", change, muscle=worst["muscle"])


def tell(page):
    for part in (solids, curvature, gradient, hip):
        part(page)
