"""The compose stack of a team's server, and a user of it."""

from __future__ import annotations

import http.cookiejar
import json
import re
import secrets
import socket
import subprocess
import time
import urllib.error
import urllib.parse
import urllib.request
from typing import TYPE_CHECKING, Any

from websockets.asyncio.client import connect
from websockets.protocol import State
from websockets.typing import Origin, Subprotocol

from tests.docker.engine import REPOSITORY, _run
from tests.executor.session_client import SessionClient

if TYPE_CHECKING:
    import ssl
    from collections.abc import Mapping
    from pathlib import Path

    from tests.docker.engine import Engine

COMPOSE = REPOSITORY / "docker" / "compose.yaml"
PROXY = REPOSITORY / "docker" / "compose.proxy.yaml"
DEADLINE_S = 240


class Stack:
    """One stack and the commands on its containers.

    Requests go to the web server directly, as from a reverse proxy; `team_server.py` has Caddy.
    """

    files: tuple[Path, ...] = (COMPOSE, PROXY)
    tls: ssl.SSLContext | None = None

    def __init__(self, engine: Engine, folder: Path, tag: str, **settings: str) -> None:
        self.engine = engine
        self.name = "btstudio" + secrets.token_hex(3)
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            self.port = probe.getsockname()[1]
        self.base = f"http://127.0.0.1:{self.port}"
        self._file = folder / f"{self.name}.env"
        values = {
            "BT_STUDIO_VERSION": tag,
            "BT_STUDIO_DOMAIN": "127.0.0.1",
            "BT_STUDIO_PUBLIC_URL": self.base,
            "BT_STUDIO_PUBLISH": f"127.0.0.1:{self.port}",
            "BT_STUDIO_SECRET_KEY": secrets.token_hex(32),
            "BT_STUDIO_DATABASE_PASSWORD": secrets.token_hex(16),
            "BT_STUDIO_DOCKER_SOCKET": str(engine.socket),
            "BT_STUDIO_DOCKER_GID": str(engine.socket.stat().st_gid),
            **settings,
        }
        self._file.write_text("".join(f"{name}={value}\n" for name, value in values.items()))

    def compose(self, *arguments: str, **options: object):
        return _run((*self._command, *arguments), self.engine.environment, **options)

    @property
    def _command(self) -> tuple[str, ...]:
        files = (word for file in self.files for word in ("-f", str(file)))
        return (*self.engine.compose, "-p", self.name, *files, "--env-file", str(self._file))

    def up(self) -> float:
        """Starts everything; returns the seconds until the first page came."""
        started = time.monotonic()
        self.compose("up", "-d")
        self.await_page()
        return time.monotonic() - started

    def await_page(self) -> None:
        deadline = time.monotonic() + DEADLINE_S
        while True:
            try:
                with urllib.request.urlopen(self.base + "/accounts/login/", timeout=5, context=self.tls):
                    return
            except OSError as error:
                if time.monotonic() > deadline:
                    logs = self.compose("logs", "--tail=40").stdout
                    raise AssertionError(f"there is no page: {error}\n{logs}") from error
                time.sleep(0.1)

    def await_healthy(self, service: str) -> None:
        """Waits until the service's health check succeeds."""
        self.await_container(self.container(service))

    def await_container(self, name: str) -> None:
        """Waits until the container's health check succeeds."""
        deadline = time.monotonic() + DEADLINE_S
        format_ = "{{.State.Health.Status}}"
        while self.engine.run("inspect", "-f", format_, name).stdout.strip() != "healthy":
            assert time.monotonic() < deadline, self.engine.run("logs", "--tail=40", name).stdout
            time.sleep(0.5)

    def down(self) -> None:
        # Services that start containers end first.
        self.compose("stop", "-t", "5", "web", "keeper", check=False)
        for name in self.sessions() + self.tools():
            self.engine.run("rm", "-f", name)
        self.compose("down", "-v", "-t", "5")

    def container(self, service: str) -> str:
        return self.compose("ps", "-q", service).stdout.strip()

    @property
    def address(self) -> tuple[str, int]:
        """Returns the address of the web server."""
        return "127.0.0.1", self.port

    def restarts(self) -> dict[str, str]:
        """Returns how often each service was restarted, and whether one was killed for memory."""
        found = self.compose("ps", "-q").stdout.split()
        format_ = "{{.Name}} {{.RestartCount}} {{.State.StartedAt}} {{.State.OOMKilled}}"
        lines = self.engine.run("inspect", "-f", format_, *found).stdout.strip().splitlines()
        return {name: rest for name, _, rest in (line.partition(" ") for line in lines)}

    def memory(self) -> str:
        """Returns the memory of each service."""
        found = self.compose("ps", "-q").stdout.split()
        format_ = "{{.Name}} {{.MemUsage}} {{.PIDs}} pids"
        return "; ".join(
            self.engine.run("stats", "--no-stream", "--format", format_, *found).stdout.splitlines()
        )

    def gateway(self) -> str:
        """Returns the address of this machine on the network of the web server."""
        format_ = "{{range .NetworkSettings.Networks}}{{.Gateway}} {{end}}"
        return self.engine.run("inspect", "-f", format_, self.container("web")).stdout.split()[0]

    def sessions(self) -> list[str]:
        """Returns the names of the running executor containers."""
        return self._made("session")

    def tools(self) -> list[str]:
        """Returns the names of the running containers with users' tools."""
        return self._made("tools")

    def _made(self, kind: str) -> list[str]:
        filters = (
            "--filter",
            f"label=org.bt-studio.stack={self.name}",
            "--filter",
            f"label=org.bt-studio.{kind}",
        )
        return self.engine.run("ps", *filters, "--format", "{{.Names}}").stdout.split()

    def studio(self, *arguments: str, **options: object):
        """Runs `bt-studio` in the web container."""
        return self.compose("exec", "-T", "web", "bt-studio", *arguments, **options)

    def backup(self) -> bytes:
        """Returns the output of `bt-studio backup -`."""
        return self._studio_bytes("backup", "-")

    def restore(self, archive: bytes) -> None:
        """Passes a backup to `bt-studio restore -`."""
        self._studio_bytes("restore", "-", input=archive)

    def _studio_bytes(self, *arguments: str, **options: Any) -> bytes:
        command = (*self._command, "exec", "-T", "web", "bt-studio", *arguments)
        done = subprocess.run(
            command, env=self.engine.environment, check=False, capture_output=True, cwd=REPOSITORY, **options
        )
        assert done.returncode == 0, done.stderr.decode()
        return done.stdout

    def add_user(self, name: str) -> User:
        password = secrets.token_urlsafe(12)
        self.studio("admin", "create", name, "--user", "--password-stdin", input=password + "\n")
        return User(self, name, password)


