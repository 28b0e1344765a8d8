"""The nodes of Nav2 that the palette offers; a project takes a node's source when a block is added."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

from translator import inspect_action


@lru_cache(maxsize=1)
def offered_actions() -> tuple[dict[str, Any], ...]:
    """Returns the declaration and the source of each node, by name."""
    from tree_gardener.nav2_library import source_of, table  # noqa: PLC0415 - the engine loads py_trees

    sources = {name: source for name in sorted(table()) if (source := source_of(name)) is not None}
    return tuple(
        inspect_action(source, f"actions/{name}.py").to_json() | {"text": source}
        for name, source in sources.items()
    )
