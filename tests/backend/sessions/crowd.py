"""People at two web servers: editors who save all the time, and the pages of sessions and of projects.

They are tasks of one event loop in a thread of its own. Each asks the server that it prefers, and the other
where that one does not answer, as pages behind a proxy do.
"""

from __future__ import annotations

import asyncio
import itertools
import json
import threading
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from time import monotonic
from typing import TYPE_CHECKING, Any, Final, Self

import httpx2
from websockets.asyncio.client import connect
from websockets.exceptions import WebSocketException
from websockets.typing import Origin

from tests.backend.serving import TIMEOUT_S

if TYPE_CHECKING:
    from collections.abc import Coroutine

PATH: Final = "notes.txt"
PACE_S: Final = 1.0
"""Between the answer to a save and the next one."""
PAUSE_S: Final = 0.3
LOOK_S: Final = 0.5
ANSWER_S: Final = 15.0
BUSY: Final = (502, 503)
"""Answers after which a request may be repeated: nothing was done, or a key says what was done."""


class Crowd:
    """Everybody, and how they ask.

    Attributes:
        repeated: the number of answers and errors after which a request was repeated, by kind.
        broken: what went wrong in the tasks of people.
    """

    def __init__(self, ports: list[int]) -> None:
        self.bases = [f"http://127.0.0.1:{port}" for port in ports]
        self.repeated: Counter[str] = Counter()
        self.broken: list[str] = []
        self._loop = asyncio.new_event_loop()
        self._thread = threading.Thread(target=self._loop.run_forever, daemon=True)
        self._tasks: list[asyncio.Task[None]] = []

    def __enter__(self) -> Self:
        self._thread.start()
        self.do(self._open())
        return self

    def __exit__(self, *_: object) -> None:
        self.do(self._close())
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join(TIMEOUT_S)

    def do(self, work: Coroutine[Any, Any, Any]) -> Any:
        """Does something in the loop of the people, and returns its result."""
        return asyncio.run_coroutine_threadsafe(work, self._loop).result()

    def do_all(self, *works: Coroutine[Any, Any, Any]) -> list[Any]:
        """Does several things at the same time."""
        with ThreadPoolExecutor(len(works)) as threads:
            return list(threads.map(self.do, works))

    def begin(self, work: Coroutine[Any, Any, None]) -> None:
        """Starts what one of the people does until all leave."""

        async def begin() -> None:
            self._tasks.append(asyncio.create_task(self._noted(work)))

        self.do(begin())

    async def ask(
        self, method: str, path: str, cookie: str, *, first: int = 0, body: Any = None, key: str = ""
    ) -> Any:
        """Asks one server after the other until the request is done; returns its answer."""
        end_s = monotonic() + TIMEOUT_S
        for number in itertools.count(first):
            base = self.bases[number % 2]
            headers = {"Origin": base, "Cookie": cookie} | ({"Idempotency-Key": key} if key else {})
            try:
                answer = await self._client.request(
                    method, f"{base}/api/v1/{path}", json=body, headers=headers
                )
            except httpx2.HTTPError as error:
                self.repeated[type(error).__name__] += 1
            else:
                if answer.status_code < 300:
                    return answer
                assert answer.status_code in BUSY, (method, path, answer.status_code, answer.text)
                self.repeated[answer.json()["code"]] += 1
            assert monotonic() < end_s, (method, path)
            if number != first:
                await asyncio.sleep(PAUSE_S)  # as a page does
        raise AssertionError

    async def _open(self) -> None:
        limits = httpx2.Limits(max_connections=None, max_keepalive_connections=None)
        self._client = httpx2.AsyncClient(limits=limits, timeout=TIMEOUT_S, trust_env=False)

    async def _close(self) -> None:
        for task in self._tasks:
            task.cancel()
        await asyncio.gather(*self._tasks, return_exceptions=True)
        await self._client.aclose()

    async def _noted(self, work: Coroutine[Any, Any, None]) -> None:
        try:
            await work
        except Exception as error:  # the test looks at these
            self.broken.append(repr(error))


class Editor:
    """Saves a file of a project of its own, one save after the other.

    Attributes:
        acknowledged: the content of each revision that a server has acknowledged.
        began_s: when the last acknowledged save began.
    """

    def __init__(self, crowd: Crowd, number: int, cookie: str) -> None:
        self.crowd, self.number, self.cookie = crowd, number, cookie
        self.acknowledged: dict[int, str] = {}
        self.began_s = 0.0
        self.project = ""
        self._leaves = False
        self._has_left = asyncio.Event()

    async def open(self) -> None:
        """Makes the project."""
        body = {"name": f"Project {self.number}", "template": "laser_bump_and_go"}
        made = await self.ask("POST", "projects", body, f"project-{self.number}")
        self.project = made.json()["id"]

    async def ask(self, method: str, path: str, body: Any = None, key: str = "") -> Any:
        """Asks in the name of this user."""
        return await self.crowd.ask(method, path, self.cookie, first=self.number, body=body, key=key)

    async def save_for_ever(self) -> None:
        """Saves until the saves are looked for."""
        revision = 0
        for number in itertools.count():
            if self._leaves:
                self._has_left.set()
                return
            content = f"editor {self.number}, line {number}"
            body = {"files": [{"path": PATH, "base_revision": revision, "content": content}]}
            began_s = monotonic()
            answer = await self.ask("POST", f"projects/{self.project}/changes", body, f"save-{number}")
            revision = answer.json()["revision"]
            self.acknowledged[revision] = content
            self.began_s = began_s
            await asyncio.sleep(PACE_S)  # people pause between saves

    async def lost(self) -> list[str]:
        """Ends to save, and returns the acknowledged saves that are not stored."""
        self._leaves = True
        await asyncio.wait_for(self._has_left.wait(), TIMEOUT_S)
        lost = []
        for revision, content in self.acknowledged.items():
            found = await self.ask("GET", f"projects/{self.project}/revisions/{revision}/files/{PATH}")
            if found.text != content:
                lost.append(f"project {self.number}, revision {revision}: {found.text!r}, not {content!r}")
        newest = await self.ask("GET", f"projects/{self.project}/files/{PATH}")
        if newest.text != list(self.acknowledged.values())[-1]:
            lost.append(f"project {self.number}: {newest.text!r} is the newest")
        return lost

    def socket(self, path: str, turn: int) -> connect:
        """Opens a socket, at one server or the other in turn."""
        base = self.crowd.bases[(self.number + turn) % 2]
        return connect(
            base.replace("http", "ws", 1) + path,
            additional_headers={"Cookie": self.cookie},
            origin=Origin(base),
            max_size=None,
            proxy=None,
        )


