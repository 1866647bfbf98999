"""One page of charts and the table, without scripts."""
import html

COLORS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7f3c8d", "#11a579", "#a5aa99"]
STYLE = """body{font:15px/1.5 sans-serif;max-width:1100px;margin:2em auto;padding:0 1em;color:#222}
.charts{display:flex;flex-wrap:wrap;gap:12px}figure{margin:0}figcaption{font-weight:600}svg{background:#fff}
table{border-collapse:collapse;font-size:13px}td,th{padding:2px 8px;border-bottom:1px solid #ddd;text-align:right}
td.word,th.word{text-align:left}.key{display:inline-block;width:22px;height:4px;margin:0 5px 3px 14px}"""
WIDTH, HEIGHT, LEFT, BOTTOM = 340, 230, 44, 26


def ticks(low, high):
    for step in (1, 2, 5, 10, 20, 50, 100):
        if (high - low) / step <= 7:
            break
    first = int(low // step) * step
    return [t for t in range(first, int(high) + step, step) if low <= t <= high]


def chart(name, references, curves):
    """`curves`: (color, curve). References are gray, bands filled."""
    every = [p for c in references for p in c.mean + c.low + c.high] + [p for _, c in curves for p in c.mean]
    angles = [p[0] for _, c in curves for p in c.mean] or [p[0] for p in every]
    left, right = min(angles), max(angles)
    shown = [p for p in every if left <= p[0] <= right]
    bottom, top = min(p[1] for p in shown), max(p[1] for p in shown)
    bottom, top = bottom - 0.05 * (top - bottom) - 0.5, top + 0.05 * (top - bottom) + 0.5

    def place(point):
        x = LEFT + (WIDTH - LEFT - 8) * (point[0] - left) / max(right - left, 1e-9)
        return f"{x:.1f},{(HEIGHT - BOTTOM) * (1 - (point[1] - bottom) / (top - bottom)) + 4:.1f}"

    def line(points, style):
        return f'<polyline points="{" ".join(place(p) for p in points if left <= p[0] <= right)}" fill="none" {style}/>'

    parts = []
    for t in ticks(bottom, top):
        parts.append(line([(left, t), (right, t)], 'stroke="#eee"'))
        parts.append(f'<text x="{LEFT - 5}" y="{place((left, t)).split(",")[1]}" text-anchor="end" dy="4">{t}</text>')
    for t in ticks(left, right):
        parts.append(f'<text x="{place((t, bottom)).split(",")[0]}" y="{HEIGHT - 2}" text-anchor="middle">{t}</text>')
    for c in references:
        if c.low:
            corners = [p for p in c.low if left <= p[0] <= right] + [p for p in reversed(c.high) if left <= p[0] <= right]
            color = "#bbb" if c.mean else "#f0c987"
            parts.append(f'<polygon points="{" ".join(map(place, corners))}" fill="{color}" opacity="0.35"/>')
    for c in references:
        if c.mean:
            dash = "" if c.low else 'stroke-dasharray="5 3"'
            parts.append(line(c.mean, f'stroke="#555" stroke-width="2" {dash}'))
    for color, c in curves:
        parts.append(line(c.mean, f'stroke="{color}" stroke-width="2"'))
    return (f'<figure><figcaption>{html.escape(name)}</figcaption><svg width="{WIDTH}" height="{HEIGHT}" '
            f'font-size="11">{"".join(parts)}</svg></figure>')


def charts(references, by_method):
    found = {}
    for c in references:
        found.setdefault((c.coordinate, c.over, c.muscle), []).append(c)
    drawn = []
    for (coordinate, over, muscle), shown in found.items():
        curves = [(COLORS[i % len(COLORS)], c) for i, of_method in enumerate(by_method.values()) for c in of_method
                  if (c.coordinate, c.over, c.muscle) == (coordinate, over, muscle)]
        if curves:
            where = coordinate if over == coordinate else f"{coordinate} over {over}"
            drawn.append(chart(f"{muscle.replace('_', ' ')}: {where}", shown, curves))
    return "".join(drawn)


def table_of(table):
    columns = list(table[0]) if table else []
    words = {"method", "coordinate", "over", "muscle", "source"}
    kind = {c: ' class="word"' if c in words else "" for c in columns}
    head = "".join(f"<th{kind[c]}>{c.replace('_', ' ')}</th>" for c in columns)
    body = "".join("<tr>" + "".join(f"<td{kind[c]}>{html.escape(str(row[c]))}</td>" for c in columns) + "</tr>"
                   for row in table)
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


def page(references, by_method, table):
    legend = "".join(f'<span class="key" style="background:{COLORS[i % len(COLORS)]}"></span>{html.escape(method)}'
                     for i, method in enumerate(by_method))
    return f"""<!doctype html><html lang="en"><meta charset="utf-8"><title>Moment arms beside published ones</title>
<style>{STYLE}</style><h1>Moment arms beside published ones</h1>
<p>Arms in mm over angles in degrees, the mean of each muscle's fibers. Gray: the cadaver's fibers as published (band: all of them).
Dashed: measured, or of models. Orange: the band between the bounds of finite elements (another subject).
Coverage: the share of that band's area that lies between a muscle's least and largest fiber. Beside bounds the root mean square
is of how far the mean lies beyond them.</p><p>{legend}</p><div class="charts">{charts(references, by_method)}</div>
<h2>All of it</h2>{table_of(table)}</html>
"""
