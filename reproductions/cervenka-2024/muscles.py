"""Gluteus maximus as an implicit surface, its curvature, and a flexed hip (sections 5.6, 5.8, 5.13, chapter 6)."""
import os
import statistics

from charts import Field, Series, published
from tables import groups, log, read

COLORS = {"published": "#d55e00", "completed": "#0072b2", "pbd": "#009e73"}
NAMES = {"published": "rbf-2024, as published", "completed": "rbf, completed", "pbd": "pbd-2020"}


def solids(results):
    table = groups(results.table("solids"), "muscle")
    for column, label, title in (("volume_error_percent", "log10 of the volume error, %", "volume"),
                                 ("mean_mm", "mean distance, mm", "distance")):
        of = log if label.startswith("log") else float
        results.page.chart(f"solid_{title}", f"Section 5.6 on a muscle: {title}", "Gluteus maximus as thin plates on and beside its surface, extracted again. "
                           "No figure of the report.", [Series(name, [(row["share_percent"], of(row[column])) for row in rows]) for name, rows in table.items()],
                           "share of the vertices that are centers, %", label)
    for name, rows in table.items():
        row = rows[-1]
        results.add("section 5.6", f"gluteus maximus, {name}: volume error with {row['share_percent']:.0f} % of {row['vertices']:.0f} vertices", "%",
                    row["volume_error_percent"], f"mean distance {row['mean_mm']:.2f} mm, Hausdorff {row['hausdorff_mm']:.1f} mm")


def zero_points(rows):
    """Where the field changes its sign between neighbors along a line of the slice or across."""
    found = []
    for lines, moving in ((groups(rows, "across_mm"), "along_mm"), (groups(rows, "along_mm"), "across_mm")):
        for line in lines.values():
            for a, b in zip(line, line[1:]):
                if (a["field_mm"] < 0) != (b["field_mm"] < 0):
                    share = a["field_mm"] / (a["field_mm"] - b["field_mm"])
                    point = dict(a)
                    point[moving] = a[moving] + share * (b[moving] - a[moving])
                    found.append((point["along_mm"], point["across_mm"]))
    return found


def curvature(results):
    rows = results.table("curvature")
    lines = groups(rows, "across_mm")
    heights = sorted(lines)
    widths = [row["along_mm"] for row in lines[heights[0]]]
    half = (heights[1] - heights[0]) / 2
    surface = [Series("implicit surface", zero_points(rows), "#222", marks=True, size=0.9),
               Series("triangles", [(row["along_mm"], row["across_mm"]) for row in results.table("crossings")], "#009e73", marks=True, size=1.3)]
    for column, title, label in (("field_mm", "field", "distance to the surface, mm"), ("field_curvature", "curvature", "curvature of the field, 1/m")):
        sizes = sorted(abs(row[column]) for row in rows)
        reach = sizes[int(0.98 * len(sizes))]
        field = Field([[row[column] for row in lines[y]] for y in heights], (widths[0] - half, widths[-1] + half),
                      (heights[0] - half, heights[-1] + half), label, -reach, reach, about_zero=True)
        results.page.chart(f"figure_5_13_{title}", f"Figure 5.13: {title} around gluteus maximus", "A slice through the muscle's middle, along its most and its least spread; "
                           "the field of the method rbf. Black: where the field is 0; green: where the muscle's triangles are. " +
                           ("Eq. 6.5's 'mean curvature', the Laplacian over three." if title == "curvature" else "It levels off away from the surface."),
                           surface, "along the muscle, mm", "across, mm", field=field, square=True, width=560, height=214)


def gradient(results):
    rows = [row for row in results.table("gradient") if abs(row["by_differences"]) > 0]
    for key, column, remark in (("gradient", "closed_form", "with off-diagonals r_ij r_ik in eq. 6.4"),
                                ("gradient_printed", "without_weight", "eq. 6.12 lacks λ_k, which eq. 6.8 has")):
        results.put(key, statistics.median(row[column] / row["by_differences"] for row in rows), remark)
    descent = results.table("descent")
    results.page.chart("descent", "Chapter 6: descent of the cost", "Centers of gluteus maximus were drawn apart by 10 %; steps down the gradient of eq. 6.10. No figure of the report.",
                       [Series("cost", [(row["steps"], row["cost_share"]) for row in descent])], "steps", "cost over that before", y_range=(0, 1.05))
    results.add("chapter 6", f"cost after {descent[-1]['steps']:.0f} steps over that before", "", descent[-1]["cost_share"], "gluteus maximus, centers drawn apart by 10 %")


