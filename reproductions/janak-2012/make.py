#!/usr/bin/env python3
"""make.py OUT HERE [--complete]: the page, results.csv and figures from the runs in OUT/runs."""
import csv
import glob
import os
import re
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "family"))
import publication  # noqa: E402
from charts import COLORS, Series  # noqa: E402

ONE = "adductor_brevis_r"  # of the cadaver's five muscles the one that is most like the publication's adductor longus
LAYOUTS = ("cubic-6", "cubic-26", "delaunay", "nearest")


class Runs:
    """Of each run the last frame's rows, one per muscle, by its name."""

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

    def of(self, name, muscle, column):
        return next(float(row[column]) for row in self.last[name] if row["muscle"] == muscle)

    def seconds(self, name):
        return self.total(name, "milliseconds") / 1000

    def curves(self, kind, value):
        """Points (iterations, value) of runs KIND_WHAT_ITERATIONS, by WHAT."""
        found = {}
        for name in self.last:
            match = re.fullmatch(rf"{kind}_([^_]+)_(\d+)", name)
            if match:
                found.setdefault(match[1], []).append((int(match[2]), value(name)))
        return {what: sorted(points) for what, points in sorted(found.items())}

    def by_muscle(self, kind, column, factor=1):
        """{muscle: [(iterations, value)]} of runs KIND_ITERATIONS."""
        found = {}
        for name, rows in self.last.items():
            match = re.fullmatch(rf"{kind}_(\d+)", name)
            for row in rows if match else []:
                found.setdefault(row["muscle"], []).append((int(match[1]), factor * float(row[column])))
        return {muscle: sorted(points) for muscle, points in found.items()}


def slope(points):
    """How fast the displacement falls, mm per iteration, by the line of least squares."""
    x, y = sum(p[0] for p in points) / len(points), sum(p[1] for p in points) / len(points)
    return -sum((p[0] - x) * (p[1] - y) for p in points) / sum((p[0] - x) ** 2 for p in points)


def settled(points):
    late = [point for point in points if point[0] >= 100]
    return late if len(late) > 1 else points


def regression(points):
    fall = slope(points)
    x, y = sum(p[0] for p in points) / len(points), sum(p[1] for p in points) / len(points)
    return [(p, y - fall * (p - x)) for p in (points[0][0], points[-1][0])]


def convergence(page, runs, ours, remarks):
    """Figures 5.3 to 5.5."""
    mean = lambda name: runs.mean(name, "displacement_mm")  # noqa: E731
    one = lambda name: runs.of(name, ONE, "displacement_mm")  # noqa: E731
    for layout in LAYOUTS:
        muscles = runs.by_muscle(f"layout_{layout}", "displacement_mm")
        page.chart(f"figure_5_3_{layout}", f"Figure 5.3: displacements, {layout}", "Mean motion of a muscle's particles in the last of so many iterations, the cadaver's five muscles.",
                   [Series(muscle.replace("_", " "), points) for muscle, points in muscles.items()], "iterations", "mean displacement, mm")
    for kind, name, title in (("layout", "figure_5_4", "Figure 5.4: one muscle, by layout"), ("neighbors", "figure_5_5", "Figure 5.5: one muscle, by number of neighbors")):
        late = {what: settled(points) for what, points in runs.curves(kind, one).items()}
        series = []
        for (what, points), color in zip(late.items(), COLORS):
            series += [Series(f"{what}: {1e6 * slope(points):.3g} nm per iteration", points, color), Series("", regression(points), color, dash=True)]
        page.chart(name, title, "Adductor brevis, from iteration 100 on, and lines of least squares; the published one is adductor longus.", series, "iterations", "mean displacement, mm")
        if kind == "layout":
            for key, what in (("slope_ratio", "cubic-26"), ("slope_ratio_nearest", "nearest")):
                ours[key] = slope(late[what]) / slope(late["cubic-6"]) if what in late else None
                remarks[key] = "of adductor brevis, from iteration 100 on; the publication fits a part of its curves"
    curves = runs.curves("layout", mean)
    page.chart("layouts", "Beside Figure 5.4: all muscles, by layout", "Mean motion of a particle in the last iteration.",
               [Series(what, points) for what, points in curves.items()], "iterations", "mean displacement, mm")
    for what, points in curves.items():
        if points[-1][0] == 1500:
            ours[f"time_{what}"] = runs.seconds(f"layout_{what}_1500")
            remarks[f"time_{what}"] = "five muscles, one thread of this machine; published: thirteen, one of 2006"


def time_steps(page, runs, ours):
    """Figures 5.9 to 5.11."""
    told = {"0.4": ("5.9", "steps of 0.4 s"), "adaptive": ("5.10", "adaptive steps of 0.04 s at least"), "0.7": ("5.11", "steps of 0.7 s, cut to where Verlet's scheme is stable")}
    for prefix, where in (("leg_", "the walking model's thigh"), ("", "the cadaver's hip")):
        for kind, (figure, what) in told.items():
            muscles = runs.by_muscle(f"{prefix}step_{kind}", "length_changes_mm", 0.001)
            page.chart(f"figure_{figure.replace('.', '_')}_{prefix or 'hip_'}curves", f"Figure {figure}: {what}, {where}", "Sum of a muscle's springs' changes of length.",
                       [Series(muscle.replace("_", " "), points) for muscle, points in muscles.items()], "iterations", "changes of length, m")
    steps = runs.curves("step", lambda name: runs.total(name, "length_changes_mm") / 1000)
    page.chart("figure_5_9", "Figures 5.9 to 5.11 together: time steps", "Sum of all springs' changes of length, the cadaver's five muscles.",
               [Series(what, points) for what, points in steps.items()], "iterations", "changes of length, m")
    adaptive = sorted((name for name in runs.last if name.startswith("step_adaptive_")), key=lambda name: int(name.rsplit("_", 1)[1]))
    ours["adaptive_step"] = runs.mean(adaptive[-1], "verlet_step_s")


