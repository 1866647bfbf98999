"""Motions driven by the joint control unit, what it asks, and what static optimization says (sections 6.5, 6.6.4 and 7.1)."""
import csv
import os

import publication
from charts import Series
from runs import measures, poses

MOTIONS = {"flexion": ("hip_flexion_r", "7.1"), "extension": ("hip_flexion_r", "7.4"), "abduction": ("hip_adduction_r", "7.5"),
           "rotation": ("hip_rotation_r", "7.6")}
COORDINATES = ["hip_flexion_r", "hip_adduction_r", "hip_rotation_r"]
ACTIVE = 0.3  # at 40 degrees of extension, to have a curve of its own


def controlled(page, out):
    """What the unit says of each muscle, and what becomes of its volume."""
    for motion, (coordinate, figure) in MOTIONS.items():
        for preset in ("thesis-2024", "physical"):
            folder = f"{out}/controlled/{motion}_{preset}"
            if not os.path.exists(f"{folder}/measures.csv"):
                continue
            for column, label in (("activation", "activation"), ("volume_ratio", "volume error, %")):
                told = {muscle: [(angle, 100 * (value - 1) if column == "volume_ratio" else value) for angle, value in rows]
                        for muscle, rows in measures(folder, column, coordinate).items()}
                reach = max([0.1] + [abs(value) for rows in told.values() for _, value in rows])
                series = [Series(muscle.replace("_", " "), rows) for muscle, rows in sorted(told.items())]
                page.chart(f"{motion}_{preset}_{column}", f"Beside Figure {figure}: {motion} by the joint control unit, {preset}",
                           "Static optimization's samples, as the unit answers." if column == "activation" else "From the capture pose on.",
                           series, f"{coordinate.replace('_', ' ')}, degrees", label,
                           y_range=(-1.1 * reach, 1.1 * reach) if column == "volume_ratio" else (0, 1.05))


def neighbors(page, out):
    """Section 6.5.1: the samples, and those that the unit asks in some frame of a motion, as `gracilis activations neighbors` tells."""
    for motion in MOTIONS:
        table = f"{out}/neighbors/{motion}/neighbors.csv"
        if not os.path.exists(table):
            continue
        with open(table, newline="") as file:
            rows = [[float(row[f"{name}_deg"]) for name in COORDINATES] + [float(row["poses"])] for row in csv.DictReader(file)]
        asked = poses(f"{out}/controlled/{motion}_thesis-2024", COORDINATES)
        used = [row for row in rows if row[3] > 0]
        for across in (1, 2):
            def flat(points):
                return [(point[0], point[across]) for point in points]
            page.chart(f"neighbors_{motion}_{COORDINATES[across]}", f"Section 6.5.1: samples and neighbors, {motion}",
                       f"{len(used)} of {len(rows)} samples are asked in some frame.",
                       [Series("samples", flat(rows), "#bbbbbb", marks=True), Series("neighbors used", flat(used), "#0072b2", marks=True),
                        Series("the motion", flat(asked), "#d55e00")],
                       "hip flexion, degrees", f"{COORDINATES[across].replace('_', ' ')}, degrees",
                       command="gracilis activations neighbors OUT/samples.sto OUT/controlled/%s_thesis-2024 --out OUT/neighbors/%s" % (motion, motion))


def optimized(page, out):
    """Figure 6.6: muscles that static optimization makes active in 40 degrees of extension, and how many there are."""
    name = f"{out}/activations/hip_r_hip_flexion_r.sto"
    if not os.path.exists(name):
        return None
    columns, rows = publication.sto_rows(name)
    coordinates, motion = publication.sto_rows(f"{out}/motions/hip_r_hip_flexion_r.mot")
    at = coordinates.index("hip_flexion_r")
    angles = {round(row[0], 6): row[at] for row in motion}
    series = []
    for i, muscle in enumerate(columns):
        if muscle.endswith("_r") and rows[0][i] > ACTIVE:
            series.append(Series(muscle, [(angles[round(row[0], 6)], row[i]) for row in rows if angles[round(row[0], 6)] <= 10]))
    page.chart("figure_6_6_curves", "Figure 6.6 as curves: activations toward extension", f"Those above {ACTIVE} at 40 degrees of extension, by static "
               "optimization of OpenSim's walking model.", series, "hip flexion, degrees", "activation")
    return len(series)
