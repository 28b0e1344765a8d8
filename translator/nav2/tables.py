"""The tables of Nav2's nodes, one for each ROS distribution; `make nav2-tables` writes them."""

from __future__ import annotations

import json
from functools import cache
from importlib import resources
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Final

from translator.nav2.distributions import NEWEST

if TYPE_CHECKING:
    from collections.abc import Mapping

    from translator.nav2.distributions import Distribution

ENGINES: Final = "nav2_nodes.json"
"""The table of the newest distribution, which the engine has beside the nodes."""


def place_of(distribution: Distribution) -> Path:
    """Returns the file of a table."""
    if distribution == NEWEST:
        return Path(str(resources.files("tree_gardener").joinpath(ENGINES)))
    return Path(str(resources.files("translator").joinpath("nav2", f"{distribution}.json")))


@cache
def table(distribution: Distribution) -> Mapping[str, dict[str, Any]]:
    """Returns the nodes of a distribution by type: kind and ports."""
    document = json.loads(place_of(distribution).read_text(encoding="utf-8"))
    return MappingProxyType({node["type"]: node for node in document["nodes"]})
