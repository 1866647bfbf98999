#!/usr/bin/env python3
"""make.py OUT HERE MODEL [--complete]: the page, results.csv and figures from what run.sh left in OUT."""
import csv
import glob
import json
import math
import os
import statistics
import sys
import tomllib

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "family"))
import publication  # noqa: E402
from charts import Series, published  # noqa: E402

import parameters  # noqa: E402
import sections  # noqa: E402

RAYS, SCALARS = (6, 8, 10, 12), (1, 2, 3, 4, 5, 6)


def tendon_mm(folder):
    with open(f"{folder}/model.toml", "rb") as file:
        return tomllib.load(file)["muscles"][0]["action_line"]["tendon_mm"]


def vertices(path):
    with open(path) as file:
        return sum(surface["vertices"] for surface in json.load(file))


def rows(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def frame_times(folder):
    """Milliseconds of each frame but the first, all muscles together."""
    times = {}
    for row in rows(f"{folder}/measures.csv"):
        times[int(row["frame"])] = times.get(int(row["frame"]), 0) + float(row["milliseconds"])
    return [time for frame, time in sorted(times.items()) if frame > 0]


def uncovered(corners):
    """The share of an ellipse's area that the polygon inscribed in it leaves out; the same for a circle."""
    return 1 - corners * math.sin(2 * math.pi / corners) / (2 * math.pi)


class Reproduction:
    def __init__(self, out, here, model, *options):
        self.complete = "--complete" in options
        self.out, self.here, self.model, self.ours, self.remarks = out, here, model, {}, {}
        self.page = publication.Page(
            out, "Cylinder musculotendons (Laclé 2014)",
            "The publication has 48 lines of a model of the lower limbs and an artist's surfaces, fitted by hand. Here lines are those of "
            "OpenSim's walking model (gait2392) and surfaces those of Z-Anatomy's right leg, which is not the same body; counts of "
            "centers outside therefore are of 22 muscles of one leg.",
            "reproductions/lacle-2014/run.sh")

    def tendons(self):
        self.ours["half_slack"] = tendon_mm(f"{self.out}/tendon/model") / 1000
        self.ours["half_slack_fitted"] = tendon_mm(f"{self.out}/tendon/smaller") / 1000
        self.remarks["half_slack"] = "the model's own slack length, 0.2228 m"
        parameters.add_to(self.ours, self.remarks, self.out, self.model)

    def counts(self):
        for path in glob.glob(f"{self.out}/counts/*.json"):
            key = os.path.basename(path)[:-len(".json")]
            self.ours[f"vertices_{key}"] = vertices(path)
            self.remarks[f"vertices_{key}"] = "the published model has 48 via points; this one's lines bend around surfaces, too"

    def slices(self):
        with open(f"{self.out}/slices.json") as file:
            surfaces = json.load(file)
        self.ours["vertices_surfaces"] = sum(s["vertices"] for s in surfaces)
        self.remarks["vertices_surfaces"] = f"{len(surfaces)} muscles of one leg; published: 48 of both"
        found = [s for surface in surfaces for s in surface["slices"] if s["outlines"] > 0]
        quotients = [s["isoperimetric_quotient"] for s in found]
        concave = sum(not s["convex"] for s in found)
        self.ours.update(slices=len(found), round_share=100 * sum(q > 0.5 for q in quotients) / len(found),
                         concave_share=f"{concave} of {len(found)}", median_quotient=statistics.median(quotients),
                         mean_less_median=statistics.mean(quotients) - statistics.median(quotients))
        for key in ("round_share", "median_quotient", "mean_less_median"):
            self.remarks[key] = "another body's surfaces"
        if concave == len(found):
            self.remarks["concave_share"] = "a slice through coarse triangles has a corner that turns the other way"
        split = {True: [], False: []}
        for s in found:  # normalized to an area of 1
            split[s["convex"]].append((s["perimeter_mm"] / math.sqrt(s["area_mm2"]), s["isoperimetric_quotient"]))
        self.page.chart("figure_3_15a", "Figure 3.15 a", "Slices across the leg's muscles at a quarter, half and three quarters of their "
                        "length. With an area of 1 the quotient follows from the perimeter alone.",
                        [Series("concave", split[False], marks=True), Series("convex", split[True], marks=True)],
                        "perimeter at an area of 1", "isoperimetric quotient")
        outlines = []
        for s in found:
            size = math.sqrt(s["area_mm2"])
            outline = [(x / size, y / size) for x, y in s["outline_mm"]]
            outlines.append(Series("", outline + outline[:1], "#0072b2"))
        self.page.chart("figure_3_15b", "Figure 3.15 b", "The same slices over each other, about their centroids, with an area of 1.",
                        outlines, "x at an area of 1", "y", square=True)

    def polygons(self):
        shares = [(n, 100 * uncovered(n)) for n in (3, 4, 5, 6, 8, 10, 12)]
        self.page.chart("figure_3_22", "Figure 3.22", "What a polygon inscribed in a circle leaves out, which is the same of an ellipse whose "
                        "polygon is stretched with it. Six corners are the publication's lower bound.",
                        [Series("ours", shares), Series("", shares, "#0072b2", marks=True)], "corners", "area left out, %")

    def outside(self):
        totals, curves = {}, {}
        for path in glob.glob(f"{self.out}/outside/*/surfaces.csv"):
            level, scalar, count = map(int, os.path.basename(os.path.dirname(path)).split("_"))
            table = rows(path)
            key = f"outside_{level}_{scalar}_{count}"
            self.ours[key] = sum(int(r["of_these_centers_outside"]) for r in table)
            totals[level] = sum(int(r["that_cut_the_surface"]) for r in table)
            self.remarks[key] = f"of {totals[level]} sections of 22 muscles; another body's surfaces"
            curves.setdefault(level, {}).setdefault(count, []).append((scalar, 100 * self.ours[key] / totals[level]))
        for level, total in totals.items():
            self.ours[f"sections_{level}"] = total
            self.remarks[f"sections_{level}"] = "sections whose plane cuts the surface"
        values = {row["key"]: float(row["published"]) for row in self.published if row["published"].replace(".", "").isdigit()}
        for level, by_count in sorted(curves.items()):
            of_all = values[f"sections_{level}"]
            shown = [published("published" if n == RAYS[0] else "",
                               [(s, 100 * values[f"outside_{level}_{s}_{n}"] / of_all) for s in SCALARS], dash=n != 6)
                     for n in RAYS]
            shown += [Series(f"{n} corners", sorted(points)) for n, points in sorted(by_count.items())]
            self.page.chart(f"table_5_{level + 1}", f"Table 5.{level + 1} as curves",
                            f"Centers that the heuristic leaves outside of the surface, of all sections; LSS {level}. Gray, from above: "
                            "published for 6, 8, 10 and 12 corners.", shown, "times as many rays (CSS)", "centers outside, %")
        with open(f"{self.out}/enhanced36.seconds") as file:
            self.ours["enhancement_seconds"] = float(file.read())
        self.remarks["enhancement_seconds"] = "with reading the model and 22 surfaces; published: 48 muscles"
        mended = sum(int(r["of_these_centers_outside"]) for r in rows(f"{self.out}/mended/surfaces.csv"))
        self.page.rows.append({"source": "Table 5.3", "quantity": "the same with this project's mending, LSS 2, CSS 1, 6 corners",
                               "unit": "", "published": "", "ours": str(mended), "ratio": "", "remark": "import --centers mended"})

    def planes(self):
        """Figure 3.9 tells what each way is, without numbers."""
        for planes, figure in (("fixed", "3.9a"), ("forward", "3.9b"), ("centered", "3.9c")):
            table = rows(f"{self.out}/planes/{planes}/surfaces.csv")
            cut, outside = (sum(int(r[c]) for r in table) for c in ("that_cut_the_surface", "of_these_centers_outside"))
            for quantity, value in ((f"sections that {planes} planes cut", cut), (f"centers outside by {planes} planes", outside)):
                self.page.rows.append({"source": f"Figure {figure}", "quantity": f"{quantity}, LSS 1, CSS 6, 12 corners", "unit": "",
                                       "published": "", "ours": str(value), "ratio": "", "remark": f"import --planes {planes}"})

    def speed(self):
        for key, run, remark in (("fps_all", "walk8", "calculation alone, one core, nothing is drawn"),
                                 ("fps_36", "walk36", "calculation alone"), ("fps_collision", "yielding", "calculation alone")):
            times = frame_times(f"{self.out}/run_{run}")
            self.ours[key] = 1000 / statistics.median(times)
            self.remarks[key] = remark
        measures = rows(f"{self.out}/run_yielding/measures.csv")
        rounds, stuck, held = {}, {}, set()
        for row in measures:
            frame = int(row["frame"])
            rounds[frame] = max(rounds.get(frame, 0), int(float(row["collision_rounds"])))
            stuck[frame] = stuck.get(frame, 0) + int(float(row["unresolved_transversals"]))
            if float(row["unresolved_transversals"]) > 0:
                held.add(row["muscle"])
        frames = sorted(f for f in rounds if f > 0)
        own = [int(float(row["collision_rounds"])) for row in measures if row["muscle"] == "vas_int_r" and int(row["frame"]) > 0]
        self.ours["rounds"] = f"{min(own)} to {max(own)}"
        self.remarks["rounds"] = f"of vastus intermedius, over the walk. Not free after 60: {max(stuck.values())} of 25 at most, " \
                                 f"in {sum(stuck[f] > 0 for f in frames)} of {len(frames)} frames ({', '.join(sorted(held))})"
        self.page.chart("figure_5_6", "Figure 5.6, over a walk", "Rounds until all of a muscle's sections are free, the most of any muscle, "
                        "and transversals that are not free after 60. Published: three sections of vastus intermedius in 8, 4 and 6 rounds.",
                        [Series("rounds", [(f, rounds[f]) for f in frames]),
                         Series("vastus intermedius", list(zip(frames, own))),
                         Series("not free", [(f, stuck[f]) for f in frames])], "frame", "rounds, transversals")

    def inner_points(self):
        sections.add_to(self.page, self.ours, self.out)

    def make(self):
        self.published = publication.read_published(f"{self.here}/published.csv")
        for part in (self.tendons, self.counts, self.slices, self.polygons, self.outside, self.planes, self.inner_points, self.speed):
            part()
        self.page.rows = publication.beside(self.published, self.ours, self.remarks) + self.page.rows
        self.page.cannot("Figures 3.5 to 3.7: the skeleton in the character Ralph", "the character's skin and bones")
        self.page.pictures(self.here)
        self.page.cannot("Figures 5.2 to 5.4 of the publication's own muscles", "the surfaces of the Ultimate Human Model (commercial); the shared leg's stand in")
        self.page.cannot("Figure 5.2's matches (yellow)", "import tells inner points, not the rays' matches that they are from")
        self.page.cannot("Figure 3.22's numbers", "the figure itself: its text does not tell them")
        self.page.cannot("Table 3.4: the order of matches", "nothing: it is an algorithm's; tests/anatomy/section_enhancement_test.cpp holds it")
        self.page.cannot("Frames per second with drawing", "the publication's graphics card and character")
        self.page.write(self.complete)


if __name__ == "__main__":
    Reproduction(*sys.argv[1:]).make()
