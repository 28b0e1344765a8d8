"""Serves one client that speaks the RAM dialect, on loopback.

Defects of the original are not copied: a frame that is not a command is answered with an error and the socket
stays open, there are no hidden `to_<state>` commands, a second client receives the reason of its refusal, and
the death of an application is reported with the new state. There is no token: hosts and origins are checked
instead (`executor.manager.admission`), so pages of other sites are refused.
"""

from __future__ import annotations

import asyncio
import contextlib
import json
import logging
from typing import TYPE_CHECKING, Any, Final
from uuid import uuid4

import msgspec
from websockets.asyncio.server import Server, ServerConnection, serve
from websockets.exceptions import ConnectionClosed

from executor import messages
from executor.manager.admission import Admission, is_loopback
from executor.ram.monitor import update_text
from executor.ram.translate import RamError, error_text, state_name, to_native
from executor.session.events import ClientJoined, ClientLeft, CommandCame, Event, Send
from executor.session.ladder import State, is_legal
from executor.stream.outbox import ControlOutbox

if TYPE_CHECKING:
    from collections.abc import Callable, Collection

    from websockets.http11 import Request, Response

    from executor.child_messages import Frame
    from executor.session.protocol import Session

__all__ = ["RamServer"]

_log = logging.getLogger(__name__)

MAX_COMMAND_BYTES: Final = 128 << 20
HEARTBEAT_S: Final = 15.0
UPDATE_S: Final = 0.1
END_S: Final = 20.0
REFUSED: Final = 4409


