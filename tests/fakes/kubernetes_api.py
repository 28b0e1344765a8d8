"""A strict part of Kubernetes' API for our two namespaces, with a node and an operator that obey the test.

Every body is validated against the schemas of Kubernetes and KubeRay, pods also against Pod Security
`restricted`. Only the verbs of our Roles are allowed. A watch that is too old gets 410, a secret goes with
the pod or RayJob that owns it, and what is deleted has its time to end.
"""

from __future__ import annotations

import json
import re
import threading
import time
import uuid
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import TYPE_CHECKING, Any, Self
from urllib.parse import parse_qs, urlsplit

import jsonschema
import kubernetes_validate

from tests.fakes import kuberay

if TYPE_CHECKING:
    from collections.abc import Callable

VERSION = "1.31.0"
NAMESPACE = "robots"
EVALUATIONS = "evaluations"
_PATH = re.compile(
    r"/(?:api/v1|apis/(?P<group>[a-z0-9.]+)/v1)/namespaces/(?P<namespace>[a-z-]+)/(?P<kind>\w+)"
    r"(?:/(?P<name>[a-z0-9.-]+))?$"
)
_GROUPS = {"pods": None, "secrets": None, "networkpolicies": "networking.k8s.io", "rayjobs": kuberay.GROUP}
ALLOWED = {
    (verb, kind) for kind in ("pods", "secrets") for verb in ("create", "get", "list", "watch", "delete")
}
"""The verbs of the Role in `docker/kubernetes/sessions.yaml`."""
ALLOWED_OF_EVALUATIONS = {(verb, "rayjobs") for verb in ("create", "list", "watch", "delete")} | {
    ("create", "secrets"),
    ("create", "networkpolicies"),
}
"""The verbs of the Role in `docker/kubernetes-evaluations/evaluations.yaml`."""
_ROLES = {NAMESPACE: ALLOWED, EVALUATIONS: ALLOWED_OF_EVALUATIONS}
READY = {"type": "Ready", "status": "True"}


class ApiError(Exception):
    """A refusal, as Kubernetes words it."""

    def __init__(self, code: int, reason: str, message: str, retry_after_s: int | None = None) -> None:
        super().__init__(message)
        self.code, self.retry_after_s = code, retry_after_s
        self.body = {
            "kind": "Status", "apiVersion": "v1", "metadata": {}, "status": "Failure",
            "message": message, "reason": reason, "code": code,
        }  # fmt: skip


class _Server(ThreadingHTTPServer):
    # The kernel drops connections over this number, and tries again after 1, 3 and 7 s: 5 are too few for a
    # hundred clients.
    request_queue_size = 512


