"""The base of the ROS nodes: their rclpy node, settings that may be ports, and ports for fields."""

import copy
from collections.abc import Iterator
from typing import Any, Final

from py_trees.behaviour import Behaviour

from tree_gardener.errors import PortError
from tree_gardener.ports import get_input, node_of, pointer_key, set_output
from tree_gardener.ros_nodes.fields import SEPARATOR, assign, interface, path_of, read, type_at
from tree_gardener.ros_nodes.names import checked_name
from tree_gardener.status import Status
from tree_gardener.values import ConversionError, parse_status

NO_ROS: Final = "there is no ROS node: run the tree with one, tree.setup(node=…)"


class RosLeaf(Behaviour):
    """The base of the ROS nodes.

    Attributes:
        ros: the rclpy node; None until `setup`, and in a tree that runs without ROS.
    """

    ros: Any = None

    def setup(self, **kwargs: Any) -> None:
        """Takes the rclpy node."""
        self.ros = kwargs.get("node")

    def joined(self) -> Any:
        """Returns the rclpy node.

        Raises:
            PortError: the tree runs without ROS.
        """
        if self.ros is None:
            raise PortError(NO_ROS)
        return self.ros

    def now(self) -> float:
        """Returns seconds of the tree's clock: simulated time in a simulation."""
        return float(node_of(self).tree.clock.now())

    def setting(self, name: str, default: Any) -> Any:
        """Returns the value of a port, or the default if the node has no such port or no value for it."""
        node = node_of(self)
        if name not in node.ports and (node.manifest is None or name not in node.manifest):
            return default
        value = get_input(self, name)
        return default if value == "" else value

    def text(self, name: str, default: str) -> str:
        """Returns a port's value as a text.

        Raises:
            PortError: there is none, and no default.
        """
        value = str(self.setting(name, default)).strip()
        if not value:
            raise PortError(f"port '{name}' was given no value")
        return value

    def ros_name(self, port: str, default: str) -> str:
        """Returns a port's value, which is a name of ROS, as a text.

        Raises:
            PortError: there is none, and no default; or it is no name.
        """
        return checked_name(port, self.text(port, default))

    def seconds(self, name: str, default_ms: float) -> float:
        """Returns a port that holds milliseconds, in seconds; negative forever."""
        value = self.setting(name, default_ms)
        try:
            return float(value) / 1000.0
        except (TypeError, ValueError):
            raise PortError(f"port '{name}': {value!r} is no number of milliseconds") from None

    def flag(self, name: str, default: bool) -> bool:  # noqa: FBT001 - as the other settings
        """Returns a port that holds true or false."""
        return str(self.setting(name, default)).strip().lower() in {"true", "1"}

    def result(self, name: str, default: Status) -> Status:
        """Returns a port that holds SUCCESS, FAILURE or SKIPPED."""
        value = self.setting(name, default)
        try:
            found = value if isinstance(value, Status) else parse_status(str(value))
        except ConversionError as error:
            raise PortError(f"port '{name}': {error}") from None
        if found not in {Status.SUCCESS, Status.FAILURE, Status.SKIPPED}:
            raise PortError(f"port '{name}': {found.name} is no result; write SUCCESS, FAILURE or SKIPPED")
        return found

    def literal(self, name: str) -> str | None:
        """Returns a port's text unless it names an entry; None if it does, or if it has no value."""
        given = node_of(self).ports.get(name)
        return None if not given or pointer_key(given, name) is not None else given.strip()

    def fields(self, prefix: str) -> Iterator[tuple[str, list[str]]]:
        """Yields the ports of a message's fields: the name of the port, and the path in the message."""
        for port in tuple(node_of(self).ports):
            first, *path = path_of(port)
            if first == prefix:
                yield port, path

    def check_fields(self, message: Any, prefix: str) -> None:
        """Finds ports that the message has no field for, and literals that do not suit their fields.

        Raises:
            PortError: there is one.
        """
        for port, path in self.fields(prefix):
            with _named(port):
                if path:
                    type_at(message, path)
                if (text := self.literal(port)) is not None:
                    assign(type(message)(), path, text)

    def fill(self, message: Any, prefix: str) -> Any:
        """Sets the fields of a message from the ports; returns it.

        Raises:
            PortError: a port has no value, or the value does not suit its field.
        """
        fields = sorted(self.fields(prefix), key=lambda each: len(each[1]))
        for index, (port, path) in enumerate(fields):
            value = get_input(self, port)
            if any(inner[: len(path)] == path for _, inner in fields[index + 1 :]):
                # Ports below this one change the value, which may be an entry of the blackboard.
                value = copy.deepcopy(value)
            with _named(port):
                message = assign(message, path, value, self.now())
        return message

    def give_fields(self, message: Any, prefix: str) -> None:
        """Writes fields of a message to the entries that the ports name.

        Raises:
            PortError: there is no such field, or a port names no entry.
        """
        for port, path in self.fields(prefix):
            with _named(port):
                value = read(message, path)
            set_output(self, port, value)

    def give(self, name: str, value: Any) -> None:
        """Writes an output port, if the tree uses it."""
        if node_of(self).ports.get(name):
            set_output(self, name, value)

    def interface(self, port: str, default: str, kind: str) -> Any:
        """Returns the class of the interface that a port names.

        Raises:
            PortError: it is not installed.
        """
        name = self.text(port, default)
        with _named(port):
            return interface(name, kind)


class _named:  # noqa: N801 - it is used as a statement
    """Names the port in an error of the block."""

    def __init__(self, port: str) -> None:
        self.port = port

    def __enter__(self) -> None:
        pass

    def __exit__(self, kind: Any, error: Any, trace: Any) -> None:
        if isinstance(error, PortError):
            raise PortError(f"port '{self.port}': {error}") from None


def port_name(prefix: str, *path: str) -> str:
    """Returns the port of a field: ``goal__pose__position``."""
    return SEPARATOR.join((prefix, *path))
