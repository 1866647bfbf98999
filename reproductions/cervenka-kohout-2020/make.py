#!/usr/bin/env python3
"""make.py OUT HERE: the page of what run.sh left in OUT: curves/SURFACE.csv and summary.csv."""
import csv
import glob
import os
import re
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "family"))
import publication  # noqa: E402
from charts import Series  # noqa: E402

# Column, what it is with its unit, and which figures of the publication show it.
CURVES = (("volume_error_percent", "error of volume, %", "Figures 11 to 13"),
          ("mean_edge_ratio", "mean edge over rest", "Figures 14 to 16"),
          ("mean_dihedral_change_deg", "mean change of dihedral angles, degrees", "Figures 17 to 19"),
          ("vertex_depth_mm", "deepest vertex in a bone, mm", "Not published"))


def rows(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def fiber_charts(page, out):
    """Figures 20 and 21: each fiber's length in every frame."""
    path = f"{out}/hip/fiber_lengths.sto"
    if not os.path.exists(path):
        page.cannot("Figures 20 and 21: lengths of fibers", "the cadaver's hip (--data), without --thin")
        return
    columns, rows_of = publication.sto_rows(path)
    for muscle, figure in (("iliacus_r", 20), ("gluteus_maximus_r", 21)):
        fibers = [i for i, name in enumerate(columns) if re.fullmatch(rf"{muscle}_f\d+", name)]
        series = [Series("fibers" if i == fibers[0] else "", [(frame, 1000 * row[i]) for frame, row in enumerate(rows_of)], "#0072b2") for i in fibers]
        page.chart(f"figure_{figure}", f"Figure {figure}: lengths of fibers, {muscle.replace('_', ' ')}", f"{len(fibers)} fibers.", series,
                   "frame", "fiber length, mm")


def main(out, here):
    page = publication.Page(
        out, "Position based dynamics (Červenka and Kohout 2020)",
        "1 rad of hip flexion in 100 frames, back in 100, and 100 of rest, for four muscles of the published cadaver, and a box between two "
        "plates; preset <code>pbd-2020</code>. The publication's curves are pictures without numbers, so what it says of them stands in the table.",
        "reproductions/cervenka-kohout-2020/run.sh")
    curves = {os.path.basename(path)[:-len(".csv")]: rows(path) for path in sorted(glob.glob(f"{out}/curves/*.csv"))}
    for column, label, figures in CURVES:
        series = [Series(name.replace("_", " "), [(int(row["frame"]), float(row[column])) for row in table])
                  for name, table in curves.items()]
        page.chart(column, f"{figures}: {label.split(',')[0]}", "Muscles: 0.01 rad of flexion a frame.", series, "frame", label)
    fiber_charts(page, out)
    for row in rows(f"{out}/summary.csv"):
        a, b = publication.number(row["published"]), publication.number(row["ours"])
        page.rows.append({"source": row["source"], "quantity": f"{row['muscle']}: {row['quantity']}".replace("_", " "), "unit": row["unit"],
                          "published": row["published"], "ours": row["ours"], "ratio": f"{b / a:.3g}" if a and b is not None else "",
                          "remark": "" if row["ours"] else "not made: the data are not here, or --thin"})
    page.cannot("Figures 1 to 8 as pictures", "its renderer; gracilis render draws any frame of OUT/hip and OUT/box")
    page.cannot("Figures 9 and 10: two ways to find fibers", "Kukačka's and Cholt's programs; gracilis render --fibers draws ours")
    page.cannot("Figure 22: muscles as lines", "it is another publication's drawing")
    page.write()


if __name__ == "__main__":
    main(*sys.argv[1:3])
