"""Starts and ends the pods of sessions and tools."""

from __future__ import annotations

import logging
import math
import socket
from time import monotonic, sleep
from typing import TYPE_CHECKING, Any, Final, TypeVar

import httpx2
import msgspec
from django.core.exceptions import ImproperlyConfigured
from lightkube import ApiError, Client, KubeConfig
from lightkube.config.client_adapter import verify_cluster
from lightkube.config.models import User
from lightkube.core.exceptions import ConfigError
from lightkube.resources.core_v1 import Pod, Secret

from backend.sessions.errors import HostFullError, LaunchError
from backend.sessions.launchers.base import UNKNOWN_EXIT, Launcher, Spec, Started, State
from backend.sessions.launchers.kubernetes.bodies import (
    PORT,
    Kind,
    TemplateError,
    id_label,
    pod_body,
    pod_name,
    read_template,
    secret_body,
)
from backend.sessions.launchers.kubernetes.ends import Cause, read_pod
from backend.sessions.launchers.kubernetes.pods import Pods
from backend.sessions.manager.certificate import make_certificate

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from lightkube.config.kubeconfig import SingleConfig

    from backend.sessions.launchers.kubernetes.ends import Seen

__all__ = ["KubernetesLauncher", "open_cluster", "read_settings"]

log = logging.getLogger(__name__)

FORBIDDEN: Final = 403
NOT_FOUND: Final = 404
CONFLICT: Final = 409
TOO_MANY: Final = 429
QUOTA: Final = "exceeded quota"
LAST_GRACE_S: Final = 5.0
"""How long a pod that was killed may need to disappear."""
UNKNOWN_S: Final = 15.0
"""How long a pod of which nothing is known counts as running."""
_SHORTEST_PAUSE_S: Final = 0.5
# A watch waits for the next event without a limit: a connection that is lost silently must end by itself.
_KEPT_ALIVE: Final = (
    (socket.SOL_SOCKET, socket.SO_KEEPALIVE, 1),
    (socket.IPPROTO_TCP, socket.TCP_KEEPIDLE, 15),
    (socket.IPPROTO_TCP, socket.TCP_KEEPINTVL, 5),
    (socket.IPPROTO_TCP, socket.TCP_KEEPCNT, 3),
)
Made = TypeVar("Made", Pod, Secret)


def open_cluster(template: Path, tools_template: Path, namespace: str) -> KubernetesLauncher:
    """Returns the launcher of the cluster in which this server runs, or that `KUBECONFIG` names.

    Args:
        template: the file of the pod that is made for each session.
        tools_template: the file of the pod that is made for each user's tools.
        namespace: the namespace in which pods are made.

    Raises:
        ImproperlyConfigured: there is no such cluster, or the file is no such template.
    """
    config, made = read_settings(template, tools_template)
    verify = verify_cluster(config.cluster, config.user or User(), config.abs_file)
    transport = httpx2.HTTPTransport(verify=verify, socket_options=_KEPT_ALIVE)
    return KubernetesLauncher(Client(config=config, namespace=namespace, transport=transport), made)


def read_settings(template: Path, tools_template: Path) -> tuple[SingleConfig, dict[Kind, dict[str, Any]]]:
    """Returns the cluster and the templates, as `open_cluster` finds them; contacts nobody.

    Raises:
        ImproperlyConfigured: there is no such cluster, or the file is no such template.
    """
    made = {
        Kind.SESSION: _read_template("BT_STUDIO_POD_TEMPLATE", template),
        Kind.TOOLS: _read_template("BT_STUDIO_TOOLS_TEMPLATE", tools_template),
    }
    sentence = "BT_STUDIO_LAUNCHER=kubernetes: this is no pod of a cluster, and KUBECONFIG names none"
    try:
        config = KubeConfig.from_env().get()
    except (ConfigError, OSError) as error:
        raise ImproperlyConfigured(f"{sentence}: {error}.") from error
    if config is None or config.user is None:
        raise ImproperlyConfigured(f"{sentence}: it has no current context with a user.")
    return config, made


def _read_template(variable: str, file: Path) -> dict[str, Any]:
    try:
        return read_template(file.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, TemplateError) as error:
        raise ImproperlyConfigured(f"{variable}: {file} cannot be used: {error}.") from error


class _TakenError(HostFullError):
    """A pod of this name exists."""


