"""One self-contained page per publication: its figures and tables, published beside ours; and what cannot be made."""
import base64
import csv
import fnmatch
import html
import json
import os
import struct
import sys

import charts
import comparing
import files
import naming
import pictures
from comparing import number

STYLE = """body{font:15px/1.5 sans-serif;max-width:1180px;margin:2em auto;padding:0 1em;color:#222}
.figures{display:flex;flex-wrap:wrap;gap:18px}figure{margin:0;max-width:100%;break-inside:avoid}figcaption{max-width:380px;font-size:13px}
figcaption b{display:block;font-size:15px}figcaption i{display:block}svg,img{background:#fff;max-width:100%;height:auto}
figure img{width:380px;max-height:560px;object-fit:contain}.broad{width:100%}.broad img{width:100%;max-height:700px;object-position:left}.broad figcaption{max-width:none}.wide{overflow-x:auto}table{border-collapse:collapse;font-size:13px}td,th{padding:2px 8px;border-bottom:1px solid #ddd;text-align:right}
td.word,th.word{text-align:left}code{background:#f4f4f4;padding:0 3px;overflow-wrap:anywhere}.thumbs figure{width:210px}.thumbs svg,.thumbs img{width:210px;height:auto}
.key{display:inline-block;width:22px;height:4px;margin:0 5px 3px 14px}"""
NOT_MADE = "not made"
UNEXPLAINED = "differs, not explained"
BROAD = 1200  # pixels from which a picture has a row of its own
COLUMNS = ["source", "quantity", "unit", "published", "ours", "ratio", "remark"]


def shown(value):
    return f"{value:.4g}" if isinstance(value, float) else "" if value is None else str(value)


def beside(published, ours, remarks=None):
    """Rows of results.csv. `published`: rows of published.csv (key, quantity, unit, published, source: its table, figure or page); `ours` and `remarks` by their keys."""
    rows = []
    for row in published:
        value = ours.get(row["key"])
        a, b = number(row["published"]), number(value)
        ratio = f"{b / a:.3g}" if a and b is not None else ""
        rows.append({"source": row["source"], "quantity": row["quantity"], "unit": row["unit"],
                     "published": row["published"], "ours": shown(value), "ratio": ratio,
                     "remark": (remarks or {}).get(row["key"], "" if value is not None else NOT_MADE)})
    return rows


def table(rows, columns=None):
    columns = columns or (list(rows[0]) if rows else [])
    word = {c: all(number(r.get(c)) is None for r in rows) for c in columns}
    kind = {c: ' class="word"' if word[c] else "" for c in columns}
    head = "".join(f"<th{kind[c]}>{html.escape(c.replace('_', ' '))}</th>" for c in columns)
    body = "".join("<tr>" + "".join(f"<td{kind[c]}>{html.escape(str(r.get(c, '')))}</td>" for c in columns) + "</tr>"
                   for r in rows)
    return f'<div class="wide"><table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table></div>'


