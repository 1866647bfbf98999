"""Attachment areas from points around them (chapter 2, section 5.11)."""
import statistics

from charts import PUBLISHED, Series, published
from runs import groups, table

FOUND = 99.9  # %: all links of an outline
SETS = {"measured": "cadaver", "patches": "leg"}


def whole(rows):
    return 100 * sum(row["links_percent"] > FOUND for row in rows) / len(rows)


def shares(page, outlines, curves):
    bound = page.value("attachments")
    numbered = "; ".join(f"{i} {name}" for i, name in enumerate(curves, 1))
    for figure, of in (("whole", whole), ("links", lambda rows: statistics.mean(row["links_percent"] for row in rows))):
        series = [published(f"published best, {bound} %", [(1, bound), (len(curves), bound)])]
        for name, rows in groups(outlines, "set").items():
            by_curve = groups(rows, "curve")
            series.append(Series(f"{SETS[name]} ({len(by_curve[curves[0]])})", [(i, of(each)) for i, each in enumerate(by_curve.values(), 1)], marks=True))
        page.draw(f"figure_5_11_{figure}", series, {"curves": numbered})


def drawn(page):
    """Figure 5.11."""
    points = {curve: [(row["x_mm"], row["y_mm"]) for row in rows] for curve, rows in groups(table(page, "outline_curves"), "curve").items()}
    measured = points["measured"]
    for curve in ("shortest-tour", "angular"):
        page.draw(f"figure_5_11_{curve.replace('-', '_')}",
                  [Series(curve, points[curve]), Series("measured", measured, PUBLISHED, dash=True), Series("points", measured, "#222", marks=True, size=2)])


def tell(page):
    outlines = table(page, "outlines")
    if not outlines:
        page.cannot("Figure 5.11, section 5.11: attachment outlines", "the shared data, lhdl-hip and leg/patches: give --data")
        return
    by_curve = groups(outlines, "curve")
    shares(page, outlines, list(by_curve))
    drawn(page)
    best = max(by_curve, key=lambda curve: whole(by_curve[curve]))
    page.put("attachments", whole(by_curve[best]), curve=best, outlines=len(by_curve[best]))
    page.put("curves", len(by_curve))
    for curve, rows in by_curve.items():
        known = [row for row in rows if row["found_percent"] is not None]
        if known:
            page.put(f"area_{curve}", statistics.mean(row["found_percent"] for row in known), beside=statistics.mean(row["beside_percent"] for row in known))
    surfaces = table(page, "attachment_surfaces")
    if surfaces:
        page.draw("attachment_surfaces", [Series(which, [(row["points"], row[f"{which}_mm"]) for row in surfaces], marks=True) for which in ("mean", "largest")])
        page.put("attachment_surfaces", statistics.median(row["mean_mm"] for row in surfaces), patches=len(surfaces))
