"""Starts and ends the pods of sessions and tools."""

from __future__ import annotations

import logging
import socket
from time import monotonic
from typing import TYPE_CHECKING, Any, Final, NamedTuple, TypeVar

import httpx2
import msgspec
from django.core.exceptions import ImproperlyConfigured
from lightkube import ApiError, Client, KubeConfig
from lightkube.config.client_adapter import verify_cluster
from lightkube.config.models import User
from lightkube.core.exceptions import ConfigError
from lightkube.resources.core_v1 import Pod, Secret

from backend.sessions.errors import HostFullError, LaunchError
from backend.sessions.launchers.base import Launcher, Spec, Started, State
from backend.sessions.launchers.kubernetes.asking import NOT_FOUND, TakenError, create, delete, refused
from backend.sessions.launchers.kubernetes.bodies import (
    POD,
    Kind,
    TemplateError,
    id_label,
    pod_body,
    pod_name,
    read_template,
    secret_body,
)
from backend.sessions.launchers.kubernetes.ends import Cause, address_of, read_pod
from backend.sessions.launchers.kubernetes.objects import Objects, decided, is_over
from backend.sessions.launchers.kubernetes.rayjob_bodies import JobTemplate, rayjob_name, read_job_template
from backend.sessions.launchers.kubernetes.rayjobs import RAYJOB, RayJobs
from backend.sessions.manager.certificate import make_certificate

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from lightkube.config.kubeconfig import SingleConfig

    from backend.sessions.launchers.kubernetes.ends import Seen

__all__ = ["Files", "KubernetesLauncher", "open_cluster", "read_settings"]

log = logging.getLogger(__name__)

LAST_GRACE_S: Final = 5.0
"""How long a pod that was killed may need to disappear."""
# A watch waits for the next event without a limit: a connection that is lost silently must end by itself.
_KEPT_ALIVE: Final = (
    (socket.SOL_SOCKET, socket.SO_KEEPALIVE, 1),
    (socket.IPPROTO_TCP, socket.TCP_KEEPIDLE, 15),
    (socket.IPPROTO_TCP, socket.TCP_KEEPINTVL, 5),
    (socket.IPPROTO_TCP, socket.TCP_KEEPCNT, 3),
)


Template = TypeVar("Template")


class Files(NamedTuple):
    """The files of the templates; `evaluations` is None where evaluations run in pods as sessions do."""

    session: Path
    tools: Path
    evaluations: Path | None = None


class Settings(NamedTuple):
    """The cluster, and what is made there."""

    config: SingleConfig
    pods: dict[Kind, dict[str, Any]]
    job: JobTemplate | None


def open_cluster(files: Files, namespace: str, evaluations_namespace: str = "") -> KubernetesLauncher:
    """Returns the launcher of the cluster in which this server runs, or that `KUBECONFIG` names.

    Args:
        files: the files of what is made for sessions, tools and evaluations.
        namespace: the namespace in which pods are made.
        evaluations_namespace: the namespace in which RayJobs are made.

    Raises:
        ImproperlyConfigured: there is no such cluster, or a file is no such template.
    """
    found = read_settings(files)
    jobs = None
    if found.job is not None:
        jobs = RayJobs(_client(found.config, evaluations_namespace), found.job)
    return KubernetesLauncher(_client(found.config, namespace), found.pods, jobs)


def _client(config: SingleConfig, namespace: str) -> Client:
    verify = verify_cluster(config.cluster, config.user or User(), config.abs_file)
    transport = httpx2.HTTPTransport(verify=verify, socket_options=_KEPT_ALIVE)
    return Client(config=config, namespace=namespace, transport=transport)


def read_settings(files: Files) -> Settings:
    """Returns the cluster and the templates, as `open_cluster` finds them; contacts nobody.

    Raises:
        ImproperlyConfigured: there is no such cluster, or a file is no such template.
    """
    pods = {
        Kind.SESSION: _read("BT_STUDIO_POD_TEMPLATE", files.session, read_template),
        Kind.TOOLS: _read("BT_STUDIO_TOOLS_TEMPLATE", files.tools, read_template),
    }
    job = None
    if files.evaluations is not None:
        job = _read("BT_STUDIO_RAYJOB_TEMPLATE", files.evaluations, read_job_template)
    sentence = "BT_STUDIO_LAUNCHER=kubernetes: this is no pod of a cluster, and KUBECONFIG names none"
    try:
        config = KubeConfig.from_env().get()
    except (ConfigError, OSError) as error:
        raise ImproperlyConfigured(f"{sentence}: {error}.") from error
    if config is None or config.user is None:
        raise ImproperlyConfigured(f"{sentence}: it has no current context with a user.")
    return Settings(config, pods, job)


def _read(variable: str, file: Path, read: Callable[[str], Template]) -> Template:
    try:
        return read(file.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, TemplateError) as error:
        raise ImproperlyConfigured(f"{variable}: {file} cannot be used: {error}.") from error


