"""Closed surfaces around lines: tubes with elliptical sections, and sheets of lines beside each other."""

import math

import numpy as np

SECTIONS = 31  # of every tube and sheet, before it is meshed


def unit(vectors):
    return vectors / np.maximum(np.linalg.norm(vectors, axis=-1, keepdims=True), 1e-12)


def resampled(line, count):
    """`count` points at equal distances along a line."""
    along = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
    return np.stack([np.interp(np.linspace(0, along[-1], count), along, line[:, k]) for k in range(3)], 1)


def stretched(values, count):
    """`count` values interpolated over the first axis of `values`."""
    at = np.linspace(0, len(values) - 1, count)
    low = np.minimum(at.astype(int), len(values) - 2)
    share = (at - low).reshape((-1,) + (1,) * (values.ndim - 1))
    return (1 - share) * values[low] + share * values[low + 1]


class Tube:
    """Half widths across and along `normal` about the points of a line."""

    def __init__(self, line, wide, thick, normal):
        self.line, self.wide, self.thick = line, wide, thick
        along = unit(np.gradient(line, axis=0))
        self.normal = unit(normal - (normal * along).sum(1, keepdims=True) * along)
        self.across = np.cross(along, self.normal)

    def distance(self, points):
        """How far points are from it, taken as round, and which way leads away."""
        a, along = self.line[:-1], np.diff(self.line, axis=0)
        share = np.clip(((points[:, None] - a) * along).sum(2) / (along * along).sum(1), 0, 1)
        foot = a + share[..., None] * along
        radius = np.maximum(self.wide, self.thick)
        gap = np.linalg.norm(points[:, None] - foot, axis=2) - (radius[:-1] + share * np.diff(radius))
        nearest = gap.argmin(1)
        rows = np.arange(len(points))
        return gap[rows, nearest], unit(points - foot[rows, nearest])

    def strips(self, parts=5):
        """Round tubes that fill a flat one."""
        for share in np.linspace(-0.85, 0.85, parts):
            radius = self.thick * math.sqrt(1 - share * share)
            yield Tube(self.line + (share * self.wide)[:, None] * self.across, radius, radius, self.normal)

    def at(self, share, direction, outside=0.0):
        """A point of the surface at this share of the line, in a direction."""
        k = int(round(share * (len(self.line) - 1)))
        x, y = direction @ self.across[k], direction @ self.normal[k]
        length = math.hypot(x, y)
        return (self.line[k] + (x / length * (self.wide[k] + outside)) * self.across[k]
                + (y / length * (self.thick[k] + outside)) * self.normal[k])

    def mesh(self, edge, rng, bumps=0.0, jitter=0.0, slivers=0):
        """Rings of vertices, closed by a cone at each end, with bumps (a share of the radius), uneven spacing, and
        triangles pressed flat."""
        rings = max(6, int(np.linalg.norm(np.diff(self.line, axis=0), axis=1).sum() / edge))
        middle, normal, across, wide, thick = (stretched(values, rings) for values in
                                               (self.line, self.normal, self.across, self.wide, self.thick))
        count = max(8, int(2 * math.pi * math.sqrt((wide.max() ** 2 + thick.max() ** 2) / 2) / edge))
        phases = rng.uniform(0, 2 * math.pi, 3)
        vertices = []
        for i in range(rings):
            angle = (np.arange(count) + 0.5 * (i % 2) + 0.25 * jitter * rng.normal(size=count)) * 2 * math.pi / count
            bump = 1 + bumps * (np.sin(2 * angle + phases[0] + 0.11 * i) + np.sin(3 * angle + phases[1] - 0.17 * i)
                                + math.sin(0.23 * i + phases[2]))
            vertices.append(middle[i] + (np.cos(angle) * wide[i] * bump)[:, None] * across[i]
                            + (np.sin(angle) * thick[i] * bump)[:, None] * normal[i])
        tips = np.stack([middle[0] - 0.6 * thick[0] * unit(middle[1] - middle[0]),
                         middle[-1] + 0.6 * thick[-1] * unit(middle[-1] - middle[-2])])
        vertices = np.concatenate(vertices + [tips])
        first, last = len(vertices) - 2, len(vertices) - 1
        faces = ring_faces(rings, count)
        for j in range(count):
            k = (j + 1) % count
            faces += [(first, k, j), (last, (rings - 1) * count + j, (rings - 1) * count + k)]
        faces = np.array(faces)
        for face in faces[rng.integers(len(faces), size=slivers)]:
            vertices[face[0]] += 0.9 * (vertices[face[1]] - vertices[face[0]])
        return vertices, outward(vertices, faces)


