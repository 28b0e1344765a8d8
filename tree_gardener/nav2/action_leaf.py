"""The bases of Nav2's leaves that use an action or a service, after ``BtActionNode`` and ``BtServiceNode``.

Where Nav2 blocks its tree while a server is missing or answers, these nodes are RUNNING.
"""

from typing import Any, ClassVar, Final

from tree_gardener.errors import PortError
from tree_gardener.nav2.reading import give
from tree_gardener.ports import get_input, node_of
from tree_gardener.ros_nodes.action import GOAL_REJECTED_BY_SERVER, INVALID_GOAL, RosActionNode
from tree_gardener.ros_nodes.service import RosServiceNode
from tree_gardener.status import Status

LEAST_TIMEOUT_S: Final = 0.5
"""Trees for Nav2 give its servers 10 to 20 ms, which are shorter than the period of a tick here."""


class _Leaf:
    """Reads ports that the tree may leave out."""

    def setting(self, name: str, default: Any) -> Any:
        """Returns the value of a port that the tree sets, or the default."""
        given = node_of(self).ports.get(name)
        return default if not given else super().setting(name, default)  # type: ignore[misc]

    def seconds(self, name: str, default_ms: float) -> float:
        """Returns a timeout; short ones are lengthened."""
        seconds = float(super().seconds(name, default_ms))  # type: ignore[misc]
        return seconds if seconds < 0 else max(seconds, LEAST_TIMEOUT_S)

    def read(self, name: str, otherwise: Any = None) -> Any:
        """Returns the value of a port, or its default; `otherwise` if this node's version has no such port.

        A text whose entry has no value yet is its default, or empty, as in Nav2: a tree may name a planner
        or a controller that no selector has chosen.

        Raises:
            PortError: the port has neither.
        """
        declared = getattr(self, "INPUT_PORTS", {})
        if otherwise is not None and name not in declared:
            return otherwise
        try:
            return get_input(self, name)
        except PortError:
            port = declared.get(name)
            if port is None or port.type is not str or not self.is_given(name):
                raise
            return port.default if isinstance(port.default, str) else ""

    def is_given(self, name: str) -> bool:
        """Returns whether the tree sets a port."""
        return bool(node_of(self).ports.get(name))


class Nav2Action(_Leaf, RosActionNode):
    """The base of leaves that send a goal to one of Nav2's action servers.

    It succeeds if the goal is reached or was cancelled by someone else, and fails if the server gave it up;
    ``error_code_id`` and ``error_msg`` say why.
    """

    NAME_PORT = "server_name"
    WAIT_FOR_SERVER_TIMEOUT_MS: ClassVar[int] = 5000

    def update(self) -> Any:
        """Sends the goal, follows it, or replaces it by another one."""
        if self._sent is not None and self.is_changed():
            self._sent = None
        return super().update()

    def is_changed(self) -> bool:
        """Returns whether a new goal is to replace the one under way, as Nav2's ``goal_updated_``."""
        return False

    def give_result(self, result: Any) -> None:
        """Writes the outputs of a result; `result` is None if there is none."""

    def on_result(self, result: Any) -> Status:
        """Writes the outputs."""
        self.give_result(result)
        self.give_error(0, "")
        return Status.SUCCESS

    def on_aborted(self, result: Any) -> Status:
        """Writes the error of the server."""
        self.give_result(None)
        self.give_error(getattr(result, "error_code", 0), getattr(result, "error_msg", ""))
        return Status.FAILURE

    def on_cancelled(self, _result: Any) -> Status:
        """Succeeds, as in Nav2: somebody wanted it."""
        self.give_result(None)
        self.give_error(0, "")
        return Status.SUCCESS

    def on_failure(self, error: str) -> Status:
        """Writes Nav2's code for a server that is missing or does not answer."""
        name = "UNKNOWN" if error in {GOAL_REJECTED_BY_SERVER, INVALID_GOAL} else "TIMEOUT"
        kind = self._type.Result
        self.give_error(getattr(kind, name, getattr(kind, "UNKNOWN", 0)), f"{self._client_name}: {error}")
        return Status.FAILURE

    def give_error(self, code: int, message: str) -> None:
        """Writes the error."""
        give(self, "error_code_id", code)
        give(self, "error_msg", message)


class Nav2Service(_Leaf, RosServiceNode):
    """The base of leaves that call one of Nav2's services."""

    WAIT_FOR_SERVER_TIMEOUT_MS: ClassVar[int] = 5000


def put(message: Any, **values: Any) -> None:
    """Sets fields of a message; a field that this version of Nav2 does not have is left out."""
    for name, value in values.items():
        if hasattr(message, name):
            setattr(message, name, value)
