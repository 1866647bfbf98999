"""Charts as SVG, all of one family: axes with units, what was published in gray, ours in color, no scripts."""
import base64
import html
import itertools
import math
import struct
import zlib

COLORS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7f3c8d", "#8c564b", "#b5bd00"]
PUBLISHED = "#555"
BOTTOM, TOP = 36, 8
RIGHT, BAR = 18, 66  # what is kept free on the right, and what a field's color bar takes there
RISING = [(68, 1, 84), (59, 82, 139), (33, 145, 140), (94, 201, 98), (253, 231, 37)]  # from dark to light, in gray, too
SIGNS = {"●": (), "■": ((-1, -1), (1, -1), (1, 1), (-1, 1)), "▲": ((0, -1.3), (1.2, 0.9), (-1.2, 0.9)), "◆": ((0, -1.4), (1.3, 0), (0, 1.4), (-1.3, 0)),
         "▼": ((0, 1.3), (1.2, -0.9), (-1.2, -0.9))}  # corners about the middle
ABOUT_ZERO = [(33, 102, 172), (247, 247, 247), (178, 24, 43)]


class Series:
    """Points (x, y) joined by a line, or apart (`marks`); `band`: a second row of points, the area between is filled.
    Points that are not finite are left out, and a line is broken there. `legend`: what the legend says in place of the name; empty: nothing."""

    def __init__(self, name, points, color=None, marks=False, dash=False, band=None, size=3, legend=None, published=False):
        if not name:
            raise ValueError("a curve without a name")
        self.name, self.points, self.color = name, points, color
        self.marks, self.dash, self.band, self.size = marks, dash, band, size
        self.legend, self.published = name if legend is None else legend, published


def lines(curves):
    """A line for each entry {name: points}."""
    return [Series(name.replace("_", " "), points) for name, points in curves.items()]


class Field:
    """Colors under a chart: rows of values from below, each from left to right, that fill the ranges. Values beyond
    `low` and `high` have the colors of these. `about_zero`: low is -high, and both signs have a color of their own."""

    def __init__(self, rows, x_range, y_range, label, low, high, about_zero=False):
        self.rows, self.x_range, self.y_range = rows, x_range, y_range
        self.label, self.low, self.high = label, low, high
        self.colors = ABOUT_ZERO if about_zero else RISING

    def color(self, value):
        share = min(max((value - self.low) / (self.high - self.low), 0), 1) * (len(self.colors) - 1)
        at = min(int(share), len(self.colors) - 2)
        return [round(a + (b - a) * (share - at)) for a, b in zip(self.colors[at], self.colors[at + 1])]

    def image(self, rows):
        """Rows of values from above as a PNG's data address."""
        raw = b"".join(b"\0" + bytes(c for value in row for c in self.color(value)) for row in rows)
        size = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 2, 0, 0, 0)
        chunks = b"".join(struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
                          for kind, data in ((b"IHDR", size), (b"IDAT", zlib.compress(raw, 9)), (b"IEND", b"")))
        return "data:image/png;base64," + base64.b64encode(b"\x89PNG\r\n\x1a\n" + chunks).decode()


def color_bar(field, x, high):
    """Colors and numbers to the right of a chart."""
    steps = [[field.low + (field.high - field.low) * (1 - i / 99)] for i in range(100)]
    parts = [f'<image x="{x:.1f}" y="{TOP}" width="10" height="{high}" preserveAspectRatio="none" href="{field.image(steps)}"/>'
             f'<rect x="{x:.1f}" y="{TOP}" width="10" height="{high}" fill="none" stroke="#999"/>']
    for t in ticks(field.low, field.high, 6):
        y = TOP + high * (field.high - t) / (field.high - field.low)
        parts.append(f'<text x="{x + 13:.1f}" y="{y:.1f}" dy="4">{t:g}</text>')
    parts.append(f'<text transform="translate({x + 54:.1f},{TOP + high / 2:.0f}) rotate(-90)" text-anchor="middle">'
                 f'{html.escape(field.label)}</text>')
    return "".join(parts)


def published(name, points, **more):
    return Series(name, points, **{"color": PUBLISHED, **more}, published=True)


def pieces(points):
    """Runs of points (of several numbers each) between those that are not finite, where a line is broken."""
    found = [[]]
    for point in points:
        if all(map(math.isfinite, point)):
            found[-1].append(point)
        elif found[-1]:
            found.append([])
    return [piece for piece in found if piece]


