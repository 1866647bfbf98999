#!/usr/bin/env python3
"""make.py OUT HERE [--complete]: the page, results.csv and figures from the tables and runs in OUT."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "family"))
import publication  # noqa: E402

import areas  # noqa: E402
import functions  # noqa: E402
import heights  # noqa: E402
import muscles  # noqa: E402
from tables import Results  # noqa: E402


def main(out, here, *options):
    page = publication.Page(
        out, "Radial basis functions for muscles (Červenka 2024)",
        "The report tells what its author's papers found, seldom in numbers, and draws signals and muscles that are not given. Here the "
        "same questions are put to this project's functions, on signals, height fields and a hip that are defined in its sources, and on "
        "the cadaver's gluteus maximus and attachments where the data are there. Errors in % are mean squared errors over the variance of what is approximated.",
        "reproductions/cervenka-2024/run.sh")
    results = Results(out, page, publication.read_published(f"{here}/published.csv"))
    for part in (functions, heights, muscles, areas):
        part.add_to(results)
    page.rows = publication.beside(results.published, results.ours, results.remarks) + page.rows
    for what, why in (
            ("Figures 2.1 and 2.2: CT, MRI, a cryosection", "the Visible Human's images"),
            ("Figure 3.1: curves through points", "the points; curves are not this project's"),
            ("Figures 4.1 to 4.3: muscles as lines", "they are other publications' drawings"),
            ("Figure 4.4: a mass-spring system", "the same; see the page of Janák 2012"),
            ("Figures 5.1 to 5.3, 5.5 and 5.6 as published", "the papers' signals and height fields, which the report does not define"),
            ("Figure 5.7's values", "the color scale's numbers and the range of the shape parameter, which its text does not tell"),
            ("Figure 5.9: steps of elimination without division", "a solver without division, which this project has not: its systems are solved by Eigen's factors"),
            ("Figure 5.10: response to a collision", "nothing: it is a drawing; the response is that of the page of Havlíček 2024"),
            ("Figure 5.12: virtual edges", "the published muscle; scenes/lhdl_hip/flexion_thesis_2024.toml has such edges"),
            ("Section 5.11: 78.74 % on the same outlines", "TLEM 2.0's points and the measure of accuracy, which the report does not define; seven of the fifteen curves"),
            ("Section 4.5 to 4.7: frames of other publications", "those publications' programs")):
        page.cannot(what, why)
    page.write(complete="--complete" in options)


if __name__ == "__main__":
    main(*sys.argv[1:])
