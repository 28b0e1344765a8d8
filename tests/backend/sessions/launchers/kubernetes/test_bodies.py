"""Pods and secrets of sessions, made from the template that administrators review."""

from __future__ import annotations

import kubernetes_validate
import pytest
import yaml

from backend.sessions.launchers.kubernetes.bodies import (
    DIGEST,
    KIND_LABEL,
    POD,
    PORT,
    Kind,
    TemplateError,
    id_label,
    pod_body,
    read_template,
    secret_body,
)
from backend.sessions.manager.certificate import make_certificate
from tests.backend.sessions.launchers.kubernetes.conftest import TEMPLATE
from tests.fakes.kubernetes_api import VERSION

TEXT = TEMPLATE.read_text()


def test_a_pod_is_the_template_with_names_of_its_own() -> None:
    template = read_template(TEXT)
    pod = pod_body(template, Kind.SESSION, "3f2a", "d1")
    kubernetes_validate.validate(pod, VERSION, strict=True)
    name = "bt-studio-session-3f2a"
    assert pod["metadata"]["name"] == name
    assert pod["metadata"]["labels"] == {
        "app": "bt-studio-session",
        KIND_LABEL: "session",
        id_label(Kind.SESSION): "3f2a",
    }
    assert pod["metadata"]["annotations"] == {DIGEST: "d1"}
    assert pod["spec"]["volumes"][0]["secret"]["secretName"] == name
    assert template == read_template(TEXT), "the template itself stays as it is"
    assert yaml.safe_dump(pod["spec"]).replace(name, "SESSION") == yaml.safe_dump(template["spec"])
    assert f"--port={PORT}" in pod["spec"]["containers"][0]["args"]


def test_a_secret_goes_with_its_pod_and_never_changes() -> None:
    made = make_certificate("s1")
    secret = secret_body("bt-studio-session-s1", "t0ken", made, POD, "the uid")
    kubernetes_validate.validate(secret, VERSION, strict=True)
    assert secret["immutable"] is True
    assert secret["metadata"]["ownerReferences"][0]["uid"] == "the uid"
    assert secret["stringData"] == {"token": "t0ken", "tls.crt": made.certificate, "tls.key": made.key}


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("a: [", "not YAML"),
        ("", "one pod"),
        ("- 1", "one pod"),
        (TEXT.replace("kind: Pod", "kind: Deployment"), "one pod"),
        (TEXT + "\n---\n" + TEXT, "not YAML"),
        (TEXT.replace("SESSION", "other"), "does not name the secret"),
        (TEXT.replace("restartPolicy: Never", "restartPolicy: [Never]"), "no pod"),
        (TEXT.replace("enableServiceLinks", "enableServicelinks"), "no field spec.enableServicelinks"),
        (TEXT.replace("readOnlyRootFilesystem", "readOnlyRoot"),
         r"no field spec.containers\[0\].securityContext.readOnlyRoot"),
        ("apiVersion: v1\nkind: Pod\nspec: {containers: []}", "one container"),
        ("apiVersion: v1\nkind: Pod\nspec:", "one container"),
    ],
)  # fmt: skip
def test_a_file_that_is_no_template_is_refused_with_the_place(text: str, reason: str) -> None:
    with pytest.raises(TemplateError, match=reason):
        read_template(text)
