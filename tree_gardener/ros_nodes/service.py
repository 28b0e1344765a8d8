"""Services of ROS as nodes, after ``RosServiceNode`` of BehaviorTree.ROS2."""

from typing import Any, ClassVar, Final

from tree_gardener.ports import node_of
from tree_gardener.ros_nodes.leaf import RosLeaf
from tree_gardener.status import Status

SERVICE_UNREACHABLE: Final = "SERVICE_UNREACHABLE"
SERVICE_TIMEOUT: Final = "SERVICE_TIMEOUT"
INVALID_REQUEST: Final = "INVALID_REQUEST"


class RosServiceNode(RosLeaf):
    """The base of nodes that call a service and are RUNNING until it answers.

    A derived class sets `SERVICE_TYPE` and `SERVICE_NAME`, and overrides `set_request` and `on_response`. The
    ports ``service_name``, ``server_timeout`` and ``wait_for_server_timeout`` replace the attributes if the
    class declares them. A tick never waits.
    """

    SERVICE_TYPE: ClassVar[str] = ""
    SERVICE_NAME: ClassVar[str] = ""
    SERVER_TIMEOUT_MS: ClassVar[int] = 1000
    """The time in which the service has to answer; negative forever."""
    WAIT_FOR_SERVER_TIMEOUT_MS: ClassVar[int] = 500
    """The time in which the service has to appear; negative forever."""

    _type: Any = None
    _client: Any = None
    _client_name = ""
    _answer: Any = None
    _began_s = 0.0

    def set_request(self, request: Any) -> Any:
        """Fills the request. Returns another one to send instead, or False if there is nothing to send."""

    def on_response(self, _response: Any) -> Any:
        """Handles the response."""
        return Status.SUCCESS

    def on_failure(self, _error: str) -> Any:
        """Returns the result of the node after an error, which is one of the names of this module."""
        return Status.FAILURE

    def setup(self, **kwargs: Any) -> None:
        """Makes the client, if the name of the service is known already."""
        super().setup(**kwargs)
        if self.ros is None:
            return
        if self.literal("service_type") or "service_type" not in node_of(self).ports:
            self._resolve()
            self.check()
        if self.literal("service_name") or "service_name" not in node_of(self).ports:
            self._connect()

    def check(self) -> None:
        """Finds mistakes in the ports before the first tick."""

    def initialise(self) -> None:
        """Begins an activation."""
        self._answer = None
        self._resolve()
        self._connect()
        self._began_s = self.now()

    def update(self) -> Any:
        """Calls the service, or looks for the answer."""
        if self._answer is None:
            return self._call()
        if not self._answer.done():
            patience_s = self.seconds("server_timeout", self.SERVER_TIMEOUT_MS)
            if patience_s < 0 or self.now() - self._began_s <= patience_s:
                return Status.RUNNING
            self._forget()
            return self.on_failure(SERVICE_TIMEOUT)
        return self.on_response(self._answer.result())

    def terminate(self, new_status: Any) -> None:
        """Forgets the call if the node is halted; a service has no way to stop."""
        if new_status.name == "INVALID":
            self._forget()

    def shutdown(self) -> None:
        """Destroys the client."""
        self._forget()
        if self._client is not None:
            self.ros.destroy_client(self._client)
            self._client = None

    def _resolve(self) -> None:
        if self._type is None:
            self.joined()
            self._type = self.interface("service_type", self.SERVICE_TYPE, "srv")

    def _connect(self) -> None:
        name = self.ros_name("service_name", self.SERVICE_NAME)
        if self._client is None or name != self._client_name:
            self.shutdown()
            self._client = self.joined().create_client(self._type, name)
            self._client_name = name

    def _call(self) -> Any:
        now_s = self.now()
        if not self._client.service_is_ready():
            patience_s = self.seconds("wait_for_server_timeout", self.WAIT_FOR_SERVER_TIMEOUT_MS)
            is_patient = patience_s < 0 or now_s - self._began_s < patience_s
            return Status.RUNNING if is_patient else self.on_failure(SERVICE_UNREACHABLE)
        request = self._type.Request()
        given = self.set_request(request)
        if given is False:
            return self.on_failure(INVALID_REQUEST)
        if given is None or given is True:
            given = request
        self._answer, self._began_s = self._client.call_async(given), now_s
        return Status.RUNNING

    def _forget(self) -> None:
        if self._answer is not None and not self._answer.done():
            self._client.remove_pending_request(self._answer)
        self._answer = None


class RosService(RosServiceNode):
    """Calls a service; the fields of request and response are ports.

    If the response has a field ``success`` that is false, the node fails.
    """

    def check(self) -> None:
        """Compares the ports with the fields of the service."""
        for prefix in ("request", "response"):
            self.check_fields(getattr(self._type, prefix.title())(), prefix)

    def set_request(self, request: Any) -> Any:
        """Fills the request from the ports."""
        return self.fill(request, "request")

    def on_response(self, response: Any) -> Status:
        """Writes the fields of the response that the tree uses."""
        self.give_fields(response, "response")
        self.give("error", "")
        return Status.FAILURE if getattr(response, "success", None) is False else Status.SUCCESS

    def on_failure(self, error: str) -> Status:
        """Writes the error; a missing service gives the result that the tree wants."""
        self.give("error", error)
        is_missing = error == SERVICE_UNREACHABLE
        return self.result("if_missing", Status.FAILURE) if is_missing else Status.FAILURE
