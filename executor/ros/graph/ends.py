"""The ends of topics that users see: those whose node is known, and is not hidden."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["shown_ends"]

# The name that rcl gives to a node whose topics are discovered before its name.
_NO_NAME_YET: Final = "_NODE_NAME_UNKNOWN_"
_HIDDEN: Final = "_"


def shown_ends(ends: Iterable[Any]) -> list[Any]:
    """Returns the ends of nodes that are shown.

    A name that begins with an underscore is that of a hidden node, as for ROS's own tools
    (design.ros2.org/articles/topic_and_service_names.html): the recorder's is one.
    """
    return [end for end in ends if end.node_name != _NO_NAME_YET and not end.node_name.startswith(_HIDDEN)]
