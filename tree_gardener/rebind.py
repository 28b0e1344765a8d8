"""Redirects the port access of classes for ``py_trees.ports`` to the ports of the engine."""

from typing import Any

from tree_gardener.errors import PortError
from tree_gardener.ports import get_input, set_output


def has_ports(cls: type) -> bool:
    """Returns whether a class has py_trees' ``PortsMixin``."""
    return hasattr(cls, "setup_ports") and hasattr(cls, "_set_output")


def rebind(behaviour: Any) -> None:
    """Redirects a behaviour with py_trees' ``PortsMixin`` to the tree's ports; others stay unchanged."""
    if not has_ports(type(behaviour)):
        return

    def read(port_name: str, default: Any = None) -> Any:
        try:
            return get_input(behaviour, port_name)
        except PortError:
            if default is not None:
                return default
            raise

    def write(port_name: str, value: Any) -> None:
        set_output(behaviour, port_name, value)

    behaviour.get_input = read
    behaviour._set_output = write
    behaviour.setup_ports = lambda *_args, **_kwargs: None
