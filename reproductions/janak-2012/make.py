#!/usr/bin/env python3
"""make.py OUT HERE: the page, results.csv and figures from the runs in OUT/runs."""
import csv
import glob
import os
import re
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "family"))
import publication  # noqa: E402
from charts import Series  # noqa: E402


class Runs:
    """Of each run the sums over the muscles of the last frame, by its name."""

    def __init__(self, folder):
        self.last = {}
        for path in glob.glob(f"{folder}/*/measures.csv"):
            with open(path, newline="") as file:
                table = list(csv.DictReader(file))
            frame = table[-1]["frame"]
            self.last[os.path.basename(os.path.dirname(path))] = [row for row in table if row["frame"] == frame]

    def __contains__(self, name):
        return name in self.last

    def total(self, name, column):
        return sum(float(row[column]) for row in self.last[name])

    def mean(self, name, column):
        return self.total(name, column) / len(self.last[name])

    def curves(self, kind, value):
        """Points (iterations, value) of runs KIND_WHAT_ITERATIONS, by WHAT."""
        found = {}
        for name in self.last:
            match = re.fullmatch(rf"{kind}_(.+)_(\d+)", name)
            if match:
                found.setdefault(match[1], []).append((int(match[2]), value(name)))
        return {what: sorted(points) for what, points in sorted(found.items())}


def slope(points):
    """How fast the displacement falls, mm per iteration, over the iterations that both ends of the curve have."""
    (first, high), (last, low) = points[0], points[-1]
    return (high - low) / (last - first)


def main(out, here):
    runs, ours, remarks = Runs(f"{out}/runs"), {}, {}
    page = publication.Page(
        out, "Mass-spring systems (Janák 2012)",
        "The publication has thirteen muscles of a thigh in a walk (data set of VPHOP, not public). Here the five muscles of the cadaver's hip are turned "
        "from the scan's pose to 60 degrees of flexion at once, as the publication turns its own, by the preset <code>janak-2012</code>. "
        "Times are of one thread; published ones of a processor of 2006.", "reproductions/janak-2012/run.sh")
    displacement = lambda name: runs.mean(name, "displacement_mm")  # noqa: E731
    for kind, figure, title in (("layout", "figure_5_3", "Figures 5.3 and 5.4: layouts of springs"),
                                ("neighbors", "figure_5_5", "Figure 5.5: numbers of neighbors")):
        curves = runs.curves(kind, displacement)
        page.chart(figure, title, "Mean motion of a particle in the last iteration.",
                   [Series(what, points) for what, points in curves.items()], "iterations", "mean displacement, mm")
        if kind == "layout":
            for what, points in curves.items():
                count = points[-1][0]
                if count == 1500:
                    ours[f"time_{what}"] = runs.total(f"layout_{what}_{count}", "milliseconds") / 1000
            for key, what in (("slope_ratio", "cubic-26"), ("slope_ratio_nearest", "nearest")):
                if what in curves:
                    ours[key] = slope(curves[what]) / slope(curves["cubic-6"])
                    remarks[key] = "over all iterations shown; the publication's line goes through a part of them"
    steps = runs.curves("step", lambda name: runs.total(name, "length_changes_mm") / 1000)
    page.chart("figure_5_9", "Figures 5.9 to 5.11: time steps", "Sum of all springs' changes of length: 0.4 s, 0.7 s (cut to where Verlet's scheme is "
               "stable, without which it bursts), and adaptive steps of 0.04 s at least.",
               [Series(what, points) for what, points in steps.items()], "iterations", "changes of length, m")
    adaptive = sorted((name for name in runs.last if name.startswith("step_adaptive_")), key=lambda name: int(name.rsplit("_", 1)[1]))
    ours["adaptive_step"] = runs.mean(adaptive[-1], "verlet_step_s")
    springs = runs.total("springs_70", "milliseconds")
    for key in ("rebuilt", "refitted"):
        ours[key] = (runs.total(key, "milliseconds") - springs) / 1000
        remarks[key] = "all less springs alone"
    ours["refit_gain"] = 100 * (1 - ours["refitted"] / ours["rebuilt"])
    collisions, alone = [], []
    for name in runs.last:
        match = re.fullmatch(r"resolution_(\d+)", name)
        if match:
            each = int(match[1])
            without = runs.total(f"resolution_alone_{each}", "milliseconds")
            ours[f"collisions_{each}"] = (runs.total(name, "milliseconds") - without) / 1000
            collisions.append((each, ours[f"collisions_{each}"]))
            alone.append((each, without / 1000))
    page.chart("figure_5_17", "Figures 5.17 and 5.18: particles per fiber", "Time of 100 iterations; 64 fibers a muscle.",
               [Series("collisions", sorted(collisions)), Series("springs", sorted(alone))], "particles per fiber", "time, s")
    if "collisions_80" in ours and ours["collisions_20"] > 0:
        ours["growth_collisions"] = ours["collisions_80"] / ours["collisions_20"]
    page.rows = publication.beside(publication.read_published(f"{here}/published.csv"), ours, remarks)
    page.cannot("Figures 5.1, 5.2 and 5.8", "the walk of the VPHOP data set")
    page.cannot("Figures 5.6, 5.7, 5.12 to 5.16 as pictures", "the same thigh; gracilis render draws OUT/runs")
    page.cannot("Table 5.2 by muscle", "the same thigh; here a muscle has as many particles as its fibers ask for")
    page.write()


if __name__ == "__main__":
    main(*sys.argv[1:3])
