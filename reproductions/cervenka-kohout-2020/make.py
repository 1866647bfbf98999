"""Volumes, edges and angles of a box and of muscles that are bent and let go."""
import os

import runs
from charts import Series, lines
from files import read

# What is measured, as it is drawn and as runs have it, and the first of the figures that show it, of the box, iliacus and gluteus maximus.
CURVES = (("volume_error_percent", "volume_ratio", lambda value: 100 * (value - 1), 11), ("mean_edge_ratio", "edge_ratio_mean", float, 14),
          ("mean_dihedral_change_deg", "dihedral_change_mean_deg", float, 17), ("vertex_depth_mm", "vertex_depth_mm", float, None))
SHOWN = ("box", "iliacus_r", "gluteus_maximus_r")


def curves(page, bodies):
    """Figures 11 to 19."""
    found = {}
    for name, column, of, first in CURVES:
        found[name] = {muscle: points for body in bodies for muscle, points in runs.over(f"{page.out}/{body}", column, of=of).items()}
        page.draw(name, lines(found[name]))
        for number, muscle in enumerate(SHOWN):
            if first and muscle in found[name]:
                page.draw(f"figure_{first + number}", lines({muscle: found[name][muscle]}))
    return found


def fibers(page):
    """Figures 20 and 21: each fiber's length in every frame."""
    of_muscles = runs.fibers(f"{page.out}/hip")
    for muscle, figure in (("iliacus_r", 20), ("gluteus_maximus_r", 21)):
        of_fibers = list(zip(*(lengths for _, lengths in of_muscles[muscle])))
        page.draw(f"figure_{figure}", [Series(f"fiber {i}", list(enumerate(lengths)), "#0072b2", legend="" if i else "fibers") for i, lengths in enumerate(of_fibers)],
                  {"fibers": len(of_fibers)})


def make(page):
    bodies = [body for body in ("box", "hip") if os.path.isdir(f"{page.out}/{body}")]
    found = curves(page, bodies)
    if "hip" in bodies:
        fibers(page)
    else:
        page.cannot("Figures 20 and 21: lengths of fibers", "the cadaver's hip (--data), without --thin")
    for body in bodies:
        triangles = {os.path.basename(surface["file"]).removesuffix("_0000.vtp"): surface["triangles"] for surface in read(f"{page.out}/{body}.json")}
        for muscle, table in runs.groups(runs.measures(f"{page.out}/{body}"), "muscle").items():
            times = [row["milliseconds"] for row in table[1:]]
            page.put(f"{muscle} triangles", triangles[muscle])
            page.put(f"{muscle} frames_per_second", 1000 * len(times) / sum(times))
            page.put(f"{muscle} largest_volume_error", max(abs(value) for _, value in found["volume_error_percent"][muscle]))
            for frame in (100, 200, 300):
                page.put(f"{muscle} volume_error_in_frame_{frame}", found["volume_error_percent"][muscle][frame][1])
                page.put(f"{muscle} mean_edge_ratio_in_frame_{frame}", found["mean_edge_ratio"][muscle][frame][1])
