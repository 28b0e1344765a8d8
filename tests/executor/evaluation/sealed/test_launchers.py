"""The launchers of these tests give processes what the keeper's plan and the pods' manifests give."""

from __future__ import annotations

from typing import Any

import pytest
import yaml

from backend.sessions.keeper.plan import Plan
from tests.executor.evaluation.sealed.launchers import ROOT, UID


def pods(document: Any) -> list[dict[str, Any]]:
    """Returns the specifications of pods in a document."""
    if isinstance(document, list):
        return [pod for each in document for pod in pods(each)]
    if not isinstance(document, dict):
        return []
    return [document] if "containers" in document else pods([*document.values()])


def test_a_container_has_no_rights_no_network_and_a_uid_of_the_image():
    made = Plan("image", "/nowhere", "stack").container("id", "token", 1, "door")
    host = made["HostConfig"]
    assert made["User"] == f"{UID}:{UID}"
    assert (host["NetworkMode"], host["CapDrop"], host["Privileged"]) == ("none", ["ALL"], False)
    assert (host["IpcMode"], host["ReadonlyRootfs"]) == ("private", True)
    assert "no-new-privileges:true" in host["SecurityOpt"]
    assert [*host["Tmpfs"]] == ["/tmp"]  # noqa: S108 - the container's


@pytest.mark.parametrize(
    ("name", "count"),
    [("kubernetes/executor-pod.yaml", 1), ("kubernetes-evaluations/evaluation-rayjob.yaml", 2)],
)
def test_a_pod_has_no_rights_and_the_same_uid(name, count):
    text = (ROOT / "docker" / name).read_text()
    found = pods([*yaml.safe_load_all(text)])
    assert len(found) == count
    for pod in found:
        own = pod["securityContext"]
        assert (own["runAsNonRoot"], own["runAsUser"], own["runAsGroup"]) == (True, UID, UID)
        assert own["seccompProfile"] == {"type": "RuntimeDefault"}
        for container in pod["containers"]:
            assert container["securityContext"] == {
                "allowPrivilegeEscalation": False,
                "readOnlyRootFilesystem": True,
                "capabilities": {"drop": ["ALL"]},
            }
            mounted = {each["mountPath"] for each in container["volumeMounts"]}
            assert {"/tmp", "/dev/shm"} <= mounted  # noqa: S108 - the pod's