class KubernetesLauncher(Launcher):
    """Starts executors as pods of one namespace.

    Args:
        client: the client of the cluster, for the namespace of the sessions.
        templates: the pods that are made for sessions and tools (`bodies.read_template`).
    """

    name = "kubernetes"
    survives_server = True
    keeps_warm = True
    starts_at_once = 128

    def __init__(self, client: Client, templates: dict[Kind, dict[str, Any]]) -> None:
        self._client = client
        self._templates = templates
        # msgspec, which reads the objects, does not end if two threads meet a type for the first time.
        msgspec.convert({}, Pod)
        msgspec.convert({}, Secret)
        self._pods = Pods(client)
        self._unknown_since: dict[str, float] = {}

    def start(self, spec: Spec) -> Started:
        """Makes a pod and its secret, and waits until the manager in it listens."""
        return self._bring_up(Kind.SESSION, spec.session_id, spec.token, spec.start_timeout_s)

    def warm(self, spec: Spec) -> Started:
        """Makes a pod that waits for its session, as `start` does."""
        return self._bring_up(Kind.WARM, spec.session_id, spec.token, spec.start_timeout_s)

    def warm_running(self) -> dict[str, dict[str, Any]]:
        """Returns the states of the warm pods that have not ended, as the cluster says now."""
        return {made_id: self.warm_state_of(made_id) for made_id in self._living(Kind.WARM)}

    def warm_state_of(self, made_id: str) -> dict[str, Any]:
        """Returns the state by which a warm pod is found, from its id."""
        return {"pod": pod_name(Kind.WARM, made_id)}

    def open_tools(self, tools_id: str, token: str, *, timeout_s: float) -> str:
        """Returns the address at which a user's tools listen; makes their pod if there is none.

        Another web server may have made it, or be making it.
        """
        name, deadline_s = pod_name(Kind.TOOLS, tools_id), monotonic() + timeout_s
        while True:
            try:
                return self._bring_up(Kind.TOOLS, tools_id, token, deadline_s - monotonic()).address
            except _TakenError:
                seen = self._await_other(name, deadline_s)
            if seen is not None and seen.is_ready:
                return _address(seen)
            if monotonic() >= deadline_s:
                self.stop({"pod": name}, timeout_s=0)
                raise _not_started(seen, timeout_s)

    def _await_other(self, name: str, deadline_s: float) -> Seen | None:
        """Waits for a pod that exists already; deletes it if it has ended or does not start."""
        found = self._look(name)
        if found is None:
            return None
        if found.exit_status is None:
            found, _ = self._pods.wait(name, _decided(found.uid), deadline_s)
        if found is not None and (found.is_ready or not found.is_decided):
            return found
        self.stop({"pod": name}, timeout_s=0)
        return None

    def tidy(self) -> None:
        """Deletes the pods of tools that have ended by themselves."""
        for pod in self._list(Kind.TOOLS):
            if pod.metadata and pod.metadata.name and read_pod(pod).exit_status is not None:
                self._delete(pod.metadata.name, 0.0)

    def _bring_up(self, kind: Kind, made_id: str, token: str, timeout_s: float) -> Started:
        deadline_s = monotonic() + timeout_s
        made = make_certificate(made_id)
        name = pod_name(kind, made_id)
        template = self._templates[Kind.SESSION if kind is Kind.WARM else kind]
        body = pod_body(template, kind, made_id, made.digest)
        pod = self._create(msgspec.convert(body, Pod), deadline_s)
        uid = (pod.metadata.uid if pod.metadata else None) or ""
        try:
            self._create(msgspec.convert(secret_body(name, token, made, uid), Secret), deadline_s)
            seen, _ = self._pods.wait(name, _decided(uid), deadline_s)
            if seen is None or not seen.is_ready:
                raise _not_started(seen, timeout_s)
        except BaseException:
            self.stop({"pod": name}, timeout_s=0)
            raise
        return Started(_address(seen), {"pod": name, "uid": uid})

    def poll(self, state: State) -> int | None:
        """Returns what is known of the pod. While the cluster does not answer, executors count as running."""
        name = state["pod"]
        seen = self._pods.get(name)
        if seen is not None:
            self._unknown_since.pop(name, None)
            return seen.exit_status
        if not self._pods.are_listed:
            return None
        # Another web server may have made the pod just now.
        since_s = self._unknown_since.setdefault(name, monotonic())
        return UNKNOWN_EXIT if monotonic() - since_s > UNKNOWN_S else None

    def explain(self, state: State) -> str:
        """Returns the reason why a pod ended, if more is known than its status; otherwise ""."""
        seen = self._pods.get(state["pod"])
        return seen.trouble.text if seen and seen.trouble else ""

    def stop(self, state: State, *, timeout_s: float) -> None:
        """Deletes the pod, with time for the manager to end; its secret goes with it."""
        name = state["pod"]
        for grace_s in (timeout_s, 0.0):
            if not self._delete(name, grace_s):
                return
            deadline_s = monotonic() + grace_s + LAST_GRACE_S
            if self._pods.wait(name, _is_over, deadline_s)[1]:
                return
        log.warning("the pod %s does not end", name)

    def running(self) -> list[str]:
        """Returns the ids of the sessions whose pods have not ended, as the cluster says now."""
        return self._living(Kind.SESSION)

    def state_of(self, session_id: str) -> dict[str, Any]:
        """Returns the state by which a pod is found, from the id of its session."""
        return {"pod": pod_name(Kind.SESSION, session_id)}

    def close(self) -> None:
        """Ends the watch over the pods, which stay."""
        self._pods.close()

    def _living(self, kind: Kind) -> list[str]:
        living = [pod.metadata for pod in self._list(kind) if read_pod(pod).exit_status is None]
        return [found.labels[id_label(kind)] for found in living if found and found.labels]

    def _list(self, kind: Kind) -> list[Pod]:
        try:
            return list(self._client.list(Pod, labels={id_label(kind): None}, chunk_size=500))
        except (httpx2.HTTPError, OSError) as error:
            log.warning("the cluster does not list its pods: %s", error)
            return []

    def _look(self, name: str) -> Seen | None:
        """Returns what the cluster says of a pod now; None if there is none.

        Raises:
            LaunchError: the cluster does not answer.
        """
        try:
            return read_pod(self._client.get(Pod, name))
        except ApiError as error:
            if error.status.code == NOT_FOUND:
                return None
            raise _refused(error) from error
        except (httpx2.HTTPError, OSError) as error:
            raise LaunchError(f"The cluster does not answer: {error}.") from error

    def _create(self, body: Made, deadline_s: float) -> Made:
        """Makes an object; asks again while the cluster has too many requests.

        Raises:
            HostFullError: the quota of the namespace is used up, or the pod's last one has not gone yet.
            LaunchError: the cluster refuses the object, or does not answer.
        """
        while True:
            try:
                return self._client.create(body)
            except ApiError as error:
                if error.status.code != TOO_MANY or monotonic() >= deadline_s:
                    raise _refused(error) from error
                sleep(_pause_s(error))
            except (httpx2.HTTPError, OSError) as error:
                if body.metadata and body.metadata.name:  # it may have been made all the same
                    self._delete(body.metadata.name, 0.0)
                raise LaunchError(f"The cluster does not answer: {error}.") from error

    def _delete(self, name: str, grace_s: float) -> bool:
        """Asks for the end of a pod; returns False if there is none."""
        try:
            self._client.delete(Pod, name, grace_period=math.ceil(grace_s))
        except ApiError as error:
            if error.status.code == NOT_FOUND:
                return False
            log.warning("the pod %s is not deleted: %s", name, error.status.message)
        except (httpx2.HTTPError, OSError) as error:
            log.warning("the pod %s is not deleted: %s", name, error)
        return True


