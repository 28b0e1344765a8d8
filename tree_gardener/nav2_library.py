"""Nav2's nodes as data: the table of all of them, and the sources of those in `tree_gardener.nav2`.

The module loads none of the nodes.
"""

import json
import re
from importlib import resources
from typing import Any


def table() -> dict[str, dict[str, Any]]:
    """Returns Nav2's nodes by type: kind and ports."""
    text = resources.files("tree_gardener").joinpath("nav2_nodes.json").read_text(encoding="utf-8")
    return {node["type"]: node for node in json.loads(text)["nodes"]}


def source_of(name: str) -> str | None:
    """Returns the source of a node, to be ``actions/<Name>.py``; None if the engine has none."""
    if name not in table():
        return None
    stem = re.sub("(?<=[a-z])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])", "_", name).lower()
    file = resources.files("tree_gardener").joinpath("nav2", f"{stem}.py")
    return file.read_text(encoding="utf-8") if file.is_file() else None
