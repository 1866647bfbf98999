#!/usr/bin/env python3
"""make.py OUT HERE: the page, results.csv and figures from the runs OUT/passive, OUT/active, OUT/pbd,
OUT/sweep/* and OUT/controlled/*, and OUT/samples.sto."""
import csv
import glob
import json
import math
import os
import re
import sys
import tomllib

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "family"))
import publication  # noqa: E402
from charts import COLORS, Series  # noqa: E402

RUNS = {"passive": ("XPBD, passive", "#d55e00"), "active": ("XPBD, active", "#cc79a7"), "pbd": ("PBD, 3 iterations", "#0072b2")}
MOTIONS = {"flexion": ("hip_flexion_r", "7.1"), "extension": ("hip_flexion_r", "7.4"), "abduction": ("hip_adduction_r", "7.5"),
           "rotation": ("hip_rotation_r", "7.6")}
SHOWN = {"flexion": "20, 50 and 90 degrees.", "extension": "10, 30 and 40 degrees.", "abduction": "10, 35 and 45 degrees.",
         "rotation": "15, 45 and 60 degrees inwards."}
COORDINATES = ["hip_flexion_r", "hip_adduction_r", "hip_rotation_r"]
EXPLODED = 1.5  # a muscle's edges so many times as long as at rest, in the mean


def settings(folder):
    """What a run's first muscle had, by the keys of published.csv."""
    with open(f"{folder}/run.json") as file:
        text = tomllib.loads(json.load(file)["settings"])
    muscle = text["muscles"][0]
    found = {f"{part}.{key}": value for part in ("settings", "contraction", "fibers") for key, value in muscle[part].items()}
    found.update({f"{part}.{key}": value for part in ("contact", "distance_field") for key, value in text[part].items()})
    return found


def fibers(folder):
    """Of each muscle its fibers' lengths, m, over the first coordinate, degrees: {muscle: [(angle, [length, ...])]}."""
    columns, rows = publication.sto_rows(f"{folder}/fiber_lengths.sto")
    found = {}
    for row in rows:
        by_muscle = {}
        for name, value in zip(columns, row):
            if name.rsplit("_f", 1)[-1].isdigit() and "_f" in name:
                by_muscle.setdefault(name.rsplit("_f", 1)[0], []).append(value)
        for muscle, lengths in by_muscle.items():
            found.setdefault(muscle, []).append((row[1], lengths))
    return found


def mean(values):
    return sum(values) / len(values)


def measures(folder, column, coordinate="hip_flexion_r"):
    """{muscle: [(coordinate, value)]}, the coordinate in degrees."""
    found = {}
    with open(f"{folder}/measures.csv", newline="") as file:
        for row in csv.DictReader(file):
            found.setdefault(row["muscle"], []).append((float(row[f"{coordinate}_deg"]), float(row[column])))
    return found


def poses(folder):
    """The joint's angles of each frame, degrees."""
    with open(f"{folder}/measures.csv", newline="") as file:
        rows = {row["frame"]: tuple(float(row[f"{name}_deg"]) for name in COORDINATES) for row in csv.DictReader(file)}
    return list(rows.values())


def worst(folder, column):
    """[(flexion, value)] of the muscle whose value is farthest from 1 there."""
    rows = {}
    for number, row in enumerate(zip(*measures(folder, column).values())):
        rows[number] = max(row, key=lambda point: abs(point[1] - 1))
    return list(rows.values())


def fiber_charts(page, out):
    by_run = {name: fibers(f"{out}/{name}") for name in RUNS}
    for muscle in sorted(by_run["passive"]):
        series = []
        for name, (label, color) in RUNS.items():
            rows = by_run[name][muscle]
            low = [(angle, 1000 * min(lengths)) for angle, lengths in rows]
            high = [(angle, 1000 * max(lengths)) for angle, lengths in rows]
            series += [Series(label, low, color, band=high),
                       Series(label, [(angle, 1000 * mean(lengths)) for angle, lengths in rows], color)]
        page.chart(f"fibers_{muscle}", f"As Figures 7.10 and 7.11: {muscle.replace('_', ' ')}",
                   "Lengths of 100 fibers: their mean, and from the least to the largest.", series, "hip flexion, degrees", "fiber length, mm")
    return by_run


def sweeps(page, out):
    """Charts of the sweep, and where a muscle first exploded, if one did: {(kind, step): (flexion, muscle) or None}."""
    found = {}
    for kind in ("passive", "active"):
        folders = {1.0: f"{out}/{kind}"}
        folders.update({float(name.rsplit("_", 1)[1]): name for name in glob.glob(f"{out}/sweep/{kind}_*[0-9]")})
        series = []
        for (step, folder), color in zip(sorted(folders.items()), COLORS):
            series.append(Series(f"{step:g}°", worst(folder, "edge_ratio_max_free"), color))
            over = [(flexion, muscle) for muscle, rows in measures(folder, "edge_ratio_mean").items()
                    for flexion, value in rows if value > EXPLODED]
            found[kind, step] = min(over, default=None)
        page.chart(f"sweep_{kind}", f"Section 6.6.2: step of the {kind} flexion",
                   "Worst muscle's longest free edge, by the flexion in a frame.",
                   series, "hip flexion, degrees", "longest free edge over rest")
    return found


