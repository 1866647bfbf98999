#!/usr/bin/env python3
"""make.py OUT HERE [--complete]: the page of what run.sh left in OUT: curves/SURFACE.csv and summary.csv."""
import csv
import glob
import os
import re
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "family"))
import publication  # noqa: E402
from charts import Series  # noqa: E402

# Column, what it is with its unit, and which figures of the publication show it: of the box, of iliacus and of gluteus maximus.
CURVES = (("volume_error_percent", "error of volume, %", 11),
          ("mean_edge_ratio", "mean edge over rest", 14),
          ("mean_dihedral_change_deg", "mean change of dihedral angles, degrees", 17),
          ("vertex_depth_mm", "deepest vertex in a bone, mm", None))
SHOWN = ("box", "iliacus_r", "gluteus_maximus_r")
TOLD = {"volume_error_percent": "Below 1 % of muscles as published; the box is squeezed and comes back.",
        "mean_edge_ratio": "Gluteus maximus lengthens and comes back, iliacus stays longer, as published; the box stays longer, the published one does not tell.",
        "mean_dihedral_change_deg": "Most pairs of triangles keep their angle, as published."}
REMARKS = {"frames_per_second": "one muscle's share of this machine's time, with measures; published: one core of 2013",
           "volume_error_in_frame_100": "nothing of its volume has room between plates twice as wide",
           "mean_edge_ratio_in_frame_300 box": "dihedrals that were pushed through flat keep their angle on the wrong side, which eq. 4 does not tell",
           "mean_edge_ratio_in_frame_200": "its fold at the ischium opens slowly"}


def rows(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def remark_on(row):
    if not row["ours"]:
        return "not made: the data are not here, or --thin"
    return REMARKS.get(f"{row['quantity']} {row['muscle']}", REMARKS.get(row["quantity"], ""))


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


def main(out, here, *options):
    page = publication.Page(
        out, "Position based dynamics (Červenka and Kohout 2020)",
        "1 rad of hip flexion in 100 frames, back in 100, and 100 of rest, for four muscles of the published cadaver, and a box between two "
        "plates; preset <code>pbd-2020</code>. The publication's curves are pictures without numbers, so what it says of them stands in the table.",
        "reproductions/cervenka-kohout-2020/run.sh")
    curves = {os.path.basename(path)[:-len(".csv")]: rows(path) for path in sorted(glob.glob(f"{out}/curves/*.csv"))}
    for column, label, first in CURVES:
        points = {name: [(int(row["frame"]), float(row[column])) for row in table] for name, table in curves.items()}
        for number, name in enumerate(SHOWN):
            if first and name in points:
                page.chart(f"figure_{first + number}", f"Figure {first + number}: {label.split(',')[0]}, {name.replace('_', ' ')}", TOLD[column],
                           [Series(name.replace("_", " "), points[name])], "frame", label)
        page.chart(column, f"All beside each other: {label.split(',')[0]}", "Muscles: 0.01 rad of flexion a frame.",
                   [Series(name.replace("_", " "), each) for name, each in points.items()], "frame", label)
    fiber_charts(page, out)
    for row in rows(f"{out}/summary.csv"):
        a, b = publication.number(row["published"]), publication.number(row["ours"])
        page.rows.append({"source": row["source"], "quantity": f"{row['muscle']}: {row['quantity']}".replace("_", " "), "unit": row["unit"],
                          "published": row["published"], "ours": row["ours"], "ratio": f"{b / a:.3g}" if a and b is not None else "",
                          "remark": remark_on(row)})
    page.pictures(here)
    page.cannot("Figures 9 and 10 by Kukačka's and Cholt's algorithms", "those programs; the pictures show fibers by this project's fields")
    page.cannot("Numbers of Figures 11 to 21", "the curves' values: the text tells what the table has of them")
    page.cannot("Figure 22: muscles as lines", "it is another publication's drawing")
    page.write(complete="--complete" in options)


if __name__ == "__main__":
    main(*sys.argv[1:])