class Listener:
    """The socket by which a page hears of new revisions of its project."""

    def __init__(self, editor: Editor) -> None:
        self._editor = editor
        self.heard_s = 0.0

    async def listen_for_ever(self) -> None:
        """Listens until all leave; opens the socket again when it has closed."""
        path = f"/ws/projects/{self._editor.project}/notices"
        for turn in itertools.count(1):  # not where its editor saves
            try:
                async with self._editor.socket(path, turn) as socket:
                    await socket.recv()  # the newest one, which is no notice
                    while True:
                        await socket.recv()
                        self.heard_s = monotonic()
            except (OSError, WebSocketException):
                await asyncio.sleep(PAUSE_S)  # as a page does


class Page:
    """The page of a session, which opens its socket again when it has closed.

    Attributes:
        answered_s: when the session was last asked and has answered.
        reason: why the session has ended; None while it runs.
        state: of the ladder, as the manager said last.
        faults: of the present run, as the manager said, or as its snapshot says to who comes again.
    """

    def __init__(self, editor: Editor, *, is_real: bool) -> None:
        self.editor, self.is_real = editor, is_real
        self.session = ""
        self.answered_s = 0.0
        self.reason: str | None = None
        self.state = ""
        self.faults: list[str] = []
        self._client = ""
        self._answered: set[str] = set()
        self._refused: dict[str, str] = {}
        self._requests = itertools.count()
        self._to_send: asyncio.Queue[str] = asyncio.Queue()

    async def run(self) -> None:
        """Starts a session, and waits until its manager answers."""
        answer = await self.editor.ask("POST", f"projects/{self.editor.project}/session")
        self.session, self.reason, self._client = answer.json()["id"], None, ""
        began_s = monotonic()
        while self.answered_s < began_s:
            assert self.reason is None, self.reason
            assert monotonic() < began_s + TIMEOUT_S, self.session
            await asyncio.sleep(0.1)  # it asks the server again

    async def drive(self) -> None:
        """Starts the robot, and waits until its tree ticks."""
        app = (await self.editor.ask("GET", f"projects/{self.editor.project}/app")).json()
        application = {name: app[name] for name in ("app_zip_base64", "tick_hz", "on_finish", "on_error")}
        data = {"universe": {"universe": app["universe"]}, "application": application}
        request = f"p{next(self._requests)}"
        self.faults.clear()
        self._to_send.put_nowait(json.dumps({"id": request, "command": "run", "data": data}))
        end_s = monotonic() + TIMEOUT_S
        while request not in self._answered or self.state != "application_running":
            assert request not in self._refused, self._refused
            assert monotonic() < end_s, (self.state, self.faults)
            await asyncio.sleep(0.1)  # it asks the server again

    async def look_for_ever(self) -> None:
        """Looks at the session until all leave."""
        for turn in itertools.count():
            if self.session and self.reason is None:
                found = (await self.editor.ask("GET", f"sessions/{self.session}")).json()
                if found["state"] in {"failed", "ended"}:
                    self.reason = found["error"]
                elif found["state"] == "ready":
                    await self._follow(turn)
            await asyncio.sleep(PAUSE_S)  # as a page does

    async def _follow(self, turn: int) -> None:
        try:
            query = f"?client={self._client}" if self._client else ""  # the driver comes back as the driver
            async with self.editor.socket(f"/ws/sessions/{self.session}/control{query}", turn) as socket:
                self._take(await asyncio.wait_for(socket.recv(), ANSWER_S))
                while True:
                    await self._ask(socket)
        except (OSError, WebSocketException):
            return

    async def _ask(self, socket: Any) -> None:
        """Asks for an answer, and reads until it has come."""
        request = f"p{next(self._requests)}"
        await socket.send(json.dumps({"id": request, "command": "ping", "data": {}}))
        async with asyncio.timeout(ANSWER_S):
            while request not in self._answered:
                self._take(await socket.recv())
        self.answered_s = monotonic()
        pause_s = LOOK_S
        while not self._to_send.empty():
            await socket.send(self._to_send.get_nowait())
            pause_s = 0.0
        await asyncio.sleep(pause_s)  # it asks twice a second

    def _take(self, text: str | bytes) -> None:
        message = json.loads(text)
        request, data = message.get("id", ""), message.get("data", {})
        self._answered.add(request)
        match message.get("command"):
            case "introspection":
                self._client, self.state = data["client_id"], data["state"]
            case "snapshot":
                self.state, self.faults = data["state"], [each["message"] for each in data["faults"]]
            case "state-changed":
                self.state = data["state"]
            case "fault":
                self.faults.append(data["message"])
            case "error":
                self._refused[request] = data["message"]
