"""How a run shows itself in a notebook."""

import html
import tempfile
from pathlib import Path


def run_as_html(run):
    """The run's report in a frame of its own; needs nothing but the notebook."""
    with tempfile.TemporaryDirectory() as folder:
        page = run.report(Path(folder) / "report.html").read_text(encoding="utf-8")
    return f'<iframe srcdoc="{html.escape(page)}" width="100%" height="800" frameborder="0"></iframe>'
