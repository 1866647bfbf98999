"""One page of charts and the table, without scripts."""
import html
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "family"))
from charts import COLORS, PUBLISHED, Series, bounds, chart  # noqa: E402
from publication import STYLE, list_figures, table as table_of  # noqa: E402


def drawn_beside(title, references, curves):
    """An SVG, its series and the labels of its axes. `curves`: (color, method, curve). References are gray, bands filled."""
    every = [p for c in references for p in c.mean + c.low + c.high] + [p for _, _, c in curves for p in c.mean]
    angles = [p[0] for _, _, c in curves for p in c.mean] or [p[0] for p in every]
    left, right = min(angles), max(angles)
    series = [Series(c.source, c.low, "#bbb" if c.mean else "#e69f00", band=c.high) for c in references if c.low]
    series += [Series(c.source, c.mean, PUBLISHED, dash=not c.low) for c in references if c.mean]
    series += [Series(method, c.mean, color) for color, method, c in curves]
    unnamed = [Series("", s.points, s.color, s.marks, s.dash, s.band, s.size) for s in series]  # one legend serves all charts
    labels = "angle, degrees", "moment arm, mm"
    svg = chart(title, unnamed, *labels, width=340, height=240, x_range=(left, right),
                y_range=bounds([p[1] for p in every if left <= p[0] <= right]))
    return svg, series, *labels


def charts(references, by_method):
    """Charts by their titles."""
    found = {}
    for c in references:
        found.setdefault((c.coordinate, c.over, c.muscle), []).append(c)
    drawn = {}
    for (coordinate, over, muscle), shown in found.items():
        curves = [(COLORS[i % len(COLORS)], method, c) for i, (method, of_method) in enumerate(by_method.items()) for c in of_method
                  if (c.coordinate, c.over, c.muscle) == (coordinate, over, muscle)]
        if curves:
            where = coordinate if over == coordinate else f"{coordinate} over {over}"
            drawn[f"{muscle.replace('_', ' ')}: {where}"] = (shown, curves)
    return {title: drawn_beside(title, *what) for title, what in drawn.items()}


def page(out, references, by_method, table, missing):
    legend = "".join(f'<span class="key" style="background:{COLORS[i % len(COLORS)]}"></span>{html.escape(method)}'
                     for i, method in enumerate(by_method))
    drawn = charts(references, by_method)
    left_out = [{"curve": f"{c.muscle} about {c.coordinate}", "source": c.source, "what it would need": "a scene with that muscle and coordinate, or a full pass"}
                for c in missing]
    list_figures(out, "Moment arms of the hip (Modenese and Kohout 2020, Blemker and Delp 2005)", "reproductions/modenese-kohout-2020/run.sh", drawn)
    figures = "".join(f"<figure><figcaption><b>{html.escape(title)}</b></figcaption>{svg}</figure>" for title, (svg, *_) in drawn.items())
    return f"""<!doctype html><html lang="en"><meta charset="utf-8"><title>Moment arms beside published ones</title>
<style>{STYLE}</style><h1>Moment arms beside published ones</h1>
<p>Arms in mm over angles in degrees, the mean of each muscle's fibers. Gray: the cadaver's fibers as published (band: all of them).
Dashed: measured, or of models. Orange: the band between the bounds of finite elements (another subject).
Coverage: the share of that band's area that lies between a muscle's least and largest fiber. Beside bounds the root mean square
is of how far the mean lies beyond them.</p><p>{legend}</p><div class="figures">{figures}</div>
<h2>All of it</h2>{table_of(table)}{"<h2>What is not made</h2>" + table_of(left_out) if left_out else ""}</html>
"""
