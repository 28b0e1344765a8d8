"""The difference as one HTML page: no script, no outside request, foreign text always escaped."""

from __future__ import annotations

import base64
import hashlib
from difflib import unified_diff
from html import escape
from typing import TYPE_CHECKING, Final

from translator.difference.picture import picture
from translator.difference.words import FILE_SIGNS, heading, shown, tree_lines

if TYPE_CHECKING:
    from collections.abc import Iterator

    from translator.difference.projects import Difference

MOST_LINES: Final = 2_000
STYLE: Final = """
body { font: 15px/1.5 system-ui, 'Segoe UI', sans-serif; margin: 2rem auto; max-width: 72rem; padding: 0 1rem;
  color: #1f2328; background: #ffffff; }
h1 { font-size: 1.4rem; } h2 { font-size: 1.1rem; margin-top: 2rem; }
ul { list-style: none; padding: 0; } li { margin: 0.2rem 0; overflow-wrap: anywhere; }
.sign { display: inline-block; width: 1.5rem; font-weight: 700; }
.picture { overflow: auto; border: 1px solid #d0d7de; border-radius: 6px; max-height: 80vh;
  background: #ffffff; }
pre { overflow: auto; border: 1px solid #d0d7de; border-radius: 6px; padding: 0.75rem; }
.added { color: #1a7f37; } .removed { color: #cf222e; }
.changed { color: #9a6700; } .moved { color: #0969da; }
@media (prefers-color-scheme: dark) {
  body { color: #e6edf3; background: #0d1117; }
  .added { color: #3fb950; } .removed { color: #f85149; }
  .changed { color: #d29922; } .moved { color: #58a6ff; }
}
"""
CLASSES: Final = {"+": "added", "−": "removed", "≠": "changed", "⇄": "moved", "⇅": "moved"}


def page(difference: Difference) -> str:
    """Returns the page."""
    digest = base64.b64encode(hashlib.sha256(STYLE.encode()).digest()).decode()
    policy = (
        f"default-src 'none'; style-src 'sha256-{digest}'; img-src data:; base-uri 'none'; form-action 'none'"
    )
    title = f"{shown(difference.older.name)} → {shown(difference.newer.name)}"
    body = [*_trees(difference), *_files(difference)]
    return "\n".join([
        "<!DOCTYPE html>",
        '<html lang="en">',
        "<head>",
        '<meta charset="utf-8">',
        f'<meta http-equiv="Content-Security-Policy" content="{escape(policy)}">',
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        f"<title>{escape(title)}</title>",
        f"<style>{STYLE}</style>",
        "</head>",
        "<body>",
        f"<h1>{escape(title)}</h1>",
        *(body or ["<p>Nothing differs.</p>"]),
        "</body>",
        "</html>",
    ]) + "\n"  # fmt: skip


def _trees(difference: Difference) -> Iterator[str]:
    for tree in difference.trees:
        yield f"<h2>{escape(heading(tree))}</h2>"
        if tree.change == "changed":
            yield "<ul>"
            for line in tree_lines(tree):
                sign = f'<span class="sign {CLASSES[line.sign]}">{line.sign}</span>'
                who = f"<b>{escape(line.who)}</b> " if line.who else ""
                yield f"<li>{sign}{who}{escape(line.what)}</li>"
            yield "</ul>"
        yield f'<div class="picture">{picture([tree])}</div>'


def _files(difference: Difference) -> Iterator[str]:
    for path, change in difference.files.items():
        sign = FILE_SIGNS[change]
        yield f'<h2><span class="sign {CLASSES[sign]}">{sign}</span>{escape(shown(path))} {change}</h2>'
        before, after = (_text(side.files.get(path, b"")) for side in (difference.older, difference.newer))
        if before is None or after is None:
            yield "<p>This file is not text.</p>"
            continue
        found = list(unified_diff(before.splitlines(), after.splitlines(), lineterm="", n=3))[2:]
        rest = [f"… {len(found) - MOST_LINES} more lines"] if len(found) > MOST_LINES else []
        yield f"<pre>{escape(chr(10).join([*found[:MOST_LINES], *rest]))}</pre>"


def _text(raw: bytes) -> str | None:
    try:
        return None if b"\0" in raw else raw.decode("utf-8")
    except UnicodeDecodeError:
        return None