class FakeCluster:
    """An API server on a free port of this machine.

    Attributes:
        node: is called with each new pod that has its secret, in a thread; it sets the pod's status.
        operator: is called with each new RayJob that has its secret and network policy, as `node` is.
        has_kuberay: whether RayJobs are known.
        namespaces: the namespaces that exist.
        quota: the largest number of pods.
        busy: the number of requests to create that are still refused with 429.
        asked: the verb and kind of each request.
        is_dead: whether no request is answered any more.
        validates: whether bodies are compared with Kubernetes' schemas, which takes longer than all the rest.
    """

    def __init__(self, node: Callable[[FakeCluster, dict[str, Any]], None] | None = None) -> None:
        self.node = node or make_ready
        self.operator: Callable[[FakeCluster, dict[str, Any]], None] = kuberay.make_running
        self.has_kuberay = True
        self.namespaces = set(_ROLES)
        self.quota = 1000
        self.busy = 0
        self.asked: list[tuple[str, str]] = []
        self.is_dead = False
        self.validates = True
        self._objects: dict[tuple[str, str], dict[str, Any]] = {}
        self._removals: dict[str, Callable[[], None]] = {}
        self._events: list[tuple[int, str, dict[str, Any]]] = []
        self._version = 100
        self._oldest = 0
        self.changed = threading.Condition(threading.RLock())
        cluster = self

        class Handler(_Handler):
            api = cluster

        self._server = _Server(("127.0.0.1", 0), Handler)
        self._server.daemon_threads = True
        threading.Thread(target=self._server.serve_forever, daemon=True).start()

    @property
    def url(self) -> str:
        return f"http://127.0.0.1:{self.port}"

    @property
    def port(self) -> int:
        return int(self._server.server_address[1])

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.die()
        self._server.shutdown()
        self._server.server_close()

    def names(self, kind: str) -> list[str]:
        with self.changed:
            return sorted(name for found, name in self._objects if found == kind)

    def object(self, kind: str, name: str) -> dict[str, Any]:
        with self.changed:
            return self._objects[kind, name]

    def die(self) -> None:
        """Ends all watches, and answers no request any more."""
        self.is_dead = True
        with self.changed:
            self.changed.notify_all()

    def revive(self) -> None:
        """Answers again, after `die`."""
        self.is_dead = False

    def forget_history(self) -> None:
        """Makes all running and older watches too old, as a compaction of etcd does."""
        with self.changed:
            self._version += 1
            self._oldest = self._version
            self.changed.notify_all()

    def drop_silently(self, name: str) -> None:
        """Removes a pod of which no watch hears."""
        with self.changed:
            self._objects.pop(("pods", name))

    def set_status(self, name: str, kind: str = "pods", **status: Any) -> None:
        with self.changed:
            found = self._objects[kind, name]
            found["status"] = {**found.get("status", {}), **status}
            if kind == "rayjobs":
                kuberay.validate(found)
            self._note("MODIFIED", kind, found)

    def when_removed(self, name: str, do: Callable[[], None]) -> None:
        """Registers what a node or operator does when a pod or RayJob is gone."""
        with self.changed:
            self._removals[name] = do

    def remove(self, kind: str, name: str) -> None:
        with self.changed:
            found = self._objects.pop((kind, name), None)
            if found is None:
                return
            if do := self._removals.pop(name, None):
                do()
            self._note("DELETED", kind, found)
            uid = found["metadata"]["uid"]
            for other, owned in list(self._objects.items()):
                if any(owner["uid"] == uid for owner in owned["metadata"].get("ownerReferences", [])):
                    self.remove(*other)

    def create(self, kind: str, body: dict[str, Any], namespace: str = NAMESPACE) -> dict[str, Any]:
        with self.changed:
            if self.busy > 0:
                self.busy -= 1
                raise ApiError(429, "TooManyRequests", "the server has received too many requests", 1)
            if self.validates:
                _validate(kind, body)
            name = body["metadata"]["name"]
            if (kind, name) in self._objects:
                raise ApiError(409, "AlreadyExists", f'{kind} "{name}" already exists')
            if kind == "pods":
                _require_restricted(body)
                if len(self.names("pods")) >= self.quota:
                    raise ApiError(403, "Forbidden", f'pods "{name}" is forbidden: exceeded quota: robots')
            body["metadata"] |= {"namespace": namespace, "uid": str(uuid.uuid4())}
            if kind == "pods":
                body["status"] = {"phase": "Pending"}
            self._objects[kind, name] = body
            self._note("ADDED", kind, body)
            if kind == "secrets" and (pod := self._objects.get(("pods", name))) is not None:
                threading.Thread(target=self.node, args=(self, pod), daemon=True).start()
            if kind == "networkpolicies" and (job := self._objects.get(("rayjobs", name))) is not None:
                threading.Thread(target=self.operator, args=(self, job), daemon=True).start()
            return body

    def delete(self, kind: str, name: str, grace_s: float | None) -> dict[str, Any]:
        with self.changed:
            found = self._objects.get((kind, name))
            if found is None:
                raise ApiError(404, "NotFound", f'{kind} "{name}" not found')
            grace_s = (
                found.get("spec", {}).get("terminationGracePeriodSeconds", 30) if grace_s is None else grace_s
            )
            if not grace_s:
                self.remove(kind, name)
            else:
                found["metadata"]["deletionTimestamp"] = "2026-01-01T00:00:00Z"
                self._note("MODIFIED", kind, found)
                threading.Timer(min(grace_s, 0.2), self.remove, (kind, name)).start()
            return found

    def read(self, kind: str, name: str) -> dict[str, Any]:
        with self.changed:
            found = self._objects.get((kind, name))
            if found is None:
                raise ApiError(404, "NotFound", f'{kind} "{name}" not found')
            return found

    def list(self, kind: str, label: str) -> dict[str, Any]:
        with self.changed:
            items = [found for (of, _), found in self._objects.items() if of == kind and _has(found, label)]
            return {"metadata": {"resourceVersion": str(self._version)}, "items": items}

    def watch(self, kind: str, label: str, version: int, timeout_s: float) -> Any:
        """Yields events, as long as a watch may last; a watch that is too old ends with 410."""
        end_s = time.monotonic() + timeout_s
        while not self.is_dead and time.monotonic() < end_s:
            with self.changed:
                if version < self._oldest:
                    gone = ApiError(410, "Expired", f"too old resource version: {version} ({self._oldest})")
                    yield {"type": "ERROR", "object": gone.body}
                    return
                found = [event for event in self._events if event[0] > version]
                if not found:
                    self.changed.wait(0.5)
            for number, what, text in found:
                version = number
                if text["kind"] == kind and _has(text["object"], label):
                    yield {"type": what, "object": text["object"]}

    def _note(self, what: str, kind: str, body: dict[str, Any]) -> None:
        self._version += 1
        body["metadata"]["resourceVersion"] = str(self._version)
        copied = json.loads(json.dumps(body))
        self._events.append((self._version, what, {"kind": kind, "object": copied}))
        self.changed.notify_all()


