#!/usr/bin/env python3
"""index.py OUT NAME...: OUT/index.html with a thumbnail of each figure and the command under it. Those without figures are named."""
import html
import os
import sys

from files import read
from publication import STYLE


def figure(name, each):
    kind = "svg" if os.path.exists(os.path.join(OUT, name, "figures", each["name"] + ".svg")) else "png"
    return (f'<figure><a href="{name}/index.html"><img alt="{html.escape(each["title"])}" '
            f'src="{name}/figures/{each["name"]}.{kind}"></a><figcaption><b>{html.escape(each["title"])}</b>'
            f'<code>{html.escape(each["command"])}</code></figcaption></figure>')


def section(name):
    path = os.path.join(OUT, name, "figures.json")
    made = read(path)
    if not made:
        return f"<h2>{name}</h2><p>Not made: its data are not here, or it failed.</p>"
    drawn = "".join(figure(name, each) for each in made["figures"])
    return (f'<h2><a href="{name}/index.html">{html.escape(made["title"])}</a></h2>'
            f'<div class="figures thumbs">{drawn}</div>')


OUT = sys.argv[1]
with open(os.path.join(OUT, "index.html"), "w") as file:
    file.write(f'<!doctype html><html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width"><title>Published beside ours</title><style>{STYLE}</style>'
               f'<h1>Published beside ours</h1>{"".join(section(name) for name in sys.argv[2:])}</html>\n')