class RamServer:
    """Serves one session to one client.

    Args:
        session: the session, for its state.
        report: is called with each event for the state machine.
        origins: pages that may connect, apart from local ones, such as `https://example.org`.
    """

    def __init__(
        self, session: Session, report: Callable[[Event], None], *, origins: Collection[str] = ()
    ) -> None:
        self._session = session
        self._report = report
        self._admission = Admission(origins=frozenset(origins))
        self._server: Server | None = None
        self._client: str | None = None
        self._outbox: ControlOutbox | None = None
        self._commands: dict[str, str] = {}
        self._is_2024 = False
        self._update: asyncio.TimerHandle | None = None

    async def start(self, host: str, port: int) -> int:
        """Listens; returns the port.

        Raises:
            OSError: the port is in use, or the address is not of loopback.
        """
        if not is_loopback(host):
            raise OSError(f"the RAM dialect has no token, so it listens on loopback alone, not on {host}")
        self._server = await serve(
            self._serve,
            host,
            port,
            process_request=self._check_request,
            max_size=MAX_COMMAND_BYTES,
            compression=None,
            ping_interval=HEARTBEAT_S,
            ping_timeout=HEARTBEAT_S,
            server_header=None,
        )
        return int(next(iter(self._server.sockets)).getsockname()[1])

    async def close(self) -> None:
        """Closes the connection."""
        if self._update is not None:
            self._update.cancel()
        if self._server is not None:
            self._server.close()
            await self._server.wait_closed()

    def send(self, effect: Send) -> None:
        """Sends an event, if the RAM dialect has a message for it."""
        match effect.payload:
            case messages.Ack() if effect.request is not None:
                self._answer(effect.request, "ack", None)
            case messages.Error() if effect.request is not None:
                self._answer_error(effect.request, effect.payload)
            case messages.StateChanged():
                self._put("state-changed", {"state": self._name_of(effect.payload.state)})
            case messages.Tick() | messages.Tree() | messages.Blackboard():
                self._update_soon()
            case _:
                pass

    def send_frame(self, frame: Frame) -> None:
        """Ignores a frame, since the RAM dialect has no streams."""

    def _check_request(self, connection: ServerConnection, request: Request) -> Response | None:
        refusal = self._admission.judge(request)
        if refusal is None:
            return None
        _log.warning("refused: %s", refusal.text.strip())
        return connection.respond(*refusal)

    async def _serve(self, connection: ServerConnection) -> None:
        if self._client is not None:
            await connection.close(REFUSED, "another client drives this manager")
            return
        client = self._client = f"ram-{uuid4().hex}"
        outbox = ControlOutbox(lambda: self._encode("update", self._update_data()))
        sender = asyncio.create_task(_send_all(connection, outbox))
        try:
            with contextlib.suppress(ConnectionClosed, TimeoutError):
                await self._settle()
                self._outbox = outbox
                self._report(ClientJoined(client))
                async for frame in connection:
                    self._take(client, frame)
                    await asyncio.sleep(0)  # lets the loop handle messages of the world
                    await outbox.has_room()
        finally:
            sender.cancel()
            if self._session.state is not State.IDLE:
                # The dialect has no way to reconnect to a session.
                self._report(CommandCame(client, "", "disconnect", messages.Empty()))
            self._report(ClientLeft(client))
            self._client, self._outbox, self._is_2024 = None, None, False
            self._commands.clear()

    async def _settle(self) -> None:
        """Waits until the session of the last client has ended."""
        async with asyncio.timeout(END_S):
            while self._session.state is not State.IDLE or self._session.children.leaving:  # noqa: ASYNC110
                await asyncio.sleep(0.05)

    def _take(self, client: str, frame: str | bytes) -> None:
        request = str(uuid4())
        try:
            if isinstance(frame, bytes):
                raise msgspec.DecodeError("commands are text frames")
            message = msgspec.json.decode(frame, type=messages.ClientMessage)
            request = message.id
            if message.command == "gui":
                return  # for the exercise's own web page, which does not exist here; RAM never answers it
            native = to_native(message.command, msgspec.json.decode(message.data))
        except (msgspec.DecodeError, RecursionError, UnicodeError, RamError) as error:
            self._answer(request, "error", {"message": str(error)})
            return
        if native.is_2024 is not None:
            self._is_2024 = native.is_2024
        self._commands[request] = message.command
        if native.command == "connect" and is_legal(self._session.state, "connect"):
            self._put("introspection", self._introspection())
        self._report(CommandCame(client, request, native.command, native.data))

    def _answer(self, request: str, command: str, data: Any) -> None:
        asked = self._commands.pop(request, "")
        if self._outbox is not None and request:
            self._outbox.put(self._encode(command, data, request), is_reply=True)
        if asked == "terminate_application" and command == "ack" and self._client is not None:
            self._report(CommandCame(self._client, "", "reset_world", messages.Empty()))

    def _answer_error(self, request: str, error: messages.Error) -> None:
        state = self._name_of(self._session.state.value)
        text = error_text(error, self._commands.get(request, ""), state)
        self._answer(request, "error", {"code": error.code, "message": text})

    def _put(self, command: str, data: Any) -> None:
        if self._outbox is not None:
            self._outbox.put(self._encode(command, data), is_reply=False)

    def _update_soon(self) -> None:
        if self._update is None and self._outbox is not None:
            self._update = asyncio.get_running_loop().call_later(UPDATE_S, self._send_update)

    def _send_update(self) -> None:
        self._update = None
        self._put("update", self._update_data())

    def _update_data(self) -> dict[str, str]:
        return {"update": update_text(self._session.mirror)}

    def _introspection(self) -> dict[str, str]:
        about = self._session.about
        # Clients read the misspelt key.
        return {
            "robotics_backend_version": about.version,
            "radi_version": about.version,
            "ros_version": about.ros_distro,
            "gpu_avaliable": "OFF",
        }

    def _name_of(self, state: str) -> str:
        return state_name(state, is_2024=self._is_2024)

    @staticmethod
    def _encode(command: str, data: Any, request: str | None = None) -> bytes:
        return json.dumps({"id": request or str(uuid4()), "command": command, "data": data}).encode()


async def _send_all(connection: ServerConnection, outbox: ControlOutbox) -> None:
    with contextlib.suppress(ConnectionClosed):
        while True:
            await connection.send(await outbox.take(), text=True)