class Sheet:
    """Lines beside each other (sections x lines x 3), with a half thickness along them."""

    def __init__(self, lines, normal, half):
        self.lines, self.normal, self.half = lines, normal, half

    def tubes(self):
        """What keeps others off: every other line with its thickness."""
        for j in range(0, self.lines.shape[1], 2):
            yield Tube(self.lines[:, j], 0.9 * self.half, 0.9 * self.half, self.normal[:, j])

    def mesh(self, edge, rng, jitter=0.0, **_):
        """The upper side, back along the lower one, closed at both ends."""
        length = np.linalg.norm(np.diff(self.lines[:, self.lines.shape[1] // 2], axis=0), axis=1).sum()
        width = np.linalg.norm(np.diff(self.lines, axis=1), axis=2).sum(1).max()
        rows, columns = max(8, int(length / edge)), max(3, int(width / edge))

        def grid(values):
            return stretched(stretched(values, rows).swapaxes(0, 1), columns).swapaxes(0, 1)

        middle, normal = grid(self.lines), unit(grid(self.normal))
        rounded = np.sqrt(1 - (0.93 * np.linspace(-1, 1, columns)) ** 4)
        up = (stretched(self.half, rows)[:, None] * rounded)[..., None] * normal
        count = 2 * columns
        vertices = np.concatenate([middle + up, (middle - up)[:, ::-1]], 1).reshape(-1, 3)
        vertices += 0.08 * edge * jitter * rng.normal(size=vertices.shape)
        faces = ring_faces(rows, count)
        for i, turned in ((0, True), (rows - 1, False)):
            for j in range(columns - 1):
                a, b, c, d = (i * count + k for k in (j, j + 1, count - 1 - j, count - 2 - j))
                faces += [(a, c, b), (b, c, d)] if turned else [(a, b, c), (b, d, c)]
        return vertices, outward(vertices, np.array(faces))


def ring_faces(rings, count):
    faces = []
    for i in range(rings - 1):
        for j in range(count):
            a, b = i * count + j, i * count + (j + 1) % count
            faces += [(a, b, a + count), (b, b + count, a + count)] if i % 2 == 0 else [(a, b, b + count),
                                                                                      (a, b + count, a + count)]
    return faces


def outward(vertices, faces):
    volume = (vertices[faces[:, 0]] * np.cross(vertices[faces[:, 1]], vertices[faces[:, 2]])).sum()
    return faces if volume > 0 else faces[:, ::-1]


def pulled_tight(first, last, aside, half, bones, others, kept_off, rounds=200):
    """Lines (sections x lines x 3) from points to points that begin bent to a side and are pulled straight, out of bones
    by their half thickness and out of others by a share of it."""
    along = np.linspace(0, 1, SECTIONS)[:, None, None]
    lines = (1 - along) * first + along * last + np.sin(math.pi * along) * aside
    half = np.repeat(half, lines.shape[1])
    inner = np.zeros(lines.shape[:2], bool)
    inner[1:-1] = True
    inner = inner.reshape(-1)
    for _ in range(rounds):
        lines[1:-1] = 0.5 * (lines[:-2] + lines[2:])
        points = lines.reshape(-1, 3)
        for obstacles, share in ((others, kept_off), (bones, 0.95)):
            for obstacle in obstacles:
                gap, out = obstacle.distance(points)
                points += (np.maximum(0, share * half - gap) * inner)[:, None] * out
    return np.stack([resampled(lines[:, j], SECTIONS) for j in range(lines.shape[1])], 1)


def away_from(points, obstacles):
    """The direction away from the nearest obstacle."""
    nearest, direction = np.full(len(points), np.inf), np.zeros_like(points)
    for obstacle in obstacles:
        gap, out = obstacle.distance(points)
        closer = gap < nearest
        nearest[closer], direction[closer] = gap[closer], out[closer]
    return direction