def by_frame(rows, column, pick):
    return [(row[0]["frame"], pick([each[column] for each in row])) for row in groups(rows, "frame").values()]


def fibers(folder, muscle):
    """Mean length of the muscle's fibers, mm, over the first coordinate, degrees."""
    with open(f"{folder}/fiber_lengths.sto") as file:
        lines = file.read().split("endheader\n", 1)[1].splitlines()
    columns = lines[0].split("\t")
    which = [i for i, name in enumerate(columns) if name.startswith(muscle + "_f")]
    rows = [[float(cell) for cell in line.split("\t")] for line in lines[1:]]
    return [(row[1], 1000 * sum(row[i] for i in which) / len(which)) for row in rows]


def hip(results):
    runs = {name: read(f"{results.out}/{name}/measures.csv") for name in NAMES}
    runs = {name: rows for name, rows in runs.items() if rows}
    charts = (("volume", "volume_ratio", lambda values: 100 * max((v - 1 for v in values), key=abs), "volume change, %",
               "The muscle with most. The report's model keeps no volume, and says so; 'completed' adds it, bones and weights that follow."),
              ("edges", "edge_ratio_mean", max, "mean edge over rest", "How far surfaces are stretched; the muscle with most."),
              ("cost", "cost", lambda values: log(sum(values)), "log10 of the cost, m", "Eq. 6.6 of all muscles together: as published, it compares with the capture pose's place in space, "
               "which a flexed muscle leaves."))
    for name, column, pick, label, remark in charts:
        shown = [Series(NAMES[run], [p for p in by_frame(rows, column, pick) if column != "cost" or p[1] > -29], COLORS[run])
                 for run, rows in runs.items() if column in rows[0]]
        results.page.chart(f"hip_{name}", f"Chapter 6 on the built-in hip: {name}", remark, shown, "hip flexion, degrees", label)
    for muscle in ("gluteus_maximus_r", "iliacus_r"):
        results.page.chart(f"fibers_{muscle}", f"Fiber lengths: {muscle.replace('_', ' ')}", "Means of a muscle's fibers.",
                           [Series(NAMES[run], fibers(f"{results.out}/{run}", muscle), COLORS[run]) for run in runs], "hip flexion, degrees", "fiber length, mm")
    for run, rows in runs.items():
        last = max(row["frame"] for row in rows)
        worst = max(rows, key=lambda row: abs(row["volume_ratio"] - 1))
        times = [total for _, total in by_frame(rows, "milliseconds", sum)][1:]
        results.add("chapter 6" if run != "pbd" else "section 5.8", f"{NAMES[run]}: largest change of volume through {last:.0f} degrees", "%",
                    100 * abs(worst["volume_ratio"] - 1), f"{worst['muscle']}; frames of {len({row['muscle'] for row in rows})} muscles take {statistics.median(times):.0f} ms")
        if run == "pbd":
            results.put("pbd_volume", 100 * abs(worst["volume_ratio"] - 1), f"{worst['muscle']} of the built-in hip")
    for name, title, remark in (
            ("published", "Chapter 6: rbf-2024", "20, 50 and 90 degrees of flexion: the field has holes where its centers are drawn apart."),
            ("completed", "Chapter 6 completed: rbf", "The same with what this project added."),
            ("pbd", "Section 5.8: pbd-2020", "The same by position based dynamics."),
            ("medius", "Figure 5.4: gluteus medius", "At 90 degrees of flexion, pbd-2020; the published one is a cadaver's."),
            ("iliacus", "Figure 5.8: iliacus and its fibers", "0, 45 and 90 degrees of flexion, pbd-2020; the published one is a cadaver's.")):
        results.page.picture(f"picture_{name}", title, remark, os.path.join(results.out, f"{name}.png"))


def add_to(results):
    for part in (solids, curvature, gradient, hip):
        part(results)
