"""How springs come to rest, what time they and collisions take, and how many particles there are."""
import statistics

import runs
from charts import COLORS, Series, lines, published
from runs import log

ONE = "adductor_brevis_r"  # of the cadaver's five muscles the one that is most like the publication's adductor longus
BODIES = {"hip": "the cadaver's hip", "leg": "the walking model's thigh"}


def total(rows, column, factor=1):
    return factor * sum(row[column] for row in rows)


def seconds(run):
    return total(runs.last(run), "milliseconds", 0.001)


def settled(points):
    late = [point for point in points if point[0] >= 100]
    return late if len(late) > 1 else points


def fitted(points):
    """The ends of the line of least squares, and how fast it falls, mm per iteration."""
    fall, start = statistics.linear_regression(*zip(*points))
    return [(x, start + fall * x) for x in (points[0][0], points[-1][0])], -fall


def convergence(page):
    """Figures 5.3 to 5.5."""
    folder = f"{page.out}/runs"
    curves = runs.over_runs(folder, r"hip_layout_(.+)_(\d+)", lambda rows: total(rows, "displacement_mm", 1 / len(rows)))
    for layout in curves:
        page.draw(f"figure_5_3_{layout}", lines(runs.muscles_over_runs(folder, rf"hip_layout_{layout}_(\d+)", "displacement_mm")), {"layout": layout})
    page.draw("layouts", lines(curves))
    of_layouts = {layout: statistics.mean(y for _, y in points) for layout, points in curves.items()}
    page.put("displacement_ratio", statistics.mean(mean for layout, mean in of_layouts.items() if layout != "cubic-6") / of_layouts["cubic-6"])
    for kind, figure in (("layout", "figure_5_4"), ("neighbors", "figure_5_5")):
        one = runs.over_runs(folder, rf"hip_{kind}_(.+)_(\d+)", lambda rows: next(row["displacement_mm"] for row in rows if row["muscle"] == ONE))
        series, falls = [], {}
        for (what, points), color in zip(one.items(), COLORS):
            line, falls[what] = fitted(settled(points))
            series += [Series(what, settled(points), color, legend=f"{what}: {1e6 * falls[what]:.3g} nm per iteration"), Series(f"{what}, fitted", line, color, dash=True, legend="")]
        page.draw(figure, series)
        for key, what in (("slope_ratio", "cubic-26"), ("slope_ratio_nearest", "nearest")):
            if what in falls:
                page.put(key, falls[what] / falls["cubic-6"])
    for (layout,), run in runs.named(folder, r"hip_layout_(.+)_1500"):
        page.put(f"time_{layout}", seconds(run))


def time_steps(page):
    """Figures 5.9 to 5.11."""
    folder = f"{page.out}/runs"
    for kind, figure in (("0.4", "figure_5_9"), ("adaptive", "figure_5_10"), ("0.7", "figure_5_11")):
        for body, words in BODIES.items():
            curves = runs.muscles_over_runs(folder, rf"{body}_step_{kind}_(\d+)", "length_changes_mm", 0.001)
            if curves:
                page.draw(f"{figure}_{body}_curves", lines(curves), {"body": words})
    page.draw("figure_5_9", lines(runs.over_runs(folder, r"hip_step_(.+)_(\d+)", lambda rows: total(rows, "length_changes_mm", 0.001))))
    page.put("adaptive_step", statistics.mean(row["verlet_step_s"] for row in runs.last(runs.named(folder, r"hip_step_adaptive_(\d+)")[-1][1])))


def collisions(page):
    """Table 5.1: what a kind of collision adds to the springs alone."""
    for (body,), springs in runs.named(f"{page.out}/runs", r"(.+)_springs_70"):
        spent = {kind: seconds(f"{page.out}/runs/{body}_{kind}") - seconds(springs) for kind in ("rebuilt", "refitted", "of_muscles", "of_bones", "refit_of_muscles", "refit_of_bones")}
        for kind, time in spent.items():
            page.put(f"{body}_{kind}", time)
        page.put(f"{body}_refit_gain", 100 * (1 - spent["refitted"] / spent["rebuilt"]))


def resolutions(page):
    """Tables 5.2 and 5.3, Figures 5.17 and 5.18."""
    spent, springs, detected = {}, [], {}
    for (where, each), run in runs.named(f"{page.out}/runs", r"(hip_resolution|leg_at_[\d.]+)_(\d+)"):
        alone, muscles = run.replace(f"_{each:g}", f"_alone_{each:g}"), runs.last(run)
        time = seconds(run) - seconds(alone)
        detected.setdefault(where, []).append((total(muscles, "boundary_particles"), time))
        if where == "hip_resolution":
            springs.append((total(muscles, "particles"), seconds(alone)))
            continue
        page.put(f"at_{where.split('_')[-1]}_{each:g}", time)
        if where == "leg_at_0.5":
            page.put(f"springs_{each:g}", seconds(alone))
        spent.setdefault(each, []).append(time)
        for kind in ("boundary", "particles"):
            column = "boundary_particles" if kind == "boundary" else kind
            page.put(f"{kind}_{each:g}", total(muscles, column))
            for row in muscles:
                page.put(f"{kind}_{row['muscle']}_{each:g}", row[column])
    for each, times in spent.items():
        page.put(f"collisions_{each:g}", statistics.mean(times), instants=len(times))
    if 80 in spent:
        growth = {kind: page.ours[f"{kind}_80"] / page.ours[f"{kind}_20"] for kind in ("collisions", "particles", "boundary")}
        page.put("growth_particles", growth["particles"])
        page.put("growth_collisions", growth["collisions"], growth=growth["boundary"])
    page.draw("figure_5_17", [published("published", [(page.value(f"boundary_{n}"), log(page.value(f"collisions_{n}"))) for n in (20, 40, 60, 80)])] +
              lines({("the cadaver's hip" if where == "hip_resolution" else f"thigh, {where.split('_')[-1]} s of the walk"): [(count, log(time)) for count, time in points if time > 0]
                     for where, points in detected.items()}))
    page.draw("figure_5_18", [Series("springs", springs)])


def make(page):
    for part in (convergence, time_steps, collisions, resolutions):
        part(page)