def finite(points):
    return [point for piece in pieces(points) for point in piece]


def areas(points, band):
    """Corners of what lies between two lines, apart where a point of either is not finite."""
    if len(points) != len(band):
        return [finite(points) + finite(band)[::-1]]
    both = pieces((*a, *b) for a, b in zip(points, band))
    return [[point[:2] for point in piece] + [point[2:] for point in reversed(piece)] for piece in both]


def ticks(low, high, most=7):
    """Round numbers from low to high, `most` at most; none where either is not finite."""
    if not math.isfinite(high - low):
        return []
    span = max(high - low, 1e-12)
    step = 10.0 ** -9
    while True:
        for factor in (1, 2, 5):
            if span / (step * factor) <= most:
                step *= factor
                first = int(low / step) if low >= 0 else -int(-low / step) - 1
                found = [round(step * i, 10) for i in range(first, first + most + 3)]
                return [t for t in found if low - 1e-9 * span <= t <= high + 1e-9 * span]
        step *= 10


def bounds(values, margin=0.05):
    low, high = min(values), max(values)
    room = margin * (high - low) or max(abs(high), 1e-9) * 0.1
    return low - room, high + room


def left_of(labels):
    """What numbers of these labels and an axis' name take to the left of a chart."""
    return 26 + 6.4 * max((len(label) for label in labels), default=0)


def sign(glyph, x, y, color, size):
    """A mark by which a curve is told from others without its color, too."""
    if glyph == "●":
        return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{size}" fill="{color}"/>'
    corners = " ".join(f"{x + size * dx:.1f},{y + size * dy:.1f}" for dx, dy in SIGNS[glyph])
    return f'<polygon class="sign" points="{corners}" fill="{color}"/>'


def some_of(points, turn):
    """Points of a line that bear its mark: all where they are few, else six, elsewhere for each turn."""
    return points if len(points) <= 10 else [points[int((i + turn % 5 / 5) * (len(points) - 1) / 6)] for i in range(6)]


def signs_of(series, plain):
    """{curve: its glyph, turn}; none where it would be the only one, there are very many, or `plain`."""
    told = [s for s in series if s.legend and not s.band and not s.published and s.size == 3]
    return {s: (glyph, turn) for turn, (s, glyph) in enumerate(zip(told, itertools.cycle(SIGNS)))} if 1 < len(told) < 30 and not plain else {}


def legend_rows(legend, width):
    """Entries (name, drawn) in rows, five in each at most, and no more than there is room for: a letter takes some 6.2 units."""
    rows, room = [], 0
    for name, drawn in legend:
        needs = 6.2 * (len(name) + 4)
        if not rows or len(rows[-1]) == 5 or needs > room:
            rows.append([])
            room = width
        rows[-1].append(drawn)
        room -= needs
    return rows


