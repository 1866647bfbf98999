#!/usr/bin/env python3
"""make.py OUT HERE: the page, results.csv and figures from the runs OUT/xpbd and OUT/pbd."""
import csv
import json
import os
import re
import sys
import tomllib

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "family"))
import publication  # noqa: E402
from charts import Series  # noqa: E402

COLORS = {"xpbd": "#d55e00", "pbd": "#0072b2"}
NAMES = {"xpbd": "XPBD, 70 iterations", "pbd": "PBD, 3 iterations"}


def settings(folder):
    """What a run's first muscle had, by the keys of published.csv."""
    with open(f"{folder}/run.json") as file:
        text = tomllib.loads(json.load(file)["settings"])
    muscle = text["muscles"][0]
    found = {f"{part}.{key}": value for part in ("settings", "contraction") for key, value in muscle[part].items()}
    found.update({f"{part}.{key}": value for part in ("contact", "distance_field") for key, value in text[part].items()})
    return found


def fibers(folder):
    """Of each muscle its fibers' lengths, m, over the first coordinate, degrees: {muscle: [(angle, [length, ...])]}."""
    with open(f"{folder}/fiber_lengths.sto") as file:
        lines = file.read().split("endheader\n", 1)[1].splitlines()
    columns = lines[0].split("\t")
    found = {}
    for line in lines[1:]:
        row = [float(cell) for cell in line.split("\t")]
        by_muscle = {}
        for name, value in zip(columns, row):
            if name.rsplit("_f", 1)[-1].isdigit() and "_f" in name:
                by_muscle.setdefault(name.rsplit("_f", 1)[0], []).append(value)
        for muscle, lengths in by_muscle.items():
            found.setdefault(muscle, []).append((row[1], lengths))
    return found


def measures(folder, column):
    """{muscle: [(frame, value)]}"""
    found = {}
    with open(f"{folder}/measures.csv", newline="") as file:
        for row in csv.DictReader(file):
            found.setdefault(row["muscle"], []).append((int(row["frame"]), float(row[column])))
    return found


def main(out, here):
    page = publication.Page(
        out, "Extended position based dynamics (Havlíček 2024)",
        "Flexion of the built-in hip by the preset <code>thesis-2024</code> beside <code>pbd-2020</code>. The publication's fiber lengths are "
        "curves of a cadaver without numbers, so that only its parameters stand in the table.", "reproductions/havlicek-2024/run.sh")
    by_method = {name: fibers(f"{out}/{name}") for name in NAMES}
    for muscle in sorted(by_method["xpbd"]):
        series = []
        for name, color in COLORS.items():
            rows = by_method[name][muscle]
            low = [(angle, 1000 * min(lengths)) for angle, lengths in rows]
            high = [(angle, 1000 * max(lengths)) for angle, lengths in rows]
            mean = [(angle, 1000 * sum(lengths) / len(lengths)) for angle, lengths in rows]
            series += [Series("", low, color, band=high), Series(NAMES[name], mean, color)]
        page.chart(f"fibers_{muscle}", f"As Figures 7.10 and 7.11: {muscle.replace('_', ' ')}",
                   "Lengths of 15 fibers: their mean, and from the least to the largest.", series, "hip flexion, degrees", "fiber length, mm")
    for column, label in (("volume_ratio", "volume over rest"), ("edge_ratio_max_free", "longest free edge over rest")):
        worst = {}
        for name in NAMES:
            frames = {}
            for rows in measures(f"{out}/{name}", column).values():
                for frame, value in rows:
                    old = frames.get(frame, 1)
                    frames[frame] = value if abs(value - 1) > abs(old - 1) else old
            worst[name] = sorted(frames.items())
        page.chart(column, f"Worst muscle: {label}", "Where a muscle explodes, edges show it first.",
                   [Series(NAMES[name], worst[name], COLORS[name]) for name in NAMES], "frame (1 degree each)", label)
    page.picture("xpbd", "As Figure 7.1: XPBD", "20, 50 and 90 degrees of flexion.", f"{out}/xpbd.png")
    page.picture("pbd", "The same by PBD", "Preset pbd-2020.", f"{out}/pbd.png")
    ours = {key: float(value) for key, value in settings(f"{out}/xpbd").items() if isinstance(value, (int, float))}
    with open(f"{out}/config.toml") as file:
        ours["neighbors"] = float(re.search(r"^# neighbors = (\d+)", file.read(), re.MULTILINE)[1])
    remarks = {"resolution_factor": "left out: at 1 it does nothing", "neighbors": "as print-config has it; this hip has no [[joint_control_units]]"}
    page.rows = publication.beside(publication.read_published(f"{here}/published.csv"), ours, remarks)
    page.cannot("Figures 7.1 to 7.9 and A.1 to A.14 of a hip and leg with all muscles", "the publication's set of muscles; of the cadaver's five "
                "scenes/lhdl_hip/flexion_thesis_2024.toml runs, which takes minutes")
    page.cannot("Figures 7.10 and 7.11 with contraction", "activations, which the built-in hip has none of; a sweep of step sizes for explosions")
    page.cannot("Figures 6.1 to 6.6: pictures of flaws", "the publication's muscles")
    page.write()


if __name__ == "__main__":
    main(*sys.argv[1:3])