def make_ready(cluster: FakeCluster, pod: dict[str, Any]) -> None:
    """Does what a node does with a pod that starts as it should."""
    running = [{"name": "executor", "image": "x", "imageID": "x", "ready": True, "restartCount": 0,
                "state": {"running": {"startedAt": "2026-01-01T00:00:00Z"}}}]  # fmt: skip
    cluster.set_status(
        pod["metadata"]["name"],
        phase="Running",
        podIP="127.0.0.1",
        conditions=[READY],
        containerStatuses=running,
    )


def _has(found: dict[str, Any], label: str) -> bool:
    return not label or label in found["metadata"].get("labels", {})


def _validate(kind: str, body: dict[str, Any]) -> None:
    try:
        if kind == "rayjobs":
            kuberay.validate(body)
            for pod in kuberay.pods_of(body):
                _validate("pods", pod)
                _require_restricted(pod)
            return
        kubernetes_validate.validate(body, VERSION, strict=True)
    except (kubernetes_validate.ValidationError, jsonschema.ValidationError) as error:
        raise ApiError(422, "Invalid", f"{body.get('kind')} is invalid: {error.message}") from error
    for container in body.get("spec", {}).get("containers", []):
        if not container.get("image"):
            raise ApiError(422, "Invalid", "Pod is invalid: spec.containers[0].image: Required value")


def _require_restricted(pod: dict[str, Any]) -> None:
    """Refuses what Pod Security `restricted` refuses, as far as our pods could ask for it."""
    spec = pod["spec"]
    wrong = [field for field in ("hostNetwork", "hostPID", "hostIPC") if spec.get(field)]
    outer = spec.get("securityContext", {})
    if outer.get("seccompProfile", {}).get("type") not in {"RuntimeDefault", "Localhost"}:
        wrong.append("seccompProfile")
    if outer.get("runAsNonRoot") is not True or outer.get("runAsUser") == 0:
        wrong.append("runAsNonRoot")
    for container in spec["containers"]:
        inner = container.get("securityContext", {})
        if inner.get("allowPrivilegeEscalation") is not False:
            wrong.append("allowPrivilegeEscalation")
        if inner.get("capabilities", {}).get("drop") != ["ALL"]:
            wrong.append("capabilities")
    allowed = {"emptyDir", "secret", "configMap", "projected", "persistentVolumeClaim", "downwardAPI"}
    wrong += [volume["name"] for volume in spec.get("volumes", []) if not allowed & set(volume)]
    if wrong:
        raise ApiError(403, "Forbidden", f'violates PodSecurity "restricted:latest": {", ".join(wrong)}')


