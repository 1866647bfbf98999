"""Sections that are brought onto a surface: Figures 5.2 and 5.4."""
import math

import runs
from charts import PUBLISHED, Series
from files import read

RAYS = 12


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
    corners = [[1000 * row[f"{axis}_m"] for axis in "xyz"] for row in runs.rows(path)]
    return [corners[k:k + RAYS] for k in range(0, len(corners) - 2, RAYS)]


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
    muscles = read(f"{out}/outside/1_6_12/model.toml")["muscles"]
    found = []
    for muscle in muscles:
        line, name = muscle["action_line"], muscle["name"]
        before, ring = halved(line["points_mm"]), rings(f"{out}/rest/sections_csv/points_{name}.csv")
        found.append(max((math.dist(before[k], line["centers_mm"][k]), name, k, before[k], line["centers_mm"][k], ring[k]) for k in range(1, len(before) - 1)))
    return sorted(found, reverse=True)


def matches(out):
    """{(muscle, section): [(a point, the other)]}: where opposite rays met the surface on the same side of the line's point."""
    of_sections = runs.groups(runs.rows(f"{out}/outside/1_6_12/matches.csv"), "muscle", "section")
    return {key: [tuple([row[f"{end}{axis}_mm"] for axis in "xyz"] for end in ("", "to_")) for row in rows] for key, rows in of_sections.items()}


def draw(page):
    found = matches(page.out)
    for letter, (far, name, section, before, after, ring) in zip("abcd", moved_most(page.out)):
        flat = in_plane(ring, after)
        outline = [flat(corner) for corner in ring]
        pairs = [Series(f"match {i}", [flat(a), flat(b)], "#e69f00", legend="" if i else "matches") for i, (a, b) in enumerate(found.get((name, section), []))]
        page.draw(f"figure_5_2_{letter}", pairs +
                  [Series("section", outline + outline[:1], "#0072b2"), Series("the line's point", [flat(before)], PUBLISHED, marks=True),
                   Series("way to the inner point", [flat(before), flat(after)], "#d55e00"), Series("inner point", [flat(after)], "#d55e00", marks=True)],
                  {"letter": letter, "muscle": name, "section": section, "corners": RAYS, "far": far})