def _address(seen: Seen) -> str:
    host = f"[{seen.address}]" if ":" in seen.address else seen.address
    return f"wss://{host}:{PORT}#{seen.digest}"


def _decided(uid: str) -> Callable[[Seen | None], bool]:
    """Returns a condition: it is known whether the pod with this uid is ready."""
    return lambda seen: seen is not None and seen.uid == uid and seen.is_decided


def _is_over(seen: Seen | None) -> bool:
    return seen is None or seen.exit_status is not None


def _refused(error: ApiError) -> LaunchError | HostFullError:
    text = error.status.message or str(error)
    if error.status.code == FORBIDDEN and QUOTA in text:
        return HostFullError(f"The robots of this server have used up their part of the cluster. ({text})")
    if error.status.code == CONFLICT:
        return _TakenError("The last executor of this session has not ended yet.")
    return LaunchError(f"The cluster refused the executor: {text}", hint="Ask who runs this server.")


def _not_started(seen: Seen | None, timeout_s: float) -> LaunchError | HostFullError:
    """Returns why a pod did not become ready."""
    if seen is not None and seen.trouble is not None:
        kind = HostFullError if seen.trouble.cause is Cause.NO_ROOM else LaunchError
        return kind(seen.trouble.text)
    if seen is not None and seen.exit_status is not None:
        return LaunchError(f"The executor ended while it started (status {seen.exit_status}).")
    return LaunchError(f"The executor was not ready within {timeout_s:.0f} s.")


def _pause_s(error: ApiError) -> float:
    """Returns how long the cluster asks to wait, in s."""
    asked = error.response.headers.get("Retry-After", "") if error.response is not None else ""
    return max(_SHORTEST_PAUSE_S, float(asked) if asked.isdecimal() else 0.0)
