"""Gathers what the site consists of: pages.py PAGES GRACILIS.

Copies README.md, docs/ and what they link to below PAGES, writes a page per command from `GRACILIS manual` by mandoc,
and mkdocs.yml with the lists of commands and decisions in it.
"""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

root = pathlib.Path(__file__).resolve().parents[2]
api_page = """# API reference

<a href="api/index.html">Everything that the installed headers declare</a>, made of the headers by Doxygen. How to begin is in
the [C++ tutorial](docs/guide/cpp.md), and every formula, with its source, in [formulas](docs/mathematics.md).
"""
link = re.compile(r"\]\(([^)#\s]+)(#[^)\s]*)?\)")


def text_page(title, text):
    return f"# {title}\n\n```\n{text}\n```\n"


def copy_file(source, pages, waiting):
    """A picture or notebook as it is, a folder as a list, any other text as a page that shows it; pages wait for their turn. Says what
    a link leads to."""
    target = pages / source.relative_to(root)
    if source.is_dir():
        files = sorted(f for f in source.rglob("*") if f.is_file() and "__pycache__" not in f.parts)
        shown = [copy_file(file, pages, waiting) for file in files]
        lines = [f"- [{f.relative_to(source)}]({s.relative_to(target)})" for f, s in zip(files, shown)]
        target.mkdir(parents=True, exist_ok=True)
        (target / "index.md").write_text(f"# {source.relative_to(root)}\n\n" + "\n".join(lines) + "\n")
        return target / "index.md"
    target.parent.mkdir(parents=True, exist_ok=True)
    if source.suffix == ".md":
        waiting.append(source)
        return target
    if source.suffix in (".png", ".svg", ".gif", ".ipynb"):
        shutil.copyfile(source, target)
        return target
    target = target.with_name(target.name + ".md")
    target.write_text(text_page(source.relative_to(root), source.read_text()))
    return target


def gather(pages):
    """Follows links from the pages of the manual, so that none leads out of the site."""
    waiting = [root / name for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md", "SECURITY.md")]
    waiting += sorted((root / "docs").rglob("*.md"))
    done = set()
    while waiting:
        page = waiting.pop()
        if page in done:
            continue
        done.add(page)
        copied = pages / page.relative_to(root)
        copied.parent.mkdir(parents=True, exist_ok=True)

        def placed(match):
            target, anchor = match.group(1), match.group(2) or ""
            if "://" in target or target.startswith("mailto:"):
                return match.group(0)
            source = (page.parent / target).resolve()
            shown = copy_file(source, pages, waiting)
            shown_from = pathlib.Path(*[".."] * len(page.parent.relative_to(root).parts)) / shown.relative_to(pages)
            return f"]({shown_from}{anchor})"

        copied.write_text(link.sub(placed, page.read_text()))


def commands(pages, gracilis):
    """A page per page of man; their names in order."""
    folder = pages / "commands"
    folder.mkdir()
    with tempfile.TemporaryDirectory() as manual:
        subprocess.run([gracilis, "manual", manual], check=True)
        names = sorted(page.stem for page in pathlib.Path(manual).iterdir())
        for name in names:
            html = subprocess.run(["mandoc", "-T", "html", "-O", "fragment,man=%N.html", f"{manual}/{name}.1"],
                                  check=True, capture_output=True, text=True).stdout
            title = name.replace("-", " ") if name == "gracilis" else "gracilis " + name.removeprefix("gracilis-")
            (folder / f"{name}.md").write_text(f"# {title}\n\n<div class=\"man\">\n{html}</div>\n")
    return [f"      - {name}: commands/{name}.md" for name in names]


def decisions():
    listed = []
    for page in sorted((root / "docs/decisions").glob("*.md"), key=lambda p: (p.name != "README.md", p.name)):
        title = page.read_text().splitlines()[0].removeprefix("# ").replace('"', "'")
        listed.append(f'          - "{title}": {page.relative_to(root)}')
    return listed


def main(pages, gracilis):
    shutil.rmtree(pages, ignore_errors=True)
    pages.mkdir(parents=True)
    gather(pages)
    shutil.copyfile(root / "docs/site/site.css", pages / "site.css")
    (pages / "api.md").write_text(api_page)
    text = (root / "docs/site/mkdocs.yml").read_text()
    text = text.replace("  - Commands: commands/", "\n".join(["  - Commands:"] + commands(pages, gracilis)))
    text = text.replace("      - Decisions: decisions/", "\n".join(["      - Decisions:"] + decisions()))
    text = text.replace("../../out/site_pages", str(pages)).replace("../../out/site", str(pages.parent / "site"))
    (pages.parent / "mkdocs.yml").write_text(text)


main(pathlib.Path(sys.argv[1]).resolve(), sys.argv[2])
