#!/usr/bin/env python3
"""make.py OUT HERE [--complete]: the page, results.csv and figures from the runs and pictures that run.sh left in OUT."""
import csv
import glob
import json
import os
import re
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "family"))
import publication  # noqa: E402
from charts import COLORS, Series  # noqa: E402

import control  # noqa: E402
from runs import exploded, fibers, mean, measures, poses, settings, worst  # noqa: E402

RUNS = {"passive": ("XPBD, passive", "#d55e00"), "active": ("XPBD, active", "#cc79a7"), "pbd": ("PBD, 3 iterations", "#0072b2")}
EXPLODED = 1.5  # a muscle's edges so many times as long as at rest, in the mean
SAME = {"zero_iteration_threshold": ("contact.contact_distance", "one distance for all iterations"),
        "volume_time_diff": ("settings.time_step", "one time step for all but distances and dihedrals")}


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
        figure = "7.10" if muscle.startswith("gluteus") else "7.11"
        page.chart(f"fibers_{muscle}", f"Figure {figure}: fiber lengths, {muscle.replace('_', ' ')}",
                   "Lengths of 100 fibers: their mean, and from the least to the largest. The published curves have no numbers.", series,
                   "hip flexion, degrees", "fiber length, mm")
    return by_run


def sweeps(page, out):
    """Charts of the sweep, and where muscles first exploded: {(kind, step): {muscle: flexion}}."""
    found = {}
    for kind in ("passive", "active"):
        folders = {1.0: f"{out}/{kind}"}
        folders.update({float(name.rsplit("_", 1)[1]): name for name in glob.glob(f"{out}/sweep/{kind}_*[0-9]")})
        series = []
        for (step, folder), color in zip(sorted(folders.items()), COLORS):
            series.append(Series(f"{step:g}°", worst(folder, "edge_ratio_max_free"), color))
            found[kind, step] = exploded(folder, EXPLODED)
        page.chart(f"sweep_{kind}", f"Section 6.6.2: step of the {kind} flexion",
                   "Worst muscle's longest free edge, by the flexion in a frame.",
                   series, "hip flexion, degrees", "longest free edge over rest")
    return found


def tell_sweeps(found, ours, remarks):
    steps = ", ".join(f"{kind} {step:g}°" for kind, step in found)
    remarks["explosion"] = f"none of the four muscles in steps of {steps}: no muscle's edges {EXPLODED} times as long as at rest in the mean; see " \
                           "the leg's rows for muscles that do"
    first = min((flexion for muscles in found.values() for flexion in muscles.values()), default=None)
    if first is not None:
        ours["explosion"] = first
        remarks["explosion"] = "; ".join(f"{kind} {step:g}°: {', '.join(muscles) or 'none'}" for (kind, step), muscles in found.items())


def corrections(page, out, ours, remarks):
    """Figures 6.4 and 6.5 as curves: how far each kind of constraint moves gluteus maximus in a frame, by `gracilis export --to csv`."""
    by_kind, flexion = {}, [row[0] for row in next(iter(measures(f"{out}/corrections", "volume_ratio").values()))]
    with open(f"{out}/corrections_csv/corrections.csv", newline="") as file:
        for row in csv.DictReader(file):
            by_kind.setdefault(row["kind"], []).append((flexion[int(row["frame"])], float(row["mean_mm"]), float(row["largest_mm"])))
    if flexion[-1] > 80:
        ours["dihedrals_lead"] = max(own[0] for own, held in zip(by_kind["dihedral"], by_kind["bone contact"]) if own[2] <= held[2]) + 1
        remarks["dihedrals_lead"] = "from there on dihedrals move some vertex farther than the bone holds any off, up to " \
                                    f"{max(row[2] for row in by_kind['dihedral']):.0f} mm; the muscle does not explode all the same"
    for column, name, label in ((1, "mean", "mean correction, mm"), (2, "largest", "largest correction, mm")):
        page.chart(f"figure_6_5_{name}", f"Figures 6.4 and 6.5 as curves: {name} corrections by kind", "What each kind of constraint moves vertices of gluteus maximus, "
                   "alone, in its 70 iterations together.",
                   [Series(kind, [(row[0], row[column]) for row in rows]) for kind, rows in by_kind.items() if any(row[2] > 0 for row in rows)],
                   "hip flexion, degrees", label, command="gracilis export OUT/corrections --to csv --out OUT/corrections_csv")


