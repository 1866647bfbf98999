"""Charts as SVG, all of one family: axes with units, what was published in gray, ours in color, no scripts."""
import html
import zlib

COLORS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7f3c8d", "#11a579", "#a5aa99"]
PUBLISHED = "#555"
LEFT, BOTTOM, TOP = 52, 36, 8


class Series:
    """Points (x, y) joined by a line, or apart (`marks`); `band`: a second row of points, the area between is filled."""

    def __init__(self, name, points, color=None, marks=False, dash=False, band=None):
        self.name, self.points, self.color = name, points, color
        self.marks, self.dash, self.band = marks, dash, band


def published(name, points, **more):
    return Series(name, points, PUBLISHED, **more)


def ticks(low, high, most=7):
    """Round numbers from low to high, `most` at most."""
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


def chart(title, series, x_label, y_label, width=380, height=260, x_range=None, y_range=None, square=False):
    """An SVG's text. `square`: a unit is as long on both axes."""
    every = [p for s in series for p in list(s.points) + list(s.band or [])]
    if not every:
        return ""
    left, right = x_range or bounds([p[0] for p in every], 0.02)
    bottom, top = y_range or bounds([p[1] for p in every])
    across, high = width - LEFT - 10, height - BOTTOM - TOP
    if square:
        unit = max((right - left) / across, (top - bottom) / high)
        middle = (left + right) / 2, (bottom + top) / 2
        left, right = middle[0] - unit * across / 2, middle[0] + unit * across / 2
        bottom, top = middle[1] - unit * high / 2, middle[1] + unit * high / 2

    def at(point):
        return LEFT + across * (point[0] - left) / (right - left), TOP + high * (top - point[1]) / (top - bottom)

    def line(points, style):
        text = " ".join(f"{x:.1f},{y:.1f}" for x, y in map(at, points))
        return f'<polyline points="{text}" fill="none" {style}/>'

    parts = []
    for t in ticks(bottom, top):
        y = at((left, t))[1]
        parts.append(f'<line x1="{LEFT}" y1="{y:.1f}" x2="{width - 10}" y2="{y:.1f}" stroke="#e4e4e4"/>'
                     f'<text x="{LEFT - 5}" y="{y:.1f}" dy="4" text-anchor="end">{t:g}</text>')
    for t in ticks(left, right):
        x = at((t, bottom))[0]
        parts.append(f'<line x1="{x:.1f}" y1="{TOP}" x2="{x:.1f}" y2="{height - BOTTOM}" stroke="#f2f2f2"/>'
                     f'<text x="{x:.1f}" y="{height - BOTTOM + 14}" text-anchor="middle">{t:g}</text>')
    parts.append(f'<text x="{LEFT + across / 2:.0f}" y="{height - 4}" text-anchor="middle">{html.escape(x_label)}</text>')
    parts.append(f'<text transform="translate(11,{TOP + high / 2:.0f}) rotate(-90)" text-anchor="middle">'
                 f'{html.escape(y_label)}</text>')
    colors = iter(COLORS * 9)
    legend = []
    inside = []
    for s in series:
        color = s.color or next(colors)
        if s.band:
            corners = " ".join(f"{x:.1f},{y:.1f}" for x, y in map(at, list(s.points) + list(reversed(s.band))))
            inside.append(f'<polygon points="{corners}" fill="{color}" opacity="0.25"/>')
        elif s.marks:
            inside += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3" fill="{color}"/>' for x, y in map(at, s.points)]
        else:
            dash = ' stroke-dasharray="5 3"' if s.dash else ""
            inside.append(line(s.points, f'stroke="{color}" stroke-width="1.8"{dash}'))
        if s.name and s.points:
            legend.append(f'<tspan fill="{color}">■ {html.escape(s.name)}</tspan>')
    clip = f"c{zlib.crc32(repr((title, x_label, y_label, width, height)).encode()):x}"
    parts.append(f'<clipPath id="{clip}"><rect x="{LEFT}" y="{TOP}" width="{across}" height="{high}"/></clipPath>'
                 f'<g clip-path="url(#{clip})">{"".join(inside)}</g>')
    parts.append(f'<rect x="{LEFT}" y="{TOP}" width="{across}" height="{high}" fill="none" stroke="#999"/>')
    extra = 15 * ((len(legend) + 2) // 3)
    for row in range(0, len(legend), 3):
        parts.append(f'<text x="{LEFT}" y="{height + 12 + 5 * row}">{" &#160; ".join(legend[row:row + 3])}</text>')
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height + extra}" '
            f'viewBox="0 0 {width} {height + extra}" font-size="11" font-family="sans-serif" role="img" '
            f'aria-label="{html.escape(title)}"><rect width="100%" height="100%" fill="#fff"/>{"".join(parts)}</svg>')
