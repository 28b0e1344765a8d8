"""Refuses the wheels of ROS where the shell has sourced a ROS of its own; importing this module asks.

Both have `rclpy`, and each loads libraries of its own by the same names. Which of them a process gets is then
an accident, and a mixture of both fails later without a reason. Each module that imports rclpy imports this
one before.
"""

import os
import pathlib
import sys
from collections.abc import Iterable, Mapping
from typing import Final

__all__ = ["TwoRosError", "refuse_two"]

_WHEEL: Final = "ros-rclpy"
"""The distribution that holds rclpy in the wheels of ROS."""
_PLACES: Final = ("lib/python3*/site-packages", "local/lib/python3*/dist-packages")


class TwoRosError(ImportError):
    """The wheels of ROS are installed, and another ROS is sourced."""


def refuse_two(environment: Mapping[str, str] | None = None, paths: Iterable[str] | None = None) -> None:
    """Raises an error if rclpy is here twice: in the wheels, and in a ROS that the shell has sourced.

    Args:
        environment: has `AMENT_PREFIX_PATH`; that of the process if None.
        paths: the folders in which distributions are looked for; `sys.path` if None.

    Raises:
        TwoRosError: with both places, and what to do.
    """
    environment = os.environ if environment is None else environment
    sourced = _sourced(environment.get("AMENT_PREFIX_PATH", ""))
    if not sourced:
        return
    from importlib import metadata  # noqa: PLC0415 - most processes need it for nothing

    searched = list(sys.path if paths is None else paths)
    found = next(iter(metadata.distributions(name=_WHEEL, path=searched)), None)
    if found is None:
        return
    wheel = pathlib.Path(str(found.locate_file("rclpy"))).resolve()
    others = [folder for folder in sourced if folder.resolve() != wheel]
    if others:
        raise TwoRosError(
            f"rclpy is here twice, in the wheels ({wheel}) and in the ROS that this shell has sourced "
            f"({others[0]}): use a shell that has sourced none, or an environment of Python without the "
            "extra `ros` of tree-gardener"
        )


def _sourced(prefixes: str) -> list[pathlib.Path]:
    """Returns each rclpy below the prefixes of `AMENT_PREFIX_PATH`."""
    roots = [pathlib.Path(prefix) for prefix in prefixes.split(os.pathsep) if prefix]
    return [
        folder
        for root in roots
        for place in _PLACES
        for folder in sorted(root.glob(f"{place}/rclpy"))
        if folder.is_dir()
    ]


refuse_two()