def many_muscles(page, out, ours, remarks):
    """Section 7.2: what explodes at once among 26 muscles, and how the others fare."""
    for stiffness in ("100", "1e5"):
        folder = f"{out}/leg_all_{stiffness}"
        if not os.path.exists(f"{folder}/measures.csv"):
            continue
        found = exploded(folder, EXPLODED)
        ours[f"leg_exploded_{stiffness}"] = f"{len(found)} of 26"
        remarks[f"leg_exploded_{stiffness}"] = ", ".join(found) + "; the shared leg has other muscles than the publication's twenty"
    for name, label in (("leg_published", "published parameters"), ("leg_stiff", "distance stiffness 1e5")):
        if os.path.exists(f"{out}/{name}/measures.csv"):
            page.chart(f"{name}_edges", f"Beside Figure {'7.9' if name == 'leg_published' else '7.8'}: mean edges, {label}",
                       "Muscles that explode at once are left out; one whose curve leaves the chart explodes.",
                       [Series(muscle, rows) for muscle, rows in measures(f"{out}/{name}", "edge_ratio_mean").items()],
                       "hip flexion, degrees", "mean edge over rest", y_range=(0.8, 2), width=480)


def table_6_1(ours, out):
    """The flexion's table: its angles, and which coordinates others keep at 0."""
    flexed = [pose for pose in poses(f"{out}/passive", control.COORDINATES) if pose[1:] == (0.0, 0.0)]
    angles = [pose[0] for pose in flexed]
    ours.update(motion_rows=len(angles), motion_first=angles[0], motion_step=angles[1] - angles[0], motion_last=angles[-1])


def fiber_shares(ours, remarks, out):
    path = f"{out}/fibers.json"
    if not os.path.exists(path):
        return
    with open(path) as file:
        told = json.load(file)
    for muscle in told:
        published = muscle["on_surface"][1]
        ours[f"across_{muscle['muscle']}"] = 100 * published["share_rejected"]
        remarks[f"across_{muscle['muscle']}"] = "of the edges that the nearest vertices' ways take, those more than 60 degrees off the fibers"


def main(out, here, *options):
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
    found = sweeps(page, out)
    ours = {key: float(value) for key, value in settings(f"{out}/passive").items() if isinstance(value, (int, float))}
    with open(f"{out}/config.toml") as file:
        ours["neighbors"] = float(re.search(r"^# neighbors = (\d+)", file.read(), re.MULTILINE)[1])
    remarks = {"resolution_factor": "left out: at 1 it does nothing", "do_not_solve": "a switch for tests that nothing here has"}
    for key, (setting, remark) in SAME.items():
        ours[key], remarks[key] = ours[setting], remark
    if by_run["passive"].get("adductor_brevis_r", [(0, [])])[-1][0] > 80:
        ours["adductor_brevis_shortest"] = min(by_run["passive"]["adductor_brevis_r"], key=lambda row: mean(row[1]))[0]
        remarks["adductor_brevis_shortest"] = "by the mean; its insertion is drawn out from the first degrees on, which lengthens every fiber"
    tell_sweeps(found, ours, remarks)
    corrections(page, out, ours, remarks)
    control.controlled(page, out)
    control.neighbors(page, out)
    active = control.optimized(page, out)
    if active is not None:
        ours["extended_active"], remarks["extended_active"] = active, f"of 43 muscles of the right leg, above {control.ACTIVE}; the knee is as in the walk's first frame"
    many_muscles(page, out, ours, remarks)
    table_6_1(ours, out)
    fiber_shares(ours, remarks, out)
    page.rows = publication.beside(publication.read_published(f"{here}/published.csv"), ours, remarks)
    page.pictures(here)
    if not os.path.isdir(f"{out}/controlled"):
        page.cannot("Activations of Figures 7.1 and 7.4 to 7.6", "the cadaver's hip and OpenSim's walking model (--data)")
    page.cannot("Figures 7.7 to 7.9, A.1 and A.2 with the publication's own muscles", "sixteen muscles of the cadaver that were not published; Z-Anatomy's stand in")
    page.cannot("Numbers of Figures 7.10 and 7.11", "the curves' values: the figures have axes, but the text tells none of them")
    page.write(complete="--complete" in options)


if __name__ == "__main__":
    main(*sys.argv[1:])
