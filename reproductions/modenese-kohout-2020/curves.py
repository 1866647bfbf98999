"""Published and measured moment arms (mm, -dL/dq, flexion, adduction and inward rotation positive) and those of runs."""
import os
import re

import runs

# The scenes have some names of their own.
NAMES = {"psoas_r": "psoas_major_r", "biceps_brachii_r": "biceps_long", "triceps_long_r": "triceps_long",
         "triceps_lateral_r": "triceps_lateral", "triceps_medial_r": "triceps_medial"}
COORDINATES = {"elbow_flexion_r": "elbow_flexion"}
SWEPT = {"hip_flexion": "hip_flexion_r", "hip_adduction": "hip_adduction_r", "elbow": "elbow_flexion", "knee": "knee_flexion_r"}  # the coordinate of each sweep


class Curve:
    """Arms over angles (degrees) by one source; `low` and `high` are of all fibers, where it tells them."""

    def __init__(self, source, coordinate, muscle, over=None):
        self.source, self.coordinate, self.muscle = source, coordinate, muscle
        self.over = over or coordinate  # the coordinate that is changed
        self.mean, self.low, self.high = [], [], []


def at(points, x):
    """Between points (angle, arm) by a straight line; None beyond them."""
    for (x0, y0), (x1, y1) in zip(points, points[1:]):
        if x0 <= x <= x1:
            return y0 if x1 == x0 else y0 + (y1 - y0) * (x - x0) / (x1 - x0)
    return None


def fibers_of_the_cadaver(folder):
    curves = {}
    for motion in ("flexion", "adduction"):
        for row in runs.rows(f"{folder}/modenese_kohout_2020_hip_{motion}.csv"):
            key = (motion, row["muscle"])
            curve = curves.setdefault(key, Curve("Modenese 2020, same cadaver", f"hip_{motion}_r",
                                                 NAMES.get(row["muscle"], row["muscle"])))
            for name, points in (("mean", curve.mean), ("min", curve.low), ("max", curve.high)):
                points.append((row["angle_deg"], 1000 * row[name]))
    return list(curves.values())


def finite_elements(folder):
    """Bounds alone. Published with extension positive for gluteal muscles about flexion."""
    curves = {}
    for row in runs.rows(f"{folder}/blemker_delp_2005_bounds.csv"):
        key = (row["motion"], row["muscle"])
        curve = curves.setdefault(key, Curve("Blemker 2005, finite elements", f"hip_{row['motion']}_r",
                                             NAMES.get(row["muscle"], row["muscle"])))
        turned = row["motion"] == "flexion" and row["muscle"].startswith("gluteus")
        is_high = (row["bound"] == "ub") != turned
        arm = 10 * row["moment_arm_cm_as_published"] * (-1 if turned else 1)
        (curve.high if is_high else curve.low).append((row["angle_deg"], arm))
    return list(curves.values())


def columns(path, source, muscle, coordinate_of, scale):
    """A curve for each column but the first, which is hip flexion."""
    curves = []
    table = runs.rows(path)
    for name in list(table[0])[1:]:
        coordinate, label = coordinate_of(name)
        curve = Curve(source + label, coordinate, muscle, "hip_flexion_r")
        curve.mean = [(row["hip_flexion"], scale * row[name]) for row in table]
        curves.append(curve)
    return curves


def measured(folder):
    about = {"glut_med_flex": "hip_flexion_r", "glut_med_add": "hip_adduction_r", "glut_med_int_rot": "hip_rotation_r"}
    return (columns(f"{folder}/Arnold2000.csv", "Arnold 2000, MRI", "psoas_major_r",
                    lambda name: ("hip_flexion_r", ", subject " + name[-1]), 10)
            + columns(f"{folder}/Dostal1986.csv", "Dostal 1986", "gluteus_medius_r", lambda name: (about[name], ""), 10)
            + columns(f"{folder}/Nemeth1985.csv", "Nemeth 1985, CT", "gluteus_maximus_r",
                      lambda name: ("hip_flexion_r", ""), -1))


def models(folder):
    curves = {}
    for row in runs.rows(f"{folder}/models_elbow_knee_ankle.csv"):
        coordinate = COORDINATES.get(row["coordinate"], row["coordinate"])
        muscle = NAMES.get(row["muscle"], row["muscle"]) if coordinate == "elbow_flexion" else row["muscle"]
        curve = curves.setdefault((coordinate, muscle, row["model"]), Curve(row["model"] + ", model", coordinate, muscle))
        curve.mean.append((row["angle_deg"], row["moment_arm_mm"]))
    return list(curves.values())


def published(folder):
    """All curves there are, their points by angle."""
    curves = fibers_of_the_cadaver(folder) + finite_elements(folder) + measured(folder) + models(folder)
    for curve in curves:
        for points in (curve.mean, curve.low, curve.high):
            points.sort()
    return curves


def arms_of_sweep(folder, method, coordinate):
    """The curves of every muscle in a folder of `gracilis rom`."""
    names, table = runs.sto(f"{folder}/moment_arms.sto")
    curves = {}
    for i, name in enumerate(names):
        fiber = re.fullmatch(r"(.+)_f\d+", name)
        muscle = fiber[1] if fiber else name
        if muscle == "time" or muscle.endswith(("_by_force", "_doubtful")):
            continue
        points = [(row[names.index(coordinate)], 1000 * row[i]) for row in table]
        curve = curves.setdefault(muscle, Curve(method, coordinate, muscle))
        if not fiber:
            curve.mean = points
            continue
        for ends, choose in ((curve.low, min), (curve.high, max)):
            if not ends:
                ends.extend(points)
            else:
                ends[:] = [(x, choose(y, other)) for (x, other), (_, y) in zip(ends, points)]
    return [curve for curve in curves.values() if len(curve.mean) > 1]


def sweeps_of(folder, method):
    """Those about another coordinate than the one that is changed are short ones, of which the arm at 0 counts: COORDINATE_at_ANGLE, the hip flexed."""
    curves, flexed = [], {}
    for name in sorted(os.listdir(folder)):
        if not os.path.exists(f"{folder}/{name}/moment_arms.sto"):
            continue
        if name in SWEPT:
            curves += arms_of_sweep(f"{folder}/{name}", method, SWEPT[name])
            continue
        coordinate, angle = name.split("_at_")
        for short in arms_of_sweep(f"{folder}/{name}", method, coordinate):
            curve = flexed.setdefault((coordinate, short.muscle), Curve(method, coordinate, short.muscle, "hip_flexion_r"))
            curve.mean.append((float(angle), at(short.mean, 0)))
    for curve in flexed.values():
        curve.mean.sort()
    return curves + list(flexed.values())


def arms_of_method(folder):
    """{method: its curves} of all sweeps in the folder."""
    return {method: sweeps_of(f"{folder}/{method}", method) for method in sorted(os.listdir(folder)) if os.path.isdir(f"{folder}/{method}")}
