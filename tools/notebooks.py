#!/usr/bin/python3
"""Makes the notebooks of the Python examples, with their output: tools/notebooks.py [NAME...]

python/examples/NAME.ipynb follows from NAME.py: what is said at the script's top becomes its first cell, and each line
`# %% what comes` begins another. The cells are run here, by the package that PYTHONPATH names, and without Jupyter:

    PYTHONPATH=build/release/python tools/notebooks.py
"""

import ast
import contextlib
import io
import json
import os
import sys
import warnings
from pathlib import Path

examples = Path(__file__).resolve().parent.parent / "python" / "examples"
# What a script is given on the command line, a notebook gives itself.
arguments = {
    "import_osim": """import sys
import tempfile

sys.argv[1:] = ["../../tests/opensim/reference/arm26_right.osim", tempfile.mkdtemp()]""",
}


def text_cell(text):
    return {"cell_type": "markdown", "metadata": {}, "source": text.splitlines(keepends=True)}


def code_cell(code):
    return {"cell_type": "code", "execution_count": None, "metadata": {}, "outputs": [],
            "source": code.splitlines(keepends=True)}  # fmt: skip


def code_of(cell):
    return "".join(cell["source"])


def parts_of(script):
    """What the script says at its top, and pairs (title, code) of its parts."""
    first = ast.parse(script).body[0]
    parts = [["", []]]
    for line in script.splitlines()[first.end_lineno :]:
        if line.startswith("# %%"):
            parts.append([line.removeprefix("# %%").strip(), []])
        else:
            parts[-1][1].append(line)
    return ast.literal_eval(first.value), [(title, "\n".join(lines).strip()) for title, lines in parts]


def cells_of(name):
    """The cells of an example's notebook, not run yet."""
    said, parts = parts_of((examples / f"{name}.py").read_text())
    cells = [text_cell(said)]
    if name in arguments:
        cells.append(code_cell(arguments[name]))
    for title, code in parts:
        if title:
            cells.append(text_cell(f"## {title}"))
        if code:
            cells.append(code_cell(code))
    return cells


def shown(value, count):
    """A value as notebooks show that of a cell's last line."""
    data = {"text/plain": repr(value).splitlines(keepends=True)}
    if hasattr(value, "_repr_svg_"):
        data["image/svg+xml"] = value._repr_svg_().splitlines(keepends=True)
    return {"output_type": "execute_result", "execution_count": count, "data": data, "metadata": {}}


def run(cells):
    """Runs code cells one after the other and keeps with each what it printed and what its last line is."""
    names, count = {"__name__": "__main__"}, 0
    for cell in cells:
        if cell["cell_type"] != "code":
            continue
        count += 1
        tree = ast.parse(code_of(cell))
        last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            exec(compile(tree, "cell", "exec"), names)
            value = eval(compile(ast.Expression(last.value), "cell", "eval"), names) if last else None
        cell["execution_count"] = count
        if printed.getvalue():
            lines = printed.getvalue().splitlines(keepends=True)
            cell["outputs"].append({"output_type": "stream", "name": "stdout", "text": lines})
        if value is not None:
            cell["outputs"].append(shown(value, count))
    return cells


def made(name):
    """An example's cells, run where the example stands."""
    before, given = os.getcwd(), sys.argv[:]
    os.chdir(examples)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of the made-up scenes, with names of temporary folders
            return run(cells_of(name))
    finally:
        os.chdir(before)
        sys.argv[:] = given


def main():
    for name in sys.argv[1:] or sorted(each.stem for each in examples.glob("*.py")):
        notebook = {
            "cells": made(name),
            "metadata": {
                "kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"},
                "language_info": {"name": "python"},
            },
            "nbformat": 4,
            "nbformat_minor": 4,
        }
        file = examples / f"{name}.ipynb"
        file.write_text(json.dumps(notebook, indent=1, ensure_ascii=False) + "\n")
        print(file)


if __name__ == "__main__":
    main()
