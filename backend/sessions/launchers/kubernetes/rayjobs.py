"""Starts and ends evaluations as RayJobs: the KubeRay operator makes a Ray cluster for each.

The program of a RayJob is a manager on the head of that cluster, which runs an evaluation's seeds on the
workers. The web server talks to it as to that of any session.
"""

from __future__ import annotations

import contextlib
import logging
import socket
from time import monotonic, sleep
from typing import TYPE_CHECKING, Any, Final

import httpx2
import msgspec
from lightkube import ApiError
from lightkube.resources.core_v1 import Secret
from lightkube.resources.networking_v1 import NetworkPolicy

from backend.sessions.errors import HostFullError, LaunchError
from backend.sessions.launchers.base import Started
from backend.sessions.launchers.kubernetes.asking import NOT_FOUND, create, delete
from backend.sessions.launchers.kubernetes.bodies import PORT, secret_body
from backend.sessions.launchers.kubernetes.ends import Cause, Seen, address_of
from backend.sessions.launchers.kubernetes.objects import Objects, decided, is_over
from backend.sessions.launchers.kubernetes.rayjob_bodies import (
    ID_LABEL,
    JOB,
    RayJob,
    job_body,
    policy_body,
    rayjob_name,
    read_rayjob,
)
from backend.sessions.manager.certificate import make_certificate

if TYPE_CHECKING:
    from lightkube import Client

    from backend.sessions.launchers.kubernetes.rayjob_bodies import JobTemplate

__all__ = ["RAYJOB", "RayJobs"]

log = logging.getLogger(__name__)

RAYJOB: Final = "rayjob"
"""The key in a launcher's state of the name of a RayJob."""
LOOK_S: Final = 0.2
REACH_S: Final = 2.0
LAST_GRACE_S: Final = 5.0
"""How long the operator may need, beyond the grace of a session, to let a deleted RayJob go."""


class RayJobs:
    """The RayJobs of one namespace.

    Args:
        client: the client of the cluster, for the namespace of the evaluations.
        template: the RayJob that is made for each evaluation, with its network policy.
    """

    def __init__(self, client: Client, template: JobTemplate) -> None:
        self._client = client
        self._template = template
        msgspec.convert({}, Secret)
        msgspec.convert({}, NetworkPolicy)
        self._jobs = Objects(client, RayJob, read_rayjob)

    def start(self, session_id: str, token: str, timeout_s: float) -> Started:
        """Makes a RayJob with its secret and network policy, and waits until its manager listens.

        Raises:
            HostFullError: the quota of the namespace is used up.
            LaunchError: it does not start; the text says why.
        """
        deadline_s = monotonic() + timeout_s
        made, name = make_certificate(session_id), rayjob_name(session_id)
        uid = self._create_job(job_body(self._template, session_id, made.digest), deadline_s)
        try:
            secret = secret_body(name, token, made, JOB, uid)
            create(self._client, msgspec.convert(secret, Secret), deadline_s, is_owned=True)
            policy = policy_body(self._template, session_id, uid)
            create(self._client, msgspec.convert(policy, NetworkPolicy), deadline_s, is_owned=True)
            seen, _ = self._jobs.wait(name, decided(uid), deadline_s)
            if seen is None or not seen.is_ready or not self._listens(name, seen, deadline_s):
                raise _not_started(self._jobs.get(name), timeout_s)
        except BaseException:
            self.stop(name, timeout_s=0)
            raise
        return Started(address_of(seen), {RAYJOB: name, "uid": uid})

    def poll(self, name: str) -> int | None:
        """Returns how a RayJob ended; None while it runs, or while the cluster does not answer."""
        return self._jobs.poll(name)

    def explain(self, name: str) -> str:
        """Returns the reason why a RayJob ended, if more is known than its status; otherwise ""."""
        return self._jobs.explain(name)

    def stop(self, name: str, *, timeout_s: float) -> None:
        """Deletes a RayJob; its Ray cluster, secret and network policy go with it."""
        had_ended = is_over(self._jobs.get(name))
        if not delete(self._client, RayJob, name, timeout_s) or had_ended:
            return
        if not self._jobs.wait_until_gone(name, monotonic() + timeout_s + LAST_GRACE_S):
            log.warning("the RayJob %s does not end", name)

    def running(self) -> list[str]:
        """Returns the ids of the sessions whose RayJobs are there, as the cluster says now.

        Those that have ended count, since nobody else deletes them.
        """
        try:
            jobs = list(self._client.list(RayJob, labels={ID_LABEL: None}, chunk_size=500))
        except (httpx2.HTTPError, OSError) as error:
            log.warning("the cluster does not list its RayJobs: %s", error)
            return []
        found = [job.metadata for job in jobs if job.metadata and not job.metadata.deletionTimestamp]
        return [each.labels[ID_LABEL] for each in found if each.labels]

    def close(self) -> None:
        """Ends the watch over the RayJobs, which stay."""
        self._jobs.close()

    def _create_job(self, body: dict[str, Any], deadline_s: float) -> str:
        try:
            made = create(self._client, RayJob(body), deadline_s)
        except LaunchError as error:
            cause = error.__cause__
            if isinstance(cause, ApiError) and cause.status.code == NOT_FOUND:
                raise _not_there(cause) from error
            raise
        return (made.metadata.uid if made.metadata else None) or ""

    def _listens(self, name: str, seen: Seen, deadline_s: float) -> bool:
        """Waits until the manager of a RayJob listens, since that is not known from its status."""
        while monotonic() < deadline_s:
            with contextlib.suppress(OSError), socket.create_connection((seen.address, PORT), REACH_S):
                return True
            if is_over(self._jobs.get(name)):
                return False
            sleep(LOOK_S)
        return False


def _not_there(error: ApiError) -> LaunchError:
    """Returns what a user reads where the cluster has no RayJobs, or not the namespace."""
    text = error.status.message or ""
    if "namespace" in text:
        return LaunchError(
            f"The cluster has no place for evaluations: {text}.",
            hint="Apply docker/kubernetes-evaluations (docs/how-to/run-on-kubernetes.md).",
        )
    return LaunchError(
        "The cluster knows no RayJobs (ray.io/v1): the KubeRay operator is not installed.",
        hint="Ask who runs this server to install it (docs/how-to/run-on-kubernetes.md), "
        "or to leave out BT_STUDIO_EVALUATIONS=rayjob.",
    )


def _not_started(seen: Seen | None, timeout_s: float) -> LaunchError | HostFullError:
    """Returns why a RayJob did not become ready."""
    if seen is not None and seen.trouble is not None:
        kind = HostFullError if seen.trouble.cause is Cause.NO_ROOM else LaunchError
        return kind(seen.trouble.text)
    if seen is not None and seen.exit_status is not None:
        return LaunchError("The RayJob of the evaluation ended while it started.")
    if seen is not None and seen.is_ready:
        return LaunchError(f"The RayJob runs, but its manager was not reached within {timeout_s:.0f} s.")
    why = f": {seen.lacks}" if seen is not None and seen.lacks else ""
    return LaunchError(f"The Ray cluster of the evaluation was not ready within {timeout_s:.0f} s{why}.")
