"""Follows every link of a built site: check.py SITE. Ends with 1 where one leads nowhere, or a page loads from elsewhere."""

import functools
import pathlib
import re
import sys
import urllib.parse


@functools.cache
def text_of(page):
    return page.read_text(errors="replace")


@functools.cache
def anchors_of(page):
    return set(re.findall(r'(?:id|name)="([^"]*)"', text_of(page)))


def leads_somewhere(site, page, link):
    path, _, anchor = link.partition("#")
    path = urllib.parse.unquote(path.split("?")[0])
    target = page if not path else site / path.lstrip("/") if path.startswith("/") else page.parent / path
    if target.is_dir():
        target = target / "index.html"
    if not target.exists():
        return False
    # Doxygen names no place for classes within a private part.
    if not anchor or target.suffix != ".html" or anchor in ("__search", "nested-classes"):
        return True
    return urllib.parse.unquote(anchor) in anchors_of(target)


def main(site):
    links, wrong = 0, []
    for page in sorted(site.rglob("*.html")):
        if re.search(r'<(script|link|img)[^>]*(src|href)="(https?:)?//', text_of(page)):
            wrong.append(f"{page.relative_to(site)} loads from elsewhere")
        for link in re.findall(r'(?:src|href)="([^"]*)"', text_of(page)):
            if re.match(r"(https?|mailto|javascript|data):", link):
                continue
            links += 1
            if not leads_somewhere(site, page, link):
                wrong.append(f"{page.relative_to(site)} links {link}")
    for line in wrong:
        print(line, file=sys.stderr)
    print(f"{links} links, {len(wrong)} of them wrong")
    return 1 if wrong else 0


sys.exit(main(pathlib.Path(sys.argv[1]).resolve()))
