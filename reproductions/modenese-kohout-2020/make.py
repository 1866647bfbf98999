"""Every method's moment arms beside every published and measured curve."""
import csv
import math

from charts import COLORS, Series, bounds
from charts import published as published_curve
from curves import arms_of_method, at, published
from publication import matching

COLUMNS = ["method", "coordinate", "over", "muscle", "source", "angles", "from_deg", "to_deg", "published_mm", "ours_mm", "rms_mm", "largest_mm",
           "coverage_percent", "largest_step_mm_per_deg"]
AMONG = ("coordinate", "over", "muscle")


def key_of(curve):
    return tuple(getattr(curve, name) for name in AMONG)


def coverage(curve, band):
    """How much of the band's area, over the angles that both have, lies between the least and the largest fiber, in percent."""
    shared = whole = 0
    for angle, low in curve.low:
        bottom, top, high = at(band.low, angle), at(band.high, angle), at(curve.high, angle)
        if None not in (bottom, top, high):
            whole += max(0, top - bottom)
            shared += max(0, min(top, high) - max(bottom, low))
    return 100 * shared / whole if whole > 0 else None


def compared(curve, reference):
    """A row of the table; None where the two have no angle in common. Beside bounds alone, how far the mean is beyond."""
    low, high = (reference.mean, reference.mean) if reference.mean else (reference.low, reference.high)
    both = [(angle, arm, at(low, angle), at(high, angle)) for angle, arm in curve.mean]
    both = [row for row in both if None not in row]
    if not both:
        return None
    errors = [max(0, bottom - arm) + max(0, arm - top) for _, arm, bottom, top in both]
    covered = None if reference.mean else coverage(curve, reference)
    step = max(abs((y1 - y0) / (x1 - x0)) for (x0, y0), (x1, y1) in zip(curve.mean, curve.mean[1:]))
    return dict(zip(COLUMNS, [
        curve.source, *key_of(curve), reference.source, len(both), f"{both[0][0]:g}", f"{both[-1][0]:g}",
        f"{sum(bottom + top for *_, bottom, top in both) / len(both) / 2:.2f}", f"{sum(arm for _, arm, *_ in both) / len(both):.2f}",
        f"{math.sqrt(sum(e * e for e in errors) / len(both)):.2f}", f"{max(errors):.2f}", "" if covered is None else f"{covered:.1f}", f"{step:.2f}"]))


def where(curve):
    return curve.coordinate if curve.over == curve.coordinate else f"{curve.coordinate}_over_{curve.over}"


def row_of(page, row):
    """What the page says of a row of the table."""
    said = f"Root mean square {row['rms_mm']} mm, {row['largest_mm']} at most, {row['angles']} angles from {row['from_deg']} to {row['to_deg']}"
    said += f"; covers {row['coverage_percent']} %. " if row["coverage_percent"] else ". "
    sentences = [matching(page.words[table], key)[1] for table, key in (("published", f"{row['coordinate']} {row['source']} {row['muscle']}"), ("methods", f"{row['method']} {row['coordinate']} {row['muscle']}"))]
    over = "" if row["over"] == row["coordinate"] else f" over {row['over']}"
    ratio = "" if abs(float(row["published_mm"])) < 1 else f"{float(row['ours_mm']) / float(row['published_mm']):.3g}"
    return {"source": row["source"], "quantity": f"{row['muscle']}, {row['coordinate']}{over}, {row['method']}".replace("_", " "), "unit": "mm",
            "published": row["published_mm"], "ours": row["ours_mm"], "ratio": ratio, "remark": said + " ".join(sentences)}


def draw(page, references, curves):
    """A chart of one muscle about one coordinate. References are gray, bands filled."""
    every = [point for c in references for point in c.mean + c.low + c.high] + [point for _, c in curves for point in c.mean]
    angles = [point[0] for _, c in curves for point in c.mean]
    x_range = min(angles), max(angles)
    series = [published_curve(c.source, c.low, color="#bbb" if c.mean else COLORS[4], band=c.high) for c in references if c.low]
    series += [published_curve(c.source, c.mean, dash=not c.low) for c in references if c.mean]
    series += [Series(c.source, c.mean, color) for color, c in curves]
    first = references[0]
    words = {"muscle": first.muscle, "where": where(first), "over": first.over}
    page.draw(f"{first.muscle}_{where(first)}", series, {key: word.replace("_", " ") for key, word in words.items()}, x_range=x_range,
              y_range=bounds([y for x, y in every if x_range[0] <= x <= x_range[1]]))


def make(page):
    references = published(f"{page.data}/validation")
    by_method = arms_of_method(f"{page.out}/sweeps")
    # What was published of the cadaver's fibers stands beside the methods.
    curves = [c for c in references if c.mean and c.low] + [c for of_method in by_method.values() for c in of_method]
    table = [row for c in curves for r in references if key_of(c) == key_of(r) and c is not r and (row := compared(c, r))]
    with open(f"{page.out}/table.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS)
        writer.writeheader()
        writer.writerows(table)
    page.rows = [row_of(page, row) for row in table]
    for row in table:
        if row["method"].startswith("Modenese") and row["coordinate"] == "hip_flexion_r" and row["coverage_percent"]:
            page.put(f"coverage_{row['muscle']}", float(row["coverage_percent"]))
    colors = dict(zip(by_method, COLORS))
    for key in dict.fromkeys(map(key_of, references)):
        about = [r for r in references if key_of(r) == key]
        ours = [(colors[method], c) for method, of_method in by_method.items() for c in of_method if key_of(c) == key]
        if ours:
            draw(page, about, ours)
        else:
            page.cannot(f"{about[0].muscle}: {where(about[0])} ({', '.join(r.source for r in about)})", "a scene with that muscle and coordinate, or a full pass")
    lacks(page, table, by_method)


def lacks(page, table, by_method):
    """A method has no row beside a curve that others have one beside."""
    beside = {method: {tuple(row[name] for name in COLUMNS[1:5]) for row in table if row["method"] == method} for method in by_method}
    page.lacks += [f"{method}: {' '.join(key)}" for method in by_method for key in sorted(set().union(*beside.values()) - beside[method])]