class User:
    """A user who has signed in by the page's form."""

    def __init__(
        self, stack: Stack, name: str, password: str, headers: Mapping[str, str] | None = None
    ) -> None:
        self.begin(stack, headers or {})
        self._name, self._password = name, password
        self.sign_in()

    def begin(self, stack: Stack, headers: Mapping[str, str]) -> None:
        """Opens a browser session without an account, with the headers that it adds to each request."""
        self._headers = headers
        self._base, self._tls = stack.base, stack.tls
        self._jar = http.cookiejar.CookieJar()
        handlers: list[urllib.request.BaseHandler] = [urllib.request.HTTPCookieProcessor(self._jar)]
        handlers += [urllib.request.HTTPSHandler(context=self._tls)] if self._tls else []
        self._opener = urllib.request.build_opener(*handlers)

    def sign_in(self) -> None:
        page = self.open("GET", "/accounts/login/").decode()
        token = re.search(r'name="csrfmiddlewaretoken" value="([^"]+)"', page)
        assert token is not None, page
        form = {"login": self._name, "password": self._password, "csrfmiddlewaretoken": token[1]}
        self.open("POST", "/accounts/login/", urllib.parse.urlencode(form).encode())
        assert self.get("me")["user"] == self._name

    def open(self, method: str, path: str, data: bytes | None = None, kind: str = "") -> bytes:
        """Requests a page; returns its body.

        Raises:
            AssertionError: it was refused; the text says how.
        """
        headers = {"Origin": self._base, "Referer": self._base + path, **self._headers}
        headers |= {"Content-Type": kind} if kind else {}
        request = urllib.request.Request(self._base + path, data, headers, method=method)
        try:
            with self._opener.open(request, timeout=60) as response:
                return response.read()
        except urllib.error.HTTPError as error:
            raise AssertionError(f"{method} {path}: {error.code} {error.read().decode()[:2000]}") from error

    def _api(self, method: str, path: str, body: object = None):
        data = None if body is None else json.dumps(body).encode()
        answer = self.open(method, f"/api/v1/{path}", data, "application/json" if data else "")
        return json.loads(answer) if answer else None

    def get(self, path: str):
        return self._api("GET", path)

    def post(self, path: str, body: object = None):
        return self._api("POST", path, body)

    def delete(self, path: str):
        return self._api("DELETE", path)

    def app(self, project: str) -> str:
        """Returns the project as the executor receives it."""
        return self.get(f"projects/{project}/app")["app_zip_base64"]

    @property
    def cookies(self) -> str:
        return "; ".join(f"{cookie.name}={cookie.value}" for cookie in self._jar)

    async def open_session(self, session: dict[str, str], *, stream: bool = True) -> RelayedClient:
        return await self.client_of(session).open(stream=stream)

    def open_language(self, project: str) -> connect:
        """Opens the socket of a Python editor."""
        return self._open_socket(project, "language")

    def open_notices(self, project: str) -> connect:
        """Opens the socket of a page that waits for notices."""
        return self._open_socket(project, "notices")

    def _open_socket(self, project: str, name: str) -> connect:
        return connect(
            f"{self._base.replace('http', 'ws', 1)}/ws/projects/{project}/{name}",
            additional_headers={"Cookie": self.cookies},
            origin=Origin(self._base),
            proxy=None,
            open_timeout=60,
            ssl=self._tls,
        )

    def client_of(self, session: dict[str, str]) -> RelayedClient:
        return RelayedClient(self._base, session["id"], self.cookies, self._tls)


class RelayedClient(SessionClient):
    """A client of a session by way of the web server, as a browser is."""

    def __init__(self, base: str, session_id: str, cookies: str, tls: ssl.SSLContext | None = None) -> None:
        super().__init__(0)
        self._origin, self._tls = base, tls
        self._session_id = session_id
        self._headers = {"Cookie": cookies}

    @property
    def is_closed(self) -> bool:
        """Whether the server has ended the socket."""
        return self.control.state is not State.OPEN

    def _connect(self, path: str):
        return connect(
            f"{self._origin.replace('http', 'ws', 1)}/ws/sessions/{self._session_id}{path}",
            additional_headers=self._headers,
            origin=Origin(self._origin),
            subprotocols=[Subprotocol("bt-studio.v1")],
            max_size=None,
            compression=None,
            proxy=None,
            open_timeout=60,
            ssl=self._tls,
        )
