"""Makes pods and secrets from the templates `*-pod.yaml` in `docker/kubernetes`. Pure.

A template is a whole pod. Of it only names, labels and the names of the secret are replaced, so that what
an administrator has reviewed and bounded is what runs.
"""

from __future__ import annotations

import copy
from enum import StrEnum
from typing import TYPE_CHECKING, Any, Final, NamedTuple

import msgspec
import yaml
from lightkube.resources.core_v1 import Pod

if TYPE_CHECKING:
    from backend.sessions.manager.certificate import Certificate

__all__ = [
    "DIGEST",
    "KIND_LABEL",
    "POD",
    "PORT",
    "Kind",
    "ObjectKind",
    "TemplateError",
    "id_label",
    "lost_field",
    "owner_of",
    "pod_body",
    "pod_name",
    "read_template",
    "renamed",
    "secret_body",
]

PORT: Final = 7163
PATIENCE_S: Final = 3600
"""How long a warm pod waits for its session before it ends by itself; the pool replaces it earlier."""
KIND_LABEL: Final = "bt-studio/kind"
"""The label of all pods that we make."""
DIGEST: Final = "bt-studio/certificate"
"""The annotation with the SHA-256 of a pod's certificate."""
_SECRET: Final = "SESSION"  # noqa: S105 - the name of the secret in the template


class ObjectKind(NamedTuple):
    """A kind of object of Kubernetes."""

    version: str
    name: str


POD: Final = ObjectKind("v1", "Pod")


class Kind(StrEnum):
    """The purpose of a pod: a session, one that will claim it, or the tools of a user."""

    SESSION = "session"
    WARM = "warm"
    TOOLS = "tools"


_ID_LABELS: Final = {
    Kind.SESSION: "bt-studio/session",
    Kind.WARM: "bt-studio/warm",
    Kind.TOOLS: "bt-studio/tools",
}


class TemplateError(ValueError):
    """Raised when a file is no template of the pods of sessions; the text says what is wrong."""


def read_template(text: str) -> dict[str, Any]:
    """Returns the template that a YAML file holds.

    Raises:
        TemplateError: it is no pod with one container that has the secret of its session.
    """
    try:
        found = yaml.safe_load(text)
    except yaml.YAMLError as error:
        raise TemplateError(f"it is not YAML: {error}") from error
    if not isinstance(found, dict) or found.get("kind") != "Pod" or found.get("apiVersion") != "v1":
        raise TemplateError("it does not hold one pod (apiVersion: v1, kind: Pod)")
    containers = (found.get("spec") or {}).get("containers")
    if not isinstance(containers, list) or len(containers) != 1:
        raise TemplateError("its pod does not have one container")
    if renamed(found, "") == found:
        raise TemplateError(
            f"its container does not name the secret {_SECRET}, which holds token and certificate"
        )
    try:
        kept = msgspec.to_builtins(msgspec.convert(found, Pod))
    except msgspec.ValidationError as error:
        raise TemplateError(f"it is no pod: {error}") from error
    if lost := lost_field(found, kept):
        raise TemplateError(f"Kubernetes knows no field {lost}")
    return found


def pod_name(kind: Kind, made_id: str) -> str:
    """Returns the name of a pod, and of its secret."""
    return f"bt-studio-{kind}-{made_id}"


def id_label(kind: Kind) -> str:
    """Returns the label with the id of a session, or of tools."""
    return _ID_LABELS[kind]


def pod_body(template: dict[str, Any], kind: Kind, made_id: str, digest: str) -> dict[str, Any]:
    """Returns a pod; `digest` is the SHA-256 of the certificate that will be in its secret."""
    name = pod_name(kind, made_id)
    body: dict[str, Any] = renamed(copy.deepcopy(template), name)
    metadata = body.setdefault("metadata", {})
    metadata["name"] = name
    metadata["labels"] = {**metadata.get("labels", {}), KIND_LABEL: kind.value, id_label(kind): made_id}
    if kind is Kind.WARM:
        container = body["spec"]["containers"][0]
        container["args"] = [*container.get("args", []), f"--patience={PATIENCE_S}"]
    metadata["annotations"] = {**metadata.get("annotations", {}), DIGEST: digest}
    return body


def secret_body(name: str, token: str, made: Certificate, owner: ObjectKind, uid: str) -> dict[str, Any]:
    """Returns the secret of a pod or RayJob: its token, certificate and key. It goes with its owner.

    Args:
        name: the name of both.
        token: the token.
        made: the certificate with its key.
        owner: the kind of the owner.
        uid: the uid of the owner.
    """
    return {
        "apiVersion": "v1",
        "kind": "Secret",
        "metadata": {"name": name, "ownerReferences": [owner_of(owner, name, uid)]},
        "immutable": True,
        "stringData": {"token": token, "tls.crt": made.certificate, "tls.key": made.key},
    }


def owner_of(kind: ObjectKind, name: str, uid: str) -> dict[str, Any]:
    """Returns the reference to the object with which another one goes."""
    return {"apiVersion": kind.version, "kind": kind.name, "name": name, "uid": uid}


def lost_field(asked: Any, kept: Any, at: str = "") -> str:
    """Returns the place of the first field of a template that its pod does not have; "" if it has all."""
    if isinstance(asked, dict) and isinstance(kept, dict):
        for key, value in asked.items():
            place = f"{at}.{key}".removeprefix(".")
            if key not in kept and value is not None:
                return place
            if lost := lost_field(value, kept.get(key), place):
                return lost
    if isinstance(asked, list) and isinstance(kept, list):
        for number, (part, other) in enumerate(zip(asked, kept, strict=True)):
            if lost := lost_field(part, other, f"{at}[{number}]"):
                return lost
    return ""


def renamed(value: Any, name: str) -> Any:
    """Returns a part of a template with the name of the secret in place of the template's."""
    if isinstance(value, dict):
        return {key: renamed(part, name) for key, part in value.items()}
    if isinstance(value, list):
        return [renamed(part, name) for part in value]
    return name if value == _SECRET else value