def collisions(runs, ours, remarks):
    """Table 5.1: what a kind of collision adds to the springs alone."""
    for prefix, where in (("", "the cadaver's hip"), ("leg_", "the walking model's thigh")):
        if f"{prefix}springs_70" not in runs:
            continue
        springs = runs.seconds(f"{prefix}springs_70")
        for key in ("rebuilt", "refitted", "of_muscles", "of_bones"):
            ours[f"{prefix}{key}"] = runs.seconds(f"{prefix}{key}") - springs
            remarks[f"{prefix}{key}"] = f"{where}; all less springs alone, one thread of this machine"
        ours[f"{prefix}refit_gain"] = 100 * (1 - ours[f"{prefix}refitted"] / ours[f"{prefix}rebuilt"])
        remarks[f"{prefix}refit_gain"] = f"{where}; within what times differ from pass to pass"


def resolutions(page, runs, ours, remarks):
    """Tables 5.2 and 5.3, Figures 5.17 and 5.18."""
    found = {}
    for name in runs.last:
        match = re.fullmatch(r"(resolution|leg_at_([\d.]+))_(\d+)", name)
        if match:
            found.setdefault(match[2] or "hip", []).append((int(match[3]), name, name.replace(f"_{match[3]}", f"_alone_{match[3]}")))
    springs, detected = [], []
    for where, rows in sorted(found.items()):
        spent = []
        for each, name, alone in sorted(rows):
            seconds = runs.seconds(name) - runs.seconds(alone)
            boundary, particles = runs.total(name, "boundary_particles"), runs.total(name, "particles")
            spent.append((boundary, seconds))
            if where == "hip":
                springs.append((particles, runs.seconds(alone)))
                continue
            ours[f"at_{where}_{each}"] = seconds
            remarks[f"at_{where}_{each}"] = f"{where} s of the walk"
            for row in runs.last[name]:
                remarks[f"boundary_{row['muscle']}_{each}"] = "particles with a vertex of their own; imported surfaces have some 500 vertices"
                ours[f"boundary_{row['muscle']}_{each}"], ours[f"particles_{row['muscle']}_{each}"] = float(row["boundary_particles"]), float(row["particles"])
        detected.append(Series("the cadaver's hip" if where == "hip" else f"thigh, {where} s of the walk", spent))
    instants = [where for where in found if where != "hip"]
    for each in (20, 40, 60, 80):
        of = [ours[f"at_{where}_{each}"] for where in instants if f"at_{where}_{each}" in ours]
        if of:
            ours[f"collisions_{each}"] = sum(of) / len(of)
            remarks[f"collisions_{each}"] = f"mean of {len(of)} instants of the walk; one thread of this machine"
            for kind in ("boundary", "particles"):
                ours[f"{kind}_{each}"] = sum(value for key, value in ours.items() if re.fullmatch(rf"{kind}_.+_{each}", key))
    if "collisions_80" in ours and ours["collisions_20"] > 0:
        ours["growth_collisions"] = ours["collisions_80"] / ours["collisions_20"]
        ours["growth_particles"] = ours["particles_80"] / ours["particles_20"]
    page.chart("figure_5_17", "Figure 5.17: time of collisions", "100 iterations, by how many particles take part in them.", detected, "boundary particles", "time, s")
    page.chart("figure_5_18", "Figure 5.18: time of springs", "100 iterations; 64 fibers a muscle, the cadaver's five.", [Series("springs", springs)], "particles", "time, s")


def main(out, here, *options):
    runs, ours, remarks = Runs(f"{out}/runs"), {}, {}
    page = publication.Page(
        out, "Mass-spring systems (Janák 2012)",
        "The publication has thirteen muscles of a thigh in a walk (data set of VPHOP, not public). Here the five muscles of the cadaver's hip are turned "
        "from the scan's pose to 60 degrees of flexion at once, and thirteen imported muscles of the same names from their default pose to a walk's, as the publication turns "
        "its own, by the preset <code>janak-2012</code>. Times are of one thread; published ones of a processor of 2006.", "reproductions/janak-2012/run.sh")
    convergence(page, runs, ours, remarks)
    time_steps(page, runs, ours)
    collisions(runs, ours, remarks)
    resolutions(page, runs, ours, remarks)
    page.rows = publication.beside(publication.read_published(f"{here}/published.csv"), {key: value for key, value in ours.items() if value is not None}, remarks)
    page.pictures(here)
    if not os.path.isdir(f"{out}/leg"):
        page.cannot("Tables 5.2 and 5.3 of a thigh", "OpenSim's walking model (--data)")
    page.cannot("Figure 5.1: fourteen frames of the testing data", "the walk of the VPHOP data set")
    page.cannot("Figure 5.13, and the lower half of 5.14: the PK method", "LHPBuilder's other method, which was not published with the thesis")
    page.cannot("Figures 5.3, 5.9 to 5.12 and 5.15 to 5.18 of the publication's own muscles", "the VPHOP data set; an imported thigh of the same muscles stands in")
    page.write(complete="--complete" in options)


if __name__ == "__main__":
    main(*sys.argv[1:])