def write_curves(path, series, x_label, y_label):
    """The points of a chart; of a band the lower ones as "CURVE (low)" and the upper ones as "CURVE (high)"."""
    with open(path, "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["curve", x_label, y_label])
        for s in series:
            curves = {f"{s.name} (low)": s.points, f"{s.name} (high)": s.band} if s.band else {s.name: s.points}
            for curve, points in curves.items():
                writer.writerows([curve.strip(), f"{x:.6g}", f"{y:.6g}"] for x, y in points)


def broad(drawn):
    """A row of its own for a picture of many panels."""
    return ' class="broad"' if drawn.startswith('<img class="broad"') else ""


class Page:
    """Collects figures and writes OUT/index.html, OUT/results.csv and, of each figure, its picture and its curves."""

    def __init__(self, out, title, about, command):
        self.out, self.title, self.about, self.command = out, title, about, command
        self.figures, self.rows, self.missing = [], [], []
        self.lacks = []  # what a complete pass would have had
        self.unexplained = []  # figures that differ, or of which nothing tells how they compare

    def chart(self, name, title, remark, series, x_label, y_label, command="", same="", differs="", **more):
        """A chart, OUT/figures/NAME.svg, and its points, NAME.csv (NAME_field.csv: what lies under them). `command`: what made its numbers, where that is not the page's.
        `same`: in what it is as published; `differs`: in what it is not, and why."""
        if not x_label or not y_label or x_label == y_label:
            raise ValueError(f"axes need names of their own: {title}")
        svg = charts.chart(title, series, x_label, y_label, **more)
        if not svg:
            self.lacks.append(title)
            return
        self._write(f"{name}.svg", svg)
        write_curves(self._path(f"{name}.csv"), series, x_label, y_label)
        field = more.get("field")
        if field:
            self._field(name, field, x_label, y_label)
        self._add(name, title, remark, svg, command, same, differs, comparing.unfollowed(series))

    def _field(self, name, field, x_label, y_label):
        """NAME_field.csv: the middle of each colored rectangle and the value there."""
        (x0, x1), (y0, y1) = field.x_range, field.y_range
        with open(self._path(f"{name}_field.csv"), "w", newline="") as file:
            writer = csv.writer(file)
            writer.writerow([x_label, y_label, field.label])
            for j, row in enumerate(field.rows):
                y = y0 + (y1 - y0) * (j + 0.5) / len(field.rows)
                writer.writerows([f"{x0 + (x1 - x0) * (i + 0.5) / len(row):.6g}", f"{y:.6g}", f"{value:.6g}"]
                                 for i, value in enumerate(row))

    def pictures(self, here):
        """All that HERE/pictures.toml lists; those that are not there are named with what they would need."""
        for entry in pictures.listed(here):
            path = pictures.picture_of(self.out, entry)
            if os.path.exists(path):
                self.picture(entry["name"], entry["title"], entry["remark"], path, pictures.command_of(entry), entry.get("same", ""), entry.get("differs", ""))
            else:
                self.lacks.append(entry["title"])
                self.cannot(entry["title"], entry["needs"])

    def picture(self, name, title, remark, path, command="", same="", differs=""):
        """A PNG, which the page holds, and what drew it (empty: the page's command)."""
        if not os.path.exists(path):
            self.lacks.append(title)
            return
        with open(path, "rb") as file:
            data = file.read()
        with open(self._path(f"{name}.png"), "wb") as file:
            file.write(data)
        encoded = base64.b64encode(data).decode()
        width, height = struct.unpack(">II", data[16:24])
        kind = ' class="broad"' if width > 2 * height or width >= BROAD else ""
        self._add(name, title, remark, f'<img{kind} alt="{html.escape(title)}" src="data:image/png;base64,{encoded}">', command, same, differs)

    def _add(self, name, title, remark, drawn, command, same, differs, unfollowed=()):
        """A figure and how it compares. One of the publication that says nothing of that is listed, and so is one whose published curves no curve of ours follows."""
        compared = [f"As published: {same}"] if same else []
        if differs:
            compared.append(f"Differs: {differs}")
        elif unfollowed or not (same or naming.is_beside(title) or not naming.named(title)):
            compared.append(": ".join([UNEXPLAINED, *unfollowed]))
            self.unexplained.append(title)
        self.figures.append((name, title, remark, drawn, command or self.command, compared))

    def cannot(self, what, why):
        self.missing.append({"of the publication": what, "what it would need": why})

    def write(self, complete=False):
        """`complete`: names what the page lacks, and ends with exit code 1 where it lacks something."""
        self.figures.sort(key=lambda figure: naming.order(figure[1]))
        with open(os.path.join(self.out, "results.csv"), "w", newline="") as file:
            writer = csv.DictWriter(file, COLUMNS)
            writer.writeheader()
            writer.writerows(self.rows)
        figures = "".join(f'<figure id="{name}"{broad(drawn)}>{drawn}<figcaption><b>{html.escape(title)}</b>{html.escape(remark)}'
                          f'{"".join(f"<i>{html.escape(line)}</i>" for line in compared)}</figcaption></figure>'
                          for name, title, remark, drawn, _, compared in self.figures)
        missing = f"<h2>What is not made</h2>{table(self.missing)}" if self.missing else ""
        with open(os.path.join(self.out, "index.html"), "w") as file:
            file.write(f"""<!doctype html><html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width"><title>{html.escape(self.title)}</title>
<style>{STYLE}</style><h1>{html.escape(self.title)}</h1><p>{self.about}</p>
<p>Made by <code>{html.escape(self.command)}</code>. Gray: published; in color: ours.</p>
<h2>Figures</h2><div class="figures">{figures}</div>
<h2>Published beside ours</h2>{table(self.rows, COLUMNS)}{missing}</html>
""")
        with open(os.path.join(self.out, "figures.json"), "w") as file:
            json.dump({"title": self.title, "command": self.command,
                       "figures": [{"name": n, "title": t, "command": c, "compared": s} for n, t, _, _, c, s in self.figures]}, file)
        lacks = self.lacks + [f"{row['source']}: {row['quantity']}" for row in self.rows if row["remark"] == NOT_MADE]
        told = [f"{UNEXPLAINED}: {title}" for title in self.unexplained] + [f"not made: {what}" for what in lacks if complete]
        if told:
            sys.exit("\n".join(told))

    def _path(self, name):
        os.makedirs(os.path.join(self.out, "figures"), exist_ok=True)
        return os.path.join(self.out, "figures", name)

    def _write(self, name, text):
        with open(self._path(name), "w") as file:
            file.write(text)


def matching(patterns, key):
    """Of a table's entries the one of this name, or the first whose name, in which * stands for anything, is the key; and its name."""
    if key in patterns:
        return key, patterns[key]
    return next(((name, entry) for name, entry in patterns.items() if fnmatch.fnmatchcase(key, name)), (None, None))


class WordedPage(Page):
    """A page whose words stand in HERE/page.toml: title, about, figures (title, remark, in what each is the `same` as published and in what it `differs`, and
    why, x and y; `every_figure`: what those have that do not say it), remarks on values that differ, what is left out for good, and what cannot be made. Names and keys may have * for anything, and words {NAME} that the caller tells."""

    def __init__(self, out, here, data):
        self.data = data
        self.words = files.read(os.path.join(here, "page.toml"))
        super().__init__(out, self.words["title"], self.words["about"], f"reproductions/{os.path.basename(here)}/run.sh")
        self.published = files.read(os.path.join(here, "published.csv"))
        self.ours, self.told, self.drawn = {}, {}, set()
        for entry in self.words.get("not_made", []):
            self.cannot(entry["what"], entry["needs"])

    def draw(self, name, series, told=None, **more):
        """The figure of this name in page.toml; `told`: its words."""
        pattern, entry = matching(self.words["figures"], name)
        if not entry:
            sys.exit(f"page.toml has no figure '{name}'")
        self.drawn.add(pattern)
        entry = {**self.words.get("every_figure", {}), **entry}
        words = {key: entry.get(key, "").format(**told or {}) for key in ("title", "remark", "x", "y", "command", "same", "differs")}
        self.chart(name, words.pop("title"), words.pop("remark"), series, words.pop("x"), words.pop("y"), **words, **{**entry.get("size", {}), **more})

    def text(self, key):
        """What was published."""
        return next(row["published"] for row in self.published if row["key"] == key)

    def value(self, key):
        """The same as a number; of "below 1" the bound."""
        return number(self.text(key).removeprefix("below "))

    def put(self, key, value, **told):
        """Ours beside the published value of this key; `told`: words of its remark."""
        if value is not None:
            self.ours[key], self.told[key] = value, told

    def remark(self, row):
        key = row["key"]
        if key in self.words.get("left_out", {}):
            return self.words["left_out"][key]
        if key not in self.ours:
            return NOT_MADE
        remark = (matching(self.words.get("remarks", {}), key)[1] or "").format(**self.told[key])
        return remark or (UNEXPLAINED if row["published"] and comparing.differs(row["published"], shown(self.ours[key])) else "")

    def write(self, complete=False):
        rows = beside(self.published, self.ours, {row["key"]: self.remark(row) for row in self.published})
        self.rows = rows + self.rows
        self.lacks += [entry.get("title", pattern) for pattern, entry in self.words["figures"].items() if pattern not in self.drawn]
        self.lacks += [f"remark on {row['source']}: {row['quantity']}" for row in rows if row["remark"] == UNEXPLAINED]
        super().write(complete)
        missed = [f"missed its bar: {own['quantity']}, {row['ours']}" for row, own in zip(rows, self.published) if comparing.beyond(own, row["ours"])]
        if missed:
            sys.exit("\n".join(missed))
