"""Attachment areas from points around them (chapter 2, section 5.11)."""
import statistics

from charts import Series, published
from tables import groups

FOUND = 99.9  # %: all links of an outline


def add_to(results):
    table = results.table("outlines")
    if not table:
        results.page.cannot("Figure 5.11, section 5.11: attachment outlines", "the shared data, lhdl-hip and leg/patches: give --data")
        return
    sets = {"measured": "cadaver", "patches": "leg"}
    curves = list(groups(table, "curve"))
    numbered = "; ".join(f"{i} {name}" for i, name in enumerate(curves, 1))
    bound = float(results.told("attachments"))
    best = [published(f"published best, {bound} %", [(1, bound), (len(curves), bound)])]
    for figure, title, remark, value in (
            ("figure_5_11_whole", "Section 5.11: outlines found as a whole", "Share of the outlines whose points are put in order without a mistake, from any order: ",
             lambda rows: 100 * sum(row["links_percent"] > FOUND for row in rows) / len(rows)),
            ("figure_5_11_links", "Section 5.11: links found", "Mean share of the links from point to point that are found again: ",
             lambda rows: statistics.mean(row["links_percent"] for row in rows))):
        shown = [Series(f"{sets[name]} ({len(groups(rows, 'curve')[curves[0]])})",
                        [(i, value(of)) for i, of in enumerate(groups(rows, "curve").values(), 1)], marks=True)
                 for name, rows in groups(table, "set").items()]
        results.page.chart(figure, title, remark + numbered + ". Outlines that were measured on the cadaver, and rims of the leg's attachment patches.", best + shown, "curve", "found, %", y_range=(0, 105), width=480)
    drawn = groups(results.table("outline_curves"), "curve")
    told = [(row["x_mm"], row["y_mm"]) for row in drawn["measured"]]
    for curve, remark in (("shortest-tour", "the shortest closed tour"), ("angular", "by angle around the middle")):
        found = [(row["x_mm"], row["y_mm"]) for row in drawn[curve]]
        results.page.chart(f"figure_5_11_{curve.replace('-', '_')}", f"Figure 5.11: {curve}", "The origin of the cadaver's gluteus medius, its points put in order from any other: "
                           f"{remark}. Gray: as measured; both seen along the normal of the points' plane.",
                           [Series(curve, found), published("measured", told, dash=True), Series("", told, "#222", marks=True, size=2)],
                           "along, mm", "across, mm", square=True)
    whole = {curve: 100 * sum(row["links_percent"] > FOUND for row in rows) / len(rows) for curve, rows in groups(table, "curve").items()}
    first = max(whole, key=whole.get)
    results.put("attachments", whole[first], f"{first}; {len(table) // len(curves)} outlines. The report does not say what its accuracy measures")
    results.put("curves", len(curves), "the report does not name its fifteen")
    for curve in curves:
        rows = [row for row in table if row["curve"] == curve and row["found_percent"] is not None]
        if rows:
            results.add("section 5.11", f"area found by {curve}, mean of the cadaver's outlines", "%", statistics.mean(row["found_percent"] for row in rows),
                        f"and {statistics.mean(row['beside_percent'] for row in rows):.1f} % beside it")
    surfaces = results.table("attachment_surfaces")
    if surfaces:
        results.page.chart("attachment_surfaces", "Section 5.11: surfaces bounded by outlines", "Thin plates through an outline's points over its plane, beside the patch that "
                           "it bounds.", [Series("mean", [(row["points"], row["mean_mm"]) for row in surfaces], marks=True),
                                          Series("largest", [(row["points"], row["largest_mm"]) for row in surfaces], marks=True)],
                           "points of the outline", "distance, mm")
        results.add("section 5.11", "surfaces bounded by outlines: median of mean distances", "mm", statistics.median(row["mean_mm"] for row in surfaces),
                    f"{len(surfaces)} patches")