class KubernetesLauncher(Launcher):
    """Starts executors as pods of one namespace.

    Args:
        client: the client of the cluster, for the namespace of the sessions.
        templates: the pods that are made for sessions and tools (`bodies.read_template`).
        rayjobs: what starts evaluations as RayJobs; None if they run in pods as sessions do.
    """

    name = "kubernetes"
    survives_server = True
    keeps_warm = True
    starts_at_once = 128

    def __init__(
        self, client: Client, templates: dict[Kind, dict[str, Any]], rayjobs: RayJobs | None = None
    ) -> None:
        self._client = client
        self._templates = templates
        # msgspec, which reads the objects, does not end if two threads meet a type for the first time.
        msgspec.convert({}, Pod)
        msgspec.convert({}, Secret)
        self._pods = Objects(client, Pod, read_pod)
        self._rayjobs = rayjobs

    def start(self, spec: Spec) -> Started:
        """Makes a pod and its secret, or a RayJob with them, and waits until the manager in it listens."""
        if self._rayjobs is not None and spec.own_cluster:
            return self._rayjobs.start(spec.session_id, spec.token, spec.start_timeout_s)
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
            except TakenError:
                seen = self._await_other(name, deadline_s)
            if seen is not None and seen.is_ready:
                return address_of(seen)
            if monotonic() >= deadline_s:
                self.stop({"pod": name}, timeout_s=0)
                raise _not_started(seen, timeout_s)

    def _await_other(self, name: str, deadline_s: float) -> Seen | None:
        """Waits for a pod that exists already; deletes it if it has ended or does not start."""
        found = self._look(name)
        if found is None:
            return None
        if found.exit_status is None:
            found, _ = self._pods.wait(name, decided(found.uid), deadline_s)
        if found is not None and (found.is_ready or not found.is_decided):
            return found
        self.stop({"pod": name}, timeout_s=0)
        return None

    def tidy(self) -> None:
        """Deletes the pods of tools that have ended by themselves."""
        for pod in self._list(Kind.TOOLS):
            if pod.metadata and pod.metadata.name and read_pod(pod).exit_status is not None:
                delete(self._client, Pod, pod.metadata.name, 0.0)

    def _bring_up(self, kind: Kind, made_id: str, token: str, timeout_s: float) -> Started:
        deadline_s = monotonic() + timeout_s
        made = make_certificate(made_id)
        name = pod_name(kind, made_id)
        template = self._templates[Kind.SESSION if kind is Kind.WARM else kind]
        body = pod_body(template, kind, made_id, made.digest)
        pod = create(self._client, msgspec.convert(body, Pod), deadline_s)
        uid = (pod.metadata.uid if pod.metadata else None) or ""
        try:
            secret = msgspec.convert(secret_body(name, token, made, POD, uid), Secret)
            create(self._client, secret, deadline_s, is_owned=True)
            seen, _ = self._pods.wait(name, decided(uid), deadline_s)
            if seen is None or not seen.is_ready:
                raise _not_started(seen, timeout_s)
        except BaseException:
            self.stop({"pod": name}, timeout_s=0)
            raise
        return Started(address_of(seen), {"pod": name, "uid": uid})

    def poll(self, state: State) -> int | None:
        """Returns what is known of the pod. While the cluster does not answer, executors count as running."""
        if RAYJOB in state and "pod" not in state:  # of an evaluation that has started
            return self._rayjobs.poll(state[RAYJOB]) if self._rayjobs is not None else None
        return self._pods.poll(state.get("pod", ""))

    def explain(self, state: State) -> str:
        """Returns the reason why a pod ended, if more is known than its status; otherwise ""."""
        if self._rayjobs is not None and RAYJOB in state:
            return self._rayjobs.explain(state[RAYJOB])
        return self._pods.explain(state.get("pod", ""))

    def stop(self, state: State, *, timeout_s: float) -> None:
        """Deletes the pod, with time for the manager to end; its secret goes with it. So with a RayJob."""
        if self._rayjobs is not None and RAYJOB in state:
            self._rayjobs.stop(state[RAYJOB], timeout_s=timeout_s)
        elif RAYJOB in state:
            log.warning("the RayJob %s stays: this server was started without RayJobs", state[RAYJOB])
        name = state.get("pod")
        if name is None:
            return
        for grace_s in (timeout_s, 0.0):
            if not delete(self._client, Pod, name, grace_s):
                return
            deadline_s = monotonic() + grace_s + LAST_GRACE_S
            if self._pods.wait(name, is_over, deadline_s)[1]:
                return
        log.warning("the pod %s does not end", name)

    def running(self) -> list[str]:
        """Returns the ids of the sessions whose pods or RayJobs have not ended, as the cluster says now."""
        return self._living(Kind.SESSION) + (self._rayjobs.running() if self._rayjobs is not None else [])

    def state_of(self, session_id: str) -> dict[str, Any]:
        """Returns the state by which a pod, or a RayJob, is found, from the id of its session."""
        also = {} if self._rayjobs is None else {RAYJOB: rayjob_name(session_id)}
        return {"pod": pod_name(Kind.SESSION, session_id), **also}

    def close(self) -> None:
        """Ends the watch over pods and RayJobs, which stay."""
        self._pods.close()
        if self._rayjobs is not None:
            self._rayjobs.close()

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
            raise refused(error) from error
        except (httpx2.HTTPError, OSError) as error:
            raise LaunchError(f"The cluster does not answer: {error}.") from error


def _not_started(seen: Seen | None, timeout_s: float) -> LaunchError | HostFullError:
    """Returns why a pod did not become ready."""
    if seen is not None and seen.trouble is not None:
        kind = HostFullError if seen.trouble.cause is Cause.NO_ROOM else LaunchError
        return kind(seen.trouble.text)
    if seen is not None and seen.exit_status is not None:
        log.warning("a pod ended with status %s while it started", seen.exit_status)
        return LaunchError("The session ended before it was ready.")
    return LaunchError(f"The session was not ready within {timeout_s:.0f} s.")
