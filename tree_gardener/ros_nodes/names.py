"""Names of topics, services, actions and nodes of ROS, by its article "Topic and Service Names"."""

import re
from typing import Final

from tree_gardener.errors import PortError

_NAME: Final = re.compile(r"(?:/|~/|~\Z)?(?:[A-Za-z_]\w*(?:/[A-Za-z_]\w*)*)?", re.ASCII)
_BARE: Final = frozenset(("", "/", "~/"))


def is_ros_name(name: str) -> bool:
    """Returns whether a text is a name: words between `/`, of which none begins with a digit."""
    return name not in _BARE and _NAME.fullmatch(name) is not None


def checked_name(port: str, name: str) -> str:
    """Returns a name that a port gives.

    Raises:
        PortError: it is no name of ROS.
    """
    if not is_ros_name(name):
        raise PortError(
            f"port '{port}': '{name}' is no name in ROS; write words of letters, digits and _ between /, "
            "none of which begins with a digit"
        )
    return name