class _Handler(BaseHTTPRequestHandler):
    api: FakeCluster
    protocol_version = "HTTP/1.1"

    def log_message(self, *_: object) -> None:
        """Logs nothing."""

    def _answer(self) -> None:
        if self.api.is_dead:
            self.close_connection = True
            return None
        split = urlsplit(self.path)
        query = {name: values[-1] for name, values in parse_qs(split.query).items()}
        length = int(self.headers.get("Content-Length", "0"))
        body = json.loads(self.rfile.read(length)) if length else {}
        try:
            found = _PATH.fullmatch(split.path)
            if found is None or not self._knows(found["group"], found["kind"]):
                raise ApiError(404, "NotFound", "the server could not find the requested resource")
            kind, name, namespace = found["kind"], found["name"], found["namespace"]
            verb = self._verb(name, query)
            self.api.asked.append((verb, kind))
            if (verb, kind) not in _ROLES.get(namespace, set()):
                raise ApiError(403, "Forbidden", f"cannot {verb} resource {kind}")
            if verb == "watch":
                return self._stream(kind, query)
            if namespace not in self.api.namespaces:
                raise ApiError(404, "NotFound", f'namespaces "{namespace}" not found')
            if verb == "create":
                self._send(201, self.api.create(kind, body, namespace))
            else:
                self._send(200, self._do(verb, kind, name, query))
        except ApiError as error:
            self._send(error.code, error.body, error.retry_after_s)

    do_GET = do_POST = do_DELETE = do_PATCH = do_PUT = _answer  # noqa: N815 - the names of the base class

    def _verb(self, name: str | None, query: dict[str, str]) -> str:
        if self.command == "GET" and not name:
            return "watch" if query.get("watch") in {"true", "True", "1"} else "list"
        return {"GET": "get", "POST": "create", "DELETE": "delete"}.get(self.command, self.command.lower())

    def _knows(self, group: str | None, kind: str) -> bool:
        known = kind in _GROUPS and _GROUPS[kind] == group
        return known and (kind != "rayjobs" or self.api.has_kuberay)

    def _do(self, verb: str, kind: str, name: str | None, query: dict[str, str]) -> dict[str, Any]:
        api = self.api
        if verb == "list":
            return api.list(kind, query.get("labelSelector", ""))
        if verb == "get":
            return api.read(kind, name or "")
        grace = query.get("gracePeriodSeconds")
        return api.delete(kind, name or "", None if grace is None else float(grace))

    def _send(self, code: int, body: dict[str, Any], retry_after_s: int | None = None) -> None:
        data = json.dumps(body).encode()
        self.send_response(code)
        if retry_after_s is not None:
            self.send_header("Retry-After", str(retry_after_s))
        self.send_header("Content-Type", "application/json")
        self.send_header("Content-Length", str(len(data)))
        self.end_headers()
        self.wfile.write(data)

    def _stream(self, kind: str, query: dict[str, str]) -> None:
        self.send_response(200)
        self.send_header("Content-Type", "application/json")
        self.send_header("Transfer-Encoding", "chunked")
        self.end_headers()
        timeout_s = float(query.get("timeoutSeconds", "300"))
        version = int(query.get("resourceVersion", "0"))
        for event in self.api.watch(kind, query.get("labelSelector", ""), version, timeout_s):
            line = json.dumps(event).encode() + b"\n"
            self.wfile.write(f"{len(line):x}\r\n".encode() + line + b"\r\n")
            self.wfile.flush()
        self.wfile.write(b"0\r\n\r\n")
        self.close_connection = True
