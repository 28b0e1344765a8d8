"""A Docker engine that runs no containers: what the image is called says how its executor behaves.

good      takes its socket from the gate and listens
failing   ends with status 3
never     runs, and never comes to the gate
waits     is good when `go_on` is set
tools     is `executor.tools`, as a child of this process
manager   is `executor.manager`, as a child of this process
liar      shows a wrong token at the gate, and ends
"""

from __future__ import annotations

import contextlib
import json
import os
import socketserver
import subprocess
import sys
import threading
import time
from datetime import UTC, datetime
from http.server import BaseHTTPRequestHandler
from pathlib import Path
from urllib.parse import parse_qs, urlsplit

from backend.sessions.keeper.plan import GATE_FOLDER
from executor.manager.gate import fetch_listener

REPOSITORY = Path(__file__).parents[2]


class FakeDocker(socketserver.ThreadingUnixStreamServer):
    """Listens at a path; `containers` has every container that was created and not removed."""

    daemon_threads = True

    def __init__(self, path, gate_folder):
        self.containers = {}
        self.listeners = {}
        self.children = {}
        self.requests = []
        self.processes = {}
        self.go_on = threading.Event()
        self.on_start = lambda: None
        self._lock = threading.Lock()
        self._gate = gate_folder
        super().__init__(str(path), _Handler)
        threading.Thread(target=self.serve_forever, daemon=True).start()

    def start(self, name):
        container = self.containers[name]
        container["State"] = {"Running": True, "ExitCode": 0, "OOMKilled": False, "FinishedAt": ""}
        self.on_start()
        threading.Thread(target=self.run, args=(name, container), daemon=True).start()

    def end(self, name, status, *, out_of_memory=False, at=None):
        finished = datetime.fromtimestamp(at or time.time(), UTC).isoformat()
        with self._lock:
            if name in self.listeners:
                self.listeners.pop(name).close()
            if name in self.containers:  # otherwise it was removed meanwhile
                self.containers[name]["State"] = {
                    "Running": False, "ExitCode": status, "OOMKilled": out_of_memory, "FinishedAt": finished,
                }  # fmt: skip

    def run(self, name, container):
        kind, command = container["Image"], container["Cmd"]
        environment = dict(entry.split("=", 1) for entry in container["Env"])
        session = command[command.index("--session") + 1]
        token = environment["BT_STUDIO_MANAGER_TOKEN"]
        door = self._gate / Path(command[command.index("--gate") + 1]).relative_to(GATE_FOLDER)
        if kind == "failing":
            self.end(name, 3)
        elif kind == "liar":
            with contextlib.suppress(OSError):
                self.listeners[name] = fetch_listener(door, session, "wrong" + token)
            self.end(name, 1)
        elif kind in {"tools", "manager"}:
            arguments = [str(door) if part.endswith("/gate.sock") else part for part in command]
            environment |= {"PATH": os.environ["PATH"]}
            entry = container.get("Entrypoint") or ["python", "-m", "executor.manager"]
            program = [sys.executable, *entry[1:], *arguments]
            child = self.children[name] = subprocess.Popen(program, env=environment, cwd=REPOSITORY)
            self.end(name, child.wait())
        elif kind in {"good", "waits"}:
            if kind == "waits":
                self.go_on.wait()
            self._listen(name, container, fetch_listener(door, session, token))

    def _listen(self, name, container, listener):
        """Stores the executor's listening socket, unless the executor ended meanwhile."""
        with self._lock:
            if self.containers.get(name) is container and container["State"]["Running"]:
                self.listeners[name] = listener
                return
        listener.close()

    def close(self):
        self.go_on.set()
        for child in self.children.values():
            child.kill()
            child.wait()
        self.shutdown()
        self.server_close()
        for listener in self.listeners.values():
            listener.close()


class _Handler(BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"
    server: FakeDocker

    def do_GET(self):
        self._answer()

    do_POST = do_DELETE = do_GET  # noqa: N815 - the base class's names

    def _answer(self):
        address = urlsplit(self.path)
        path = address.path.removeprefix("/v1.41")
        query = {name: values[0] for name, values in parse_qs(address.query).items()}
        body = self.rfile.read(int(self.headers.get("Content-Length") or 0))
        self.server.requests.append((self.command, path))
        status, answer = self._act(path, query, json.loads(body) if body else None)
        data = answer if isinstance(answer, bytes) else json.dumps(answer).encode()
        self.send_response(status)
        self.send_header("Content-Length", str(len(data)))
        self.send_header("Connection", "close")
        self.end_headers()
        if data:  # the keeper disconnects after an answer without a body
            self.wfile.write(data)

    def _act(self, path, query, body):
        docker = self.server
        if path == "/containers/create":
            if body["Image"] == "missing":
                return 404, {"message": "No such image: missing"}
            docker.containers[query["name"]] = body | {"Created": time.time(), "State": {"Running": False}}
            return 201, {"Id": query["name"]}
        if path == "/containers/json":
            labels = [label.split("=", 1) for label in json.loads(query["filters"])["label"]]
            return 200, [
                {
                    "Labels": one["Labels"],
                    "State": "running" if one["State"]["Running"] else "exited",
                    "Created": one["Created"],
                }
                for one in docker.containers.values()
                if all(one["Labels"].get(key) == value for key, value in labels)
            ]
        name, _, verb = path.removeprefix("/containers/").partition("/")
        if name not in docker.containers:
            return 404, {"message": f"No such container: {name}"}
        return self._act_on(docker, name, verb)

    def _act_on(self, docker, name, verb):
        if self.command == "DELETE":
            if name in docker.children:
                docker.children[name].kill()
            docker.end(name, 137)
            del docker.containers[name]
            return 204, b""
        if verb == "json":
            return 200, {"State": docker.containers[name]["State"]}
        if verb == "logs":
            line = b"the fake executor starts\n"
            return 200, b"\x01\0\0\0" + len(line).to_bytes(4, "big") + line
        if verb == "stats":
            return 200, {"pids_stats": {"current": docker.processes.get(name, 5)}}
        if verb in {"kill", "stop"} and name in docker.children:
            docker.children[name].kill()
        if verb == "kill":
            docker.end(name, 137)
        if verb == "start":
            docker.start(name)
        if verb == "stop":
            docker.end(name, 143)
        return 204, b""

    def address_string(self):
        return "keeper"

    def log_message(self, format, *args):  # noqa: A002
        pass


def gate_of(folder):
    """Returns the folder that a gate below `folder` shares with executors."""
    return Path(folder) / "gate"


def control_of(folder):
    """Returns the socket on which that gate listens for the keeper."""
    return Path(folder) / "control" / "gate.sock"
