#!/usr/bin/env python3
"""compare.py VALIDATION SWEEPS OUT METHOD... [--complete]: OUT/table.csv, a row per method and published curve, and OUT/index.html."""
import csv
import math
import sys

import page
from curves import arms_of_method, at, published

COLUMNS = ["method", "coordinate", "over", "muscle", "source", "angles", "from_deg", "to_deg", "rms_mm", "largest_mm",
           "coverage_percent", "largest_step_mm_per_deg"]


def coverage(curve, band):
    """How much of the band's area, over the angles that both have, lies between the least and the largest fiber; in
    percent. None without such angles."""
    shared = whole = 0
    for angle, low in curve.low:
        bottom, top = at(band.low, angle), at(band.high, angle)
        high = at(curve.high, angle)
        if None in (bottom, top, high):
            continue
        whole += max(0, top - bottom)
        shared += max(0, min(top, high) - max(bottom, low))
    return 100 * shared / whole if whole > 0 else None


def largest_step(points):
    return max(abs((y1 - y0) / (x1 - x0)) for (x0, y0), (x1, y1) in zip(points, points[1:]))


def compared(curve, reference):
    """A row of the table; None where the two have no angle in common. Beside bounds alone, how far the mean is beyond."""
    errors, angles = [], []
    for angle, arm in curve.mean:
        if reference.mean:
            there = at(reference.mean, angle)
            error = None if there is None else arm - there
        else:
            low, high = at(reference.low, angle), at(reference.high, angle)
            error = None if low is None or high is None else max(0, low - arm) + max(0, arm - high)
        if error is not None:
            errors.append(error)
            angles.append(angle)
    if not errors:
        return None
    covered = None if reference.mean else coverage(curve, reference)
    return dict(zip(COLUMNS, [
        curve.source, curve.coordinate, curve.over, curve.muscle, reference.source, len(errors), f"{min(angles):g}",
        f"{max(angles):g}", f"{math.sqrt(sum(e * e for e in errors) / len(errors)):.2f}",
        f"{max(abs(e) for e in errors):.2f}", "" if covered is None else f"{covered:.1f}",
        f"{largest_step(curve.mean):.2f}"]))


def tell_lacks(table, methods):
    """Ends with exit code 1 where a method has no row beside a curve that others have one beside."""
    compared_with = {method: {tuple(row[key] for key in COLUMNS[1:5]) for row in table if row["method"] == method} for method in methods}
    lacks = [f"not made: {method} {' '.join(key)}" for method in methods for key in sorted(set().union(*compared_with.values()) - compared_with[method])]
    if lacks:
        sys.exit("\n".join(lacks))


def main(validation, sweeps, out, methods, complete):
    references = published(validation)
    by_method = {method: arms_of_method(sweeps, method) for method in methods}
    # What was published of the cadaver's fibers stands beside the methods.
    cadaver = [curve for curve in references if curve.mean and curve.low]
    table = []
    for curves in [cadaver] + list(by_method.values()):
        for curve in curves:
            for reference in references:
                same = [getattr(curve, key) == getattr(reference, key) for key in ("coordinate", "over", "muscle")]
                row = compared(curve, reference) if all(same) and curve is not reference else None
                if row:
                    table.append(row)
    with open(f"{out}/table.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS)
        writer.writeheader()
        writer.writerows(table)
    told = {row["source"] + row["coordinate"] + row["muscle"] for row in table}
    missing = [reference for reference in references if reference.source + reference.coordinate + reference.muscle not in told]
    for reference in missing:
        print(f"no scene for {reference.muscle} about {reference.coordinate} ({reference.source})", file=sys.stderr)
    with open(f"{out}/index.html", "w") as file:
        file.write(page.page(out, references, by_method, table, missing))
    if complete:
        tell_lacks(table, methods)


if __name__ == "__main__":
    main(*sys.argv[1:4], [word for word in sys.argv[4:] if word != "--complete"], "--complete" in sys.argv)
