"""Motions driven by the joint control unit, what it asks, and what static optimization says (sections 6.5, 6.6.4 and 7.1)."""
import os

import runs
from charts import Series, lines

MOTIONS = {"flexion": ("hip_flexion_r", "7.1"), "extension": ("hip_flexion_r", "7.4"), "abduction": ("hip_adduction_r", "7.5"),
           "rotation": ("hip_rotation_r", "7.6")}
COORDINATES = ["hip_flexion_r", "hip_adduction_r", "hip_rotation_r"]
ACTIVE = 0.3  # at 40 degrees of extension, to have a curve of its own


def poses(folder):
    """The joint's angles of each frame, degrees."""
    frames = runs.groups(runs.measures(folder), "frame")
    return [tuple(table[0][f"{name}_deg"] for name in COORDINATES) for table in frames.values()]


def controlled(page):
    """What the unit says of each muscle, and what becomes of its volume."""
    if not os.path.isdir(f"{page.out}/controlled"):
        page.cannot("Activations of Figures 7.1 and 7.4 to 7.6", "the cadaver's hip and OpenSim's walking model (--data)")
        return
    for (motion, preset), run in runs.named(f"{page.out}/controlled", r"([a-z]+)_(.+)"):
        coordinate, figure = MOTIONS[motion]
        told = {"motion": motion, "preset": preset, "figure": figure, "coordinate": coordinate.replace("_", " ")}
        volumes = runs.over(run, "volume_ratio", f"{coordinate}_deg", lambda value: 100 * (value - 1))
        reach = 1.1 * max([0.1] + [abs(y) for points in volumes.values() for _, y in points])
        page.draw(f"{motion}_{preset}_volume_ratio", lines(volumes), told, y_range=(-reach, reach))
        page.draw(f"{motion}_{preset}_activation", lines(runs.over(run, "activation", f"{coordinate}_deg")), told, y_range=(0, 1.05))


def neighbors(page):
    """Section 6.5.1: the samples, and those that the unit asks in some frame of a motion, as `gracilis activations neighbors` tells."""
    for motion in MOTIONS:
        samples = runs.rows(f"{page.out}/neighbors/{motion}/neighbors.csv")
        used = [row for row in samples if row["poses"] > 0]
        for across, name in enumerate(COORDINATES[1:], 1) if samples else []:
            def flat(rows):
                return [(row["hip_flexion_r_deg"], row[f"{name}_deg"]) for row in rows]
            asked = [(pose[0], pose[across]) for pose in poses(f"{page.out}/controlled/{motion}_thesis-2024")]
            page.draw(f"neighbors_{motion}_{name}",
                      [Series("samples", flat(samples), "#bbbbbb", marks=True), Series("neighbors used", flat(used), "#0072b2", marks=True),
                       Series("the motion", asked, "#d55e00")],
                      {"motion": motion, "coordinate": name.replace("_", " "), "used": len(used), "samples": len(samples)})


def optimized(page):
    """Figure 6.6: muscles that static optimization makes active in 40 degrees of extension, and how many there are."""
    if not os.path.exists(f"{page.out}/extended"):
        return
    columns, rows = runs.sto(f"{page.out}/activations/hip_r_hip_flexion_r.sto")
    coordinates, motion = runs.sto(f"{page.out}/motions/hip_r_hip_flexion_r.mot")
    angles = {round(row[0], 6): row[coordinates.index("hip_flexion_r")] for row in motion}
    shown = [row for row in rows if angles[round(row[0], 6)] <= 10]
    series = [Series(muscle, [(angles[round(row[0], 6)], row[i]) for row in shown])
              for i, muscle in enumerate(columns) if muscle.endswith("_r") and rows[0][i] > ACTIVE]
    page.draw("figure_6_6_curves", series, {"least": ACTIVE})
    page.put("extended_active", len(series), least=ACTIVE)