def chart(title, series, x_label, y_label, width=380, height=260, x_range=None, y_range=None, square=False, field=None):
    """An SVG's text. `square`: a unit is as long on both axes. `field`: what lies under the curves."""
    if field:
        x_range, y_range = x_range or field.x_range, y_range or field.y_range
    every = [p for s in series for p in finite(s.points) + finite(s.band or [])]
    every += [(field.x_range[0], field.y_range[0])] if field else []
    if not every:
        return ""
    left, right = x_range or bounds([p[0] for p in every], 0.02)
    bottom, top = y_range or bounds([p[1] for p in every])
    edge = left_of([f"{t:g}" for t in ticks(bottom, top)])
    across, high = width - edge - (BAR if field else RIGHT), height - BOTTOM - TOP
    if square:
        unit = max((right - left) / across, (top - bottom) / high)
        middle = (left + right) / 2, (bottom + top) / 2
        left, right = middle[0] - unit * across / 2, middle[0] + unit * across / 2
        bottom, top = middle[1] - unit * high / 2, middle[1] + unit * high / 2

    def at(point):
        return edge + across * (point[0] - left) / (right - left), TOP + high * (top - point[1]) / (top - bottom)

    def line(points, style):
        text = " ".join(f"{x:.1f},{y:.1f}" for x, y in map(at, points))
        return f'<polyline points="{text}" fill="none" {style}/>'

    parts = []
    for t in ticks(bottom, top):
        y = at((left, t))[1]
        parts.append(f'<line x1="{edge:.1f}" y1="{y:.1f}" x2="{edge + across:.1f}" y2="{y:.1f}" stroke="#e4e4e4"/>'
                     f'<text x="{edge - 5:.1f}" y="{y:.1f}" dy="4" text-anchor="end">{t:g}</text>')
    for t in ticks(left, right):
        x = at((t, bottom))[0]
        parts.append(f'<line x1="{x:.1f}" y1="{TOP}" x2="{x:.1f}" y2="{height - BOTTOM}" stroke="#f2f2f2"/>'
                     f'<text x="{x:.1f}" y="{height - BOTTOM + 14}" text-anchor="middle">{t:g}</text>')
    parts.append(f'<text x="{edge + across / 2:.0f}" y="{height - 4}" text-anchor="middle">{html.escape(x_label)}</text>')
    parts.append(f'<text transform="translate(11,{TOP + high / 2:.0f}) rotate(-90)" text-anchor="middle">'
                 f'{html.escape(y_label)}</text>')
    colors = iter([(color, dash) for dash in (False, True) * 9 for color in COLORS])  # what comes after all colors is dashed
    broad = 1.8 if len(series) < 30 else 0.6
    signs = signs_of(series, square or field)
    legend = []
    inside = []
    if field:
        (x0, y0), (x1, y1) = at((field.x_range[0], field.y_range[1])), at((field.x_range[1], field.y_range[0]))
        inside.append(f'<image x="{x0:.1f}" y="{y0:.1f}" width="{x1 - x0:.1f}" height="{y1 - y0:.1f}" style="image-rendering:pixelated" '
                      f'preserveAspectRatio="none" href="{field.image(field.rows[::-1])}"/>')
        parts.append(color_bar(field, edge + across + 6, high))
    for s in series:
        color, dashed = (s.color, s.dash) if s.color else next(colors)
        if s.band:
            for area in areas(s.points, s.band):
                corners = " ".join(f"{x:.1f},{y:.1f}" for x, y in map(at, area))
                inside.append(f'<polygon points="{corners}" fill="{color}" opacity="0.25"/>')
        elif s.marks:
            rim = ' stroke="#fff" stroke-width="0.8"' if field and s.size > 2 else ""
            if s in signs:
                inside += [sign(signs[s][0], x, y, color, s.size) for x, y in map(at, finite(s.points))]
            else:
                inside += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{s.size}" fill="{color}"{rim}/>' for x, y in map(at, finite(s.points))]
        else:
            dash = ' stroke-dasharray="5 3"' if s.dash or dashed else ""
            inside += [line(piece, f'stroke="{color}" stroke-width="{broad}"{dash}') for piece in pieces(s.points)]
            if s in signs:
                inside += [sign(signs[s][0], x, y, color, s.size) for x, y in map(at, some_of(finite(s.points), signs[s][1]))]
        through = s.band and any(other.name == s.name and not other.band for other in series)
        if s.legend and s.points and not through:  # a curve through a band tells of it
            dashes = "┅" if not s.marks and (s.dash or dashed) else ""
            mark = dashes + signs[s][0] if s in signs else dashes or ("●" if s.marks else "■")
            legend.append((s.legend, f'<tspan fill="{color}">{mark}</tspan> {html.escape(s.legend)}'))
    clip = f"c{zlib.crc32(repr((title, x_label, y_label, width, height)).encode()):x}"
    parts.append(f'<clipPath id="{clip}"><rect x="{edge:.1f}" y="{TOP}" width="{across:.1f}" height="{high}"/></clipPath>'
                 f'<g clip-path="url(#{clip})">{"".join(inside)}</g>')
    parts.append(f'<rect x="{edge:.1f}" y="{TOP}" width="{across:.1f}" height="{high}" fill="none" stroke="#999"/>')
    rows = legend_rows(legend, width - edge)
    for row, names in enumerate(rows):
        parts.append(f'<text x="{edge:.1f}" y="{height + 12 + 15 * row}">{" &#160; ".join(names)}</text>')
    extra = 15 * len(rows)
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height + extra}" '
            f'viewBox="0 0 {width} {height + extra}" font-size="11" font-family="sans-serif" role="img" '
            f'aria-label="{html.escape(title)}"><rect width="100%" height="100%" fill="#fff"/>{"".join(parts)}</svg>')
