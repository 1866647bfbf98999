"""Puts the page together: make_page.py OUT PROGRAM THREE REPORT_FOLDER PAGE_FOLDER fills what stands in {{...}}."""
import base64
import pathlib
import sys

out, program, three, report, page = map(pathlib.Path, sys.argv[1:])


def text(folder, *names):
    return "".join((folder / name).read_text() for name in names)


parts = {
    "css": text(report, "report.css") + text(page, "live.css"),
    "program": base64.b64encode(program.read_bytes()).decode(),
    "worker": text(page, "worker.js"),
    "three": three.read_text(),
    "scripts": text(report, "orbit.js", "colors.js", "evened_surface.js", "stage.js", "chart.js",
                    "text.js")
    + text(page, "live_shapes.js", "history.js", "pulling.js", "live.js"),
}
whole = text(page, "page.html")
for name, part in parts.items():
    if "</script" in part:
        raise SystemExit(f"{name} would end its element")
    before, place, after = whole.partition("{{" + name + "}}")
    if not place:
        raise SystemExit(f"page.html has no place for {name}")
    whole = before + part + after
out.write_text(whole)
