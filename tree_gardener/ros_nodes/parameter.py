"""Parameters of ROS nodes: reads one, or sets it."""

from typing import Any, Final

from tree_gardener.ros_nodes.names import checked_name
from tree_gardener.ros_nodes.service import RosServiceNode
from tree_gardener.status import Status

REFUSED: Final = "PARAMETER_REFUSED"
NOT_DECLARED: Final = "PARAMETER_NOT_DECLARED"

_NOT_SET, _BOOL, _INTEGER, _DOUBLE, _STRING = range(5)  # rcl_interfaces/msg/ParameterType
_FIELDS: Final = (
    "",
    *("bool_value", "integer_value", "double_value", "string_value", "byte_array_value"),
    *("bool_array_value", "integer_array_value", "double_array_value", "string_array_value"),
)


class RosParam(RosServiceNode):
    """Reads a parameter of a ROS node into ``value``, or sets it if ``set`` has a value."""

    def setup(self, **kwargs: Any) -> None:
        """Takes the rclpy node; the client is made at the first tick, since it depends on two ports."""
        self.ros = kwargs.get("node")

    def text(self, name: str, default: str) -> str:
        """Returns a port's value; the service's name follows from the node's."""
        if name == "service_name":
            return (
                f"{super().text('node_name', '').rstrip('/')}/{'set' if self._sets() else 'get'}_parameters"
            )
        if name == "service_type":
            return f"rcl_interfaces/srv/{'Set' if self._sets() else 'Get'}Parameters"
        return super().text(name, default)

    def ros_name(self, port: str, default: str) -> str:
        """Returns the name of the service; one that is wrong is that of the node."""
        checked_name("node_name", super().text("node_name", "").rstrip("/"))
        return self.text(port, default)

    def initialise(self) -> None:
        """Begins an activation; the type of the call may have changed."""
        self._type = None
        super().initialise()

    def set_request(self, request: Any) -> Any:
        """Fills the request."""
        name = self.text("param_name", "")
        if not self._sets():
            request.names = [name]
            return request
        from rcl_interfaces.msg import Parameter, ParameterValue  # noqa: PLC0415 - only where ROS is

        kind, field, value = _typed(self.setting("set", ""))
        request.parameters = [Parameter(name=name, value=ParameterValue(type=kind, **{field: value}))]
        return request

    def on_response(self, response: Any) -> Status:
        """Writes the value, or the reason why it was refused."""
        if self._sets():
            answer = response.results[0]
            self.give("error", "" if answer.successful else f"{REFUSED}: {answer.reason}")
            return Status.SUCCESS if answer.successful else Status.FAILURE
        if not response.values or response.values[0].type == _NOT_SET:
            return self.on_failure(NOT_DECLARED)
        value = getattr(response.values[0], _FIELDS[response.values[0].type])
        self.give("value", list(value) if not isinstance(value, bool | int | float | str) else value)
        self.give("error", "")
        return Status.SUCCESS

    def on_failure(self, error: str) -> Status:
        """Writes the error."""
        self.give("error", error)
        is_missing = error == "SERVICE_UNREACHABLE"
        return self.result("if_missing", Status.FAILURE) if is_missing else Status.FAILURE

    def _sets(self) -> bool:
        return bool(self.setting("set", "") != "")


def _typed(value: Any) -> tuple[int, str, Any]:
    """Returns the type of a parameter, its field in the message, and the value; as ``ros2 param set``."""
    if isinstance(value, str):
        value = _parsed(value)
    kinds = {bool: _BOOL, int: _INTEGER, float: _DOUBLE}
    kind = kinds.get(type(value), _STRING)
    return kind, _FIELDS[kind], value if kind != _STRING else str(value)


def _parsed(text: str) -> bool | int | float | str:
    plain = text.strip()
    if plain in {"true", "false"}:
        return plain == "true"
    for number in (int, float):
        try:
            return number(plain)
        except ValueError:
            continue
    return text
