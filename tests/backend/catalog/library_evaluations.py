"""Projects that evaluate the behaviours of the library, each with its evaluation.

`python -m tests.backend.catalog.library_evaluations FOLDER` writes all of them; then
`bt-studio evaluate FOLDER/GoTo GoTo` runs one.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

from backend.catalog.library import LIBRARY, files_of


def project(behaviour: str) -> dict[str, bytes]:
    """Returns a project whose main tree waits for the first pictures, and then is the behaviour.

    Args:
        behaviour: the id of the behaviour, which its evaluation is named after.
    """
    own = files_of(behaviour)
    ports = json.loads(own[f"trees/{behaviour}.json"])["ports"]
    manifest = {
        "format": "bt-studio/project", "version": 1, "name": behaviour, "main_tree": "Main", "tick_hz": 20,
        "universe": "empty", "on_finish": "stop", "on_error": "stop",
    }  # fmt: skip
    given = {port["name"]: port.get("default", f"{{{port['name']}}}") for port in ports}
    tree = {
        "format": "bt-studio/diagram", "version": 1, "id": "Main", "root": "n1", "drafts": [],
        "nodes": {
            "n1": {"type": "Sequence", "children": ["n2", "n3"]},
            "n2": {"type": "Sleep", "ports": {"msec": "200"}},
            "n3": {"type": "SubTree", "tree": behaviour, "name": behaviour, "ports": given},
        },
    }  # fmt: skip
    shared = [*LIBRARY.glob("evaluations/judge.py"), *LIBRARY.glob("universes/*.yaml")]
    files = {path.relative_to(LIBRARY).as_posix(): path.read_bytes() for path in shared}
    return {
        **files,
        **{path: text.encode() for path, text in own.items()},
        "project.json": json.dumps(manifest).encode(),
        "trees/Main.json": json.dumps(tree).encode(),
        f"evaluations/{behaviour}.yaml": (LIBRARY / f"evaluations/{behaviour}.yaml").read_bytes(),
    }


def write(behaviour: str, folder: Path) -> Path:
    """Writes the project of a behaviour, and returns its folder."""
    for path, data in project(behaviour).items():
        target = folder / behaviour / path
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(data)
    return folder / behaviour


if __name__ == "__main__":
    for each in sorted(path.stem for path in LIBRARY.glob("evaluations/*.yaml")):
        print(write(each, Path(sys.argv[1])))  # noqa: T201 - the result
