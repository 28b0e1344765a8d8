"""The nodes of Nav2 that the palette offers; a project takes a node's source when a block is added."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any

from translator import inspect_action
from translator.nav2.sources import nav2_source
from translator.nav2.tables import table

if TYPE_CHECKING:
    from translator.nav2.distributions import Distribution


@cache
def offered_actions(distribution: Distribution) -> tuple[dict[str, Any], ...]:
    """Returns the declaration and the source of each node of a ROS distribution, by name."""
    names = sorted(table(distribution))
    sources = {name: source for name in names if (source := nav2_source(name, distribution)) is not None}
    return tuple(
        inspect_action(source, f"actions/{name}.py").to_json() | {"text": source}
        for name, source in sources.items()
    )
