"""Tendons, counts of vertices, slices, centers outside of their surfaces, and frames per second."""
import math
import statistics

import parameters
import runs
import sections
import steps
from charts import Series, lines, published
from files import read


def counts(page):
    """Table 5.1."""
    for (level, corners), path in runs.matching(f"{page.out}/counts", r"(\d)_(\d+).json"):
        page.put(f"vertices_{level}_{corners:g}", sum(surface["vertices"] for surface in read(path)))
    for (level, corners), path in runs.matching(f"{page.out}/outside", r"([12])_1_(\d+).json"):  # Figure 5.4
        page.put(f"scale_{level}_{corners:g}", next(surface["vertices"] for surface in read(path) if surface["file"].endswith("sar_r.vtp")))


def slices(page):
    """Figure 3.15."""
    surfaces = read(f"{page.out}/slices.json")
    found = [s for surface in surfaces for s in surface["slices"] if s["outlines"] > 0]
    quotients = [s["isoperimetric_quotient"] for s in found]
    page.put("vertices_surfaces", sum(s["vertices"] for s in surfaces), surfaces=len(surfaces))
    page.put("slices", len(found))
    page.put("round_share", 100 * sum(q > 0.5 for q in quotients) / len(found))
    page.put("concave_share", f"{sum(not s['convex'] for s in found)} of {len(found)}")
    page.put("median_quotient", statistics.median(quotients))
    page.put("mean_less_median", statistics.mean(quotients) - statistics.median(quotients))
    page.draw("figure_3_15a", [Series(name, [(s["perimeter_mm"] / math.sqrt(s["area_mm2"]), s["isoperimetric_quotient"]) for s in found if s["convex"] == convex],
                                      marks=True) for name, convex in (("concave", False), ("convex", True))])
    outlines = [[(x / math.sqrt(s["area_mm2"]), y / math.sqrt(s["area_mm2"])) for x, y in s["outline_mm"]] for s in found]
    page.draw("figure_3_15b", [Series(f"slice {i}", outline + outline[:1], "#0072b2", legend="" if i > 1 else "slices") for i, outline in enumerate(outlines, 1)])


def polygons(page):
    """Figure 3.22: the share of a circle's area that the polygon inscribed in it leaves out."""
    shares = [(n, 100 * (1 - n * math.sin(2 * math.pi / n) / (2 * math.pi))) for n in (3, 4, 5, 6, 8, 10, 12)]
    page.draw("figure_3_22", [Series("polygon in a circle", shares), Series("corners", shares, "#0072b2", marks=True, legend="")])


def sections_of(folder):
    """How many sections have a plane that cuts the surface, and how many of these a center outside, as import tells."""
    table = runs.rows(f"{folder}/surfaces.csv")
    return [int(sum(row[column] for row in table)) for column in ("that_cut_the_surface", "of_these_centers_outside")]


def outside(page):
    """Tables 5.2 and 5.3, and Figure 3.9."""
    curves = {}
    for (level, scalar, corners), folder in runs.matching(f"{page.out}/outside", r"(\d)_(\d)_(\d+)"):
        cut, out = sections_of(folder)
        page.put(f"outside_{level}_{scalar}_{corners:g}", out, sections=cut)
        page.put(f"sections_{level}", cut)
        curves.setdefault(int(level), {}).setdefault(int(corners), []).append((int(scalar), 100 * out / cut))
    for level, by_corners in curves.items():
        told = [published(f"published, {n} corners", [(s, 100 * page.value(f"outside_{level}_{s}_{n}") / page.value(f"sections_{level}")) for s in range(1, 7)],
                          dash=n > 6, legend="" if n > 6 else "published") for n in (6, 8, 10, 12)]
        page.draw(f"table_5_{level + 1}", told + lines({f"{n} corners": points for n, points in sorted(by_corners.items())}), {"number": level + 1, "level": level})
    page.put("mended_outside", sections_of(f"{page.out}/mended")[1])
    for planes in ("fixed", "forward", "centered"):
        for key, value in zip(("cut", "outside"), sections_of(f"{page.out}/planes/{planes}")):
            page.put(f"planes_{key}_{planes}", value, planes=planes)
    page.put("enhancement_seconds", steps.seconds(f"{page.out}/enhanced36"))


def speed(page):
    """Page 53 and Figure 5.6."""
    for key, run in (("fps_all", "walk8"), ("fps_36", "walk36"), ("fps_collision", "yielding")):
        page.put(key, 1000 / statistics.median(runs.frame_times(f"{page.out}/run_{run}")))
    measures = [row for row in runs.measures(f"{page.out}/run_yielding") if row["frame"] > 0]
    frames = runs.groups(measures, "frame")
    rounds = [(frame, max(row["collision_rounds"] for row in table)) for frame, table in frames.items()]
    stuck = [(frame, sum(row["unresolved_transversals"] for row in table)) for frame, table in frames.items()]
    own = [(row["frame"], row["collision_rounds"]) for row in measures if row["muscle"] == "vas_int_r"]
    page.draw("figure_5_6", lines({"rounds": rounds, "vastus intermedius": own, "not free": stuck}))
    page.put("rounds", "{:g} to {:g}".format(min(own, key=lambda point: point[1])[1], max(own, key=lambda point: point[1])[1]),
             stuck=int(max(count for _, count in stuck)), frames=sum(count > 0 for _, count in stuck), walk=len(frames),
             muscles=", ".join(sorted({row["muscle"] for row in measures if row["unresolved_transversals"] > 0})) or "none")


def make(page):
    for part in (parameters.tell, counts, slices, polygons, outside, sections.draw, speed):
        part(page)
