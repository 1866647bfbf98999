"""Fiber lengths, explosions, corrections, and parameters beside the published ones."""
import re
import statistics
import tomllib

import control
import runs
from charts import COLORS, Series, lines
from files import read

RUNS = {"passive": ("XPBD, passive", "#d55e00"), "active": ("XPBD, active", "#cc79a7"), "pbd_fields": ("PBD, 3 iterations", "#0072b2")}
FLEXION = "hip_flexion_r_deg"
EXPLODED = 1.5  # a muscle's edges so many times as long as at rest, in the mean
SAME = {"zero_iteration_threshold": "contact.contact_distance", "volume_time_diff": "settings.time_step"}  # published as two, one here


def worst(folder, column):
    """[(flexion, value)] of the muscle whose value is farthest from 1 there."""
    return [max(points, key=lambda point: abs(point[1] - 1)) for points in zip(*runs.over(folder, column, FLEXION).values())]


def exploded(folder):
    """Muscles that explode in some frame, with the first such flexion."""
    over = {muscle: [flexion for flexion, value in points if not value < EXPLODED] for muscle, points in runs.over(folder, "edge_ratio_mean", FLEXION).items()}
    return {muscle: found[0] for muscle, found in over.items() if found}


def fibers(page):
    """Figures 7.10 and 7.11."""
    by_run = {name: runs.fibers(f"{page.out}/{name}") for name in RUNS}
    for muscle in sorted(by_run["passive"]):
        series = []
        for name, (label, color) in RUNS.items():
            points = by_run[name][muscle]
            series += [Series(label, [(x, min(each)) for x, each in points], color, band=[(x, max(each)) for x, each in points]),
                       Series(label, [(x, statistics.mean(each)) for x, each in points], color)]
        page.draw(f"fibers_{muscle}", series, {"muscle": muscle.replace("_", " ")})
    brevis = by_run["passive"].get("adductor_brevis_r", [(0, [])])
    if brevis[-1][0] > 80:
        page.put("adductor_brevis_shortest", min(brevis, key=lambda point: statistics.mean(point[1]))[0])


def worst_muscles(page):
    page.draw("volume_error", [Series(label, [(x, 100 * (value - 1)) for x, value in worst(f"{page.out}/{name}", "volume_ratio")], color)
                               for name, (label, color) in RUNS.items()])
    page.draw("longest_edge", [Series(label, worst(f"{page.out}/{name}", "edge_ratio_max_free"), color) for name, (label, color) in RUNS.items()])


def sweeps(page):
    """Section 6.6.2: where muscles first explode, by step."""
    found = {}
    for kind in ("passive", "active"):
        folders = {1.0: f"{page.out}/{kind}", **{step: run for (step,), run in runs.named(f"{page.out}/sweep", rf"{kind}_([\d.]+)")}}
        page.draw(f"sweep_{kind}", [Series(f"{step:g}°", worst(run, "edge_ratio_max_free"), color) for (step, run), color in zip(sorted(folders.items()), COLORS)],
                  {"kind": kind})
        found.update({f"{kind} {step:g}°": exploded(run) for step, run in sorted(folders.items())})
    first = min((flexion for muscles in found.values() for flexion in muscles.values()), default="none")
    page.put("explosion", first, steps=", ".join(found), limit=EXPLODED,
             found="; ".join(f"{step}: {', '.join(muscles)}" for step, muscles in found.items() if muscles) or "none of the muscles")


def corrections(page):
    """Figures 6.4 and 6.5: how far each kind of constraint moves gluteus maximus in a frame."""
    flexion = [x for x, _ in next(iter(runs.over(f"{page.out}/corrections", "volume_ratio", FLEXION).values()))]
    by_kind = runs.groups(runs.rows(f"{page.out}/corrections_csv/corrections.csv"), "kind")
    for which in ("mean", "largest"):
        curves = {kind: [(flexion[int(row["frame"])], row[f"{which}_mm"]) for row in table] for kind, table in by_kind.items()}
        page.draw(f"figure_6_5_{which}", lines({kind: points for kind, points in curves.items() if any(y > 0 for _, y in points)}), {"which": which})
    if flexion[-1] > 80:
        dihedrals, bones = curves["dihedral"], curves["bone contact"]
        page.put("dihedrals_lead", max(x for (x, moved), (_, held) in zip(dihedrals, bones) if moved <= held) + 1, most=max(y for _, y in dihedrals))


def many_muscles(page):
    """Section 7.2: what explodes at once among 26 muscles, and how the others fare."""
    for (name,), run in runs.named(page.out, r"leg_(published|stiff)"):
        page.draw(f"leg_{name}_edges", lines(runs.over(run, "edge_ratio_mean", FLEXION)))
        found = exploded(f"{page.out}/leg_all_{name}")
        page.put(f"leg_exploded_{name}", f"{len(found)} of 26", muscles=", ".join(found))


def parameters(page):
    """Tables B.1 and 6.1, and Figures 6.1 and 6.2: what a run's first muscle had; of a vector its length."""
    had = tomllib.loads(read(f"{page.out}/passive/run.json")["settings"])
    tables = [(part, had["muscles"][0][part]) for part in ("settings", "contraction", "fibers")] + [(part, had[part]) for part in ("contact", "distance_field")]
    ours = {f"{part}.{key}": sum(each**2 for each in value) ** 0.5 if isinstance(value, list) else value for part, table in tables for key, value in table.items()}
    with open(f"{page.out}/config.toml") as file:
        ours["neighbors"] = float(re.search(r"^# neighbors = (\d+)", file.read(), re.MULTILINE)[1])
    ours.update({key: ours[setting] for key, setting in SAME.items()})
    angles = [pose[0] for pose in control.poses(f"{page.out}/passive") if pose[1:] == (0, 0)]
    ours.update(motion_rows=len(angles), motion_first=angles[0], motion_step=angles[1] - angles[0], motion_last=angles[-1])
    ours.update({f"across_{muscle['muscle']}": 100 * muscle["on_surface"][1]["share_rejected"] for muscle in read(f"{page.out}/fibers.json")})
    for key, value in ours.items():
        if isinstance(value, (int, float)):
            page.put(key, float(value))


def make(page):
    for part in (fibers, worst_muscles, sweeps, corrections, control.controlled, control.neighbors, control.optimized, many_muscles, parameters):
        part(page)
