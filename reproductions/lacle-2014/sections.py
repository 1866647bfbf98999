"""Sections that are brought onto a surface: Figures 5.2 and 5.4."""
import csv
import glob
import json
import math
import os
import tomllib

from charts import Series, published

RAYS, SHOWN = 12, 4


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(a):
    return [x / math.sqrt(dot(a, a)) for x in a]


def halved(points):
    """The line's points with a middle in each part (LSS 1)."""
    found = [points[0]]
    for a, b in zip(points, points[1:]):
        found += [[(x + y) / 2 for x, y in zip(a, b)], b]
    return found


def rings(path):
    """Corners of each section, mm."""
    with open(path, newline="") as file:
        corners = [[1000 * float(row[f"{axis}_m"]) for axis in "xyz"] for row in csv.DictReader(file)]
    count = (len(corners) - 2) // RAYS
    return [corners[k * RAYS:(k + 1) * RAYS] for k in range(count)]


def in_plane(ring, origin):
    """What takes a point to the section's plane, mm from the origin."""
    normal = [0, 0, 0]
    for a, b in zip(ring, ring[1:] + ring[:1]):
        normal = [x + y for x, y in zip(normal, cross(minus(a, origin), minus(b, origin)))]
    normal = unit(normal)
    along = minus(ring[0], origin)
    along = unit([x - dot(along, normal) * n for x, n in zip(along, normal)])
    across = cross(normal, along)
    return lambda point: (dot(minus(point, origin), along), dot(minus(point, origin), across))


def moved_most(out):
    """(how far, muscle, section, the line's point, the inner point, corners), the farthest first, one of a muscle."""
    with open(f"{out}/rest/sections.toml", "rb") as file:
        muscles = tomllib.load(file)["muscles"]
    found = []
    for muscle in muscles:
        line, name = muscle["action_line"], muscle["name"]
        before, ring = halved(line["points_mm"]), rings(f"{out}/rest/sections_csv/points_{name}.csv")
        inner = [(math.dist(a, b), name, k, a, b, ring[k]) for k, (a, b) in enumerate(zip(before, line["centers_mm"])) if 0 < k < len(before) - 1]
        found.append(max(inner))
    return sorted(found, reverse=True)


def add_to(page, ours, out):
    for number, (far, name, section, before, after, ring) in enumerate(moved_most(out)[:SHOWN]):
        flat = in_plane(ring, after)
        outline = [flat(corner) for corner in ring]
        page.chart(f"figure_5_2_{'abcd'[number]}", f"Figure 5.2 {'abcd'[number]}: an inner point, {name}",
                   f"Section {section} of {RAYS} corners (CSS 6, LSS 1) seen along the line; the line's point (gray) is moved {far:.1f} mm into the muscle.",
                   [Series("section", outline + outline[:1], "#0072b2"), published("the line's point", [flat(before)], marks=True),
                    Series("way to the inner point", [flat(before), flat(after)], "#d55e00"), Series("inner point", [flat(after)], "#d55e00", marks=True)],
                   "mm", "mm", square=True)
    for path in glob.glob(f"{out}/outside/[12]_1_*.json"):
        level, _, count = os.path.basename(path)[:-len(".json")].split("_")
        with open(path) as file:
            ours[f"scale_{level}_{count}"] = sum(surface["vertices"] for surface in json.load(file) if surface["file"].endswith("sar_r.vtp"))