def controlled(page, out):
    """Figures of the motions by the joint control unit: what it says of each muscle, and shapes."""
    for motion, (coordinate, figure) in MOTIONS.items():
        for preset in ("thesis-2024", "physical"):
            folder = f"{out}/controlled/{motion}_{preset}"
            if not os.path.exists(f"{folder}/measures.csv"):
                continue
            for column, label in (("activation", "activation"), ("volume_ratio", "volume over rest")):
                series = [Series(muscle.replace("_", " "), rows) for muscle, rows in sorted(measures(folder, column, coordinate).items())]
                page.chart(f"{motion}_{preset}_{column}", f"As Figure {figure}: {motion} by the joint control unit, {preset}",
                           "Static optimization's samples, as the unit answers." if column == "activation" else "From the capture pose on.",
                           series, f"{coordinate.replace('_', ' ')}, degrees", label)
            page.picture(f"{motion}_{preset}", f"As Figure {figure}: {motion} by the joint control unit, {preset}",
                         SHOWN[motion], f"{folder}.png")


def neighbors(page, out, count):
    """Section 6.5.1: the samples, and those that are among the `count` nearest of some frame of a motion."""
    if not os.path.exists(f"{out}/samples.sto"):
        return
    columns, rows = publication.sto_rows(f"{out}/samples.sto")
    places = [columns.index(name) for name in COORDINATES]
    samples = sorted({tuple(row[i] for i in places) for row in rows})
    for motion in MOTIONS:
        folder = f"{out}/controlled/{motion}_thesis-2024"
        if not os.path.exists(f"{folder}/measures.csv"):
            continue
        asked, used = poses(folder), set()
        for pose in asked:
            used.update(sorted(samples, key=lambda sample: math.dist(sample, pose))[:count])
        for across in (1, 2):
            def flat(points):
                return [(point[0], point[across]) for point in points]
            page.chart(f"neighbors_{motion}_{COORDINATES[across]}", f"Section 6.5.1: samples and neighbors, {motion}",
                       f"{len(used)} of {len(samples)} samples are among the {count} nearest of some frame.",
                       [Series("samples", flat(samples), "#bbbbbb", marks=True), Series("neighbors used", flat(sorted(used)), "#0072b2", marks=True),
                        Series("the motion", flat(asked), "#d55e00")],
                       "hip flexion, degrees", f"{COORDINATES[across].replace('_', ' ')}, degrees")


def main(out, here):
    page = publication.Page(
        out, "Extended position based dynamics (Havlíček 2024)",
        "Flexion of a hip by the preset <code>thesis-2024</code>, passive and active, beside <code>pbd-2020</code>. The publication's fiber lengths "
        "are curves without numbers: what its text says of them stands in the table.", "reproductions/havlicek-2024/run.sh")
    by_run = fiber_charts(page, out)
    page.chart("volume_error", "Volume of the worst muscle", "The published compliance of the volume is 0.",
               [Series(label, [(angle, 100 * (value - 1)) for angle, value in worst(f"{out}/{name}", "volume_ratio")], color)
                for name, (label, color) in RUNS.items()], "hip flexion, degrees", "volume error, %")
    page.chart("longest_edge", "Longest free edge of the worst muscle", "Where a muscle explodes, edges show it first.",
               [Series(label, worst(f"{out}/{name}", "edge_ratio_max_free"), color) for name, (label, color) in RUNS.items()],
               "hip flexion, degrees", "longest free edge over rest")
    exploded = sweeps(page, out)
    for name, (label, _) in RUNS.items():
        for view, figure in (("anterior", "7.1 and A.5"), ("lateral", "A.6")):
            page.picture(f"{name}_{view}", f"As Figures {figure}: {label}, {view}", "20, 50 and 90 degrees of flexion.", f"{out}/{name}_{view}.png")
    ours = {key: float(value) for key, value in settings(f"{out}/passive").items() if isinstance(value, (int, float))}
    with open(f"{out}/config.toml") as file:
        ours["neighbors"] = float(re.search(r"^# neighbors = (\d+)", file.read(), re.MULTILINE)[1])
    remarks = {"resolution_factor": "left out: at 1 it does nothing"}
    if by_run["passive"].get("adductor_brevis_r", [(0, [])])[-1][0] > 80:
        ours["adductor_brevis_shortest"] = min(by_run["passive"]["adductor_brevis_r"], key=lambda row: mean(row[1]))[0]
    first = min((at for at in exploded.values() if at), default=None)
    steps = ", ".join(f"{kind} {step:g}°" for kind, step in exploded)
    remarks["explosion"] = f"none in steps of {steps}: no muscle's edges {EXPLODED} times as long as at rest in the mean"
    if first:
        ours["explosion"] = first[0]
        remarks["explosion"] = "; ".join(f"{kind} {step:g}°: {at[1]} at {at[0]:.0f}" if at else f"{kind} {step:g}°: none"
                                         for (kind, step), at in exploded.items())
    page.rows = publication.beside(publication.read_published(f"{here}/published.csv"), ours, remarks)
    controlled(page, out)
    neighbors(page, out, int(ours["neighbors"]))
    if not os.path.isdir(f"{out}/controlled"):
        page.cannot("Figures 7.4 to 7.6 and A.7 to A.14: extension, abduction and rotation by the joint control unit", "the cadaver's hip and "
                    "OpenSim's walking model (--data)")
    page.cannot("Figures A.7 to A.14: the other views of those motions", "nothing: gracilis render OUT/controlled/MOTION_thesis-2024 --view VIEW")
    page.cannot("Figures A.3 and A.4: surface fibers used for verification", "nothing: gracilis render OUT/passive --frames 0 --fibers")
    page.cannot("Figures 6.4 and 6.5: what constraints move in each iteration", "gracilis view draws it of a live scene; runs do not hold it")
    page.cannot("Figures 7.7 to 7.9, A.1 and A.2: a hip and leg with twenty muscles", "the publication's set of muscles")
    page.cannot("Figures 7.2 and 7.3, of the publication of 2020", "see reproductions/cervenka-kohout-2020")
    page.cannot("Figures 6.1 to 6.3 and 6.6: pictures of flaws", "the publication's muscles")
    page.write()


if __name__ == "__main__":
    main(*sys.argv[1:3])
