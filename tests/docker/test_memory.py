"""The limits of containers and pods hold what the parts of each may take; the files of `docker/` are read."""

from __future__ import annotations

import re

import pytest
import yaml

from backend.config.environment import Environment
from backend.core.processes.memory import FILES_MIB, fitting
from backend.sessions.keeper.plan import TOOLS_LIMITS, TOOLS_PREFIX, Limits, Plan
from tests.docker.engine import REPOSITORY

DOCKER = REPOSITORY / "docker"
UNITS = {"m": 1, "g": 1024, "Mi": 1, "Gi": 1024}
CORES = (1, 2, 4, 8, 64)
MANAGER_MIB = 256
"""Manager, recorder and world of a session, beside the program of its user."""
TOOLS_MIB = 256
"""The program of a user's tools, and ruff."""
RAY_MIB = 512
"""Ray's own processes in a pod, and the manager on its head."""


def mib(text):
    """A quantity of Kubernetes or Docker in MiB."""
    number, unit = re.fullmatch(r"(\d+)([A-Za-z]+)", text).groups()
    return int(number) * UNITS[unit]


def pod(path, *keys):
    """The specification of a pod in the first document of a file that has one."""
    for document in yaml.safe_load_all((DOCKER / path).read_text()):
        found = document.get("spec") or {}
        for key in keys:
            found = found.get(key) or {}
        if "containers" in found:
            return found
    raise AssertionError(f"{path} has no pod")


def limit(found):
    """The memory of the only container of a pod."""
    (container,) = found["containers"]
    return mib(container["resources"]["limits"]["memory"])


def environment(found):
    (container,) = found["containers"]
    return {row["name"]: row["value"] for row in container.get("env", ()) if "value" in row}


def files_in_memory(found):
    """The size of a pod's volumes that are memory, which counts."""
    volumes = [volume.get("emptyDir") or {} for volume in found["volumes"]]
    return sum(mib(one["sizeLimit"]) for one in volumes if one.get("medium") == "Memory")


def service(path, name):
    """A service of a compose file with the defaults of its variables."""
    text = re.sub(r"\$\{\w+:-([^}]*)\}", r"\1", (DOCKER / path).read_text())
    found = yaml.safe_load(text)["services"][name]
    found["environment"] = {key: str(value) for key, value in found["environment"].items()}
    return found


def setting(variables, name):
    text = variables.get(f"BT_STUDIO_{name.upper()}", "")
    return int(text) if text else Environment.model_fields[name].default


def needed(mode, variables, cores, memory):
    """The memory of the processes of a web server that is started with these variables."""
    processes = fitting(
        mode,
        cores,
        memory,
        workers=1 if mode == "local" else setting(variables, "workers"),
        large=setting(variables, "work_processes"),
        each_mib=setting(variables, "work_memory_mib"),
        unread_bytes=setting(variables, "max_unread_bytes"),
    )
    return processes.needed_mib()


@pytest.mark.parametrize("cores", CORES)
def test_the_pod_of_a_web_server_holds_its_processes(cores):
    found = pod("kubernetes/web.yaml", "template", "spec")
    memory = limit(found)
    assert needed("team", environment(found), cores, memory) <= memory
    assert files_in_memory(found) <= FILES_MIB
    (container,) = found["containers"]
    assert mib(container["resources"]["requests"]["memory"]) <= memory


@pytest.mark.parametrize("cores", CORES)
@pytest.mark.parametrize(("path", "mode"), [("compose.yaml", "team"), ("compose.local.yaml", "local")])
def test_the_container_of_a_web_server_holds_its_processes(path, mode, cores):
    found = service(path, "web")
    memory = mib(found["mem_limit"])
    (tmp,) = (mib(re.search(r"size=(\w+)", mount)[1]) for mount in found["tmpfs"])
    assert needed(mode, found["environment"], cores, memory) <= memory
    assert tmp <= FILES_MIB


def test_the_pod_of_a_robot_holds_its_program_and_files_and_has_the_limits_of_a_container():
    found = pod("kubernetes/executor-pod.yaml")
    own = environment(found)
    program = int(own["BT_STUDIO_APPLICATION_MEMORY_MB"])
    assert program + files_in_memory(found) + MANAGER_MIB <= limit(found)
    made = Plan("image", "doors", "stack").container("s", "t", 1, "d")
    as_container = dict(row.split("=", 1) for row in made["Env"] if not row.startswith("BT_STUDIO_MANAGER"))
    assert {name: own.get(name) for name in as_container} == as_container


@pytest.mark.parametrize("path", ["compose.yaml", "compose.local.yaml"])
def test_the_container_of_a_robot_holds_its_program_and_files(path):
    variables = service(path, "keeper")["environment"]
    limits = Limits().overridden(variables)
    made = Plan("image", "doors", "stack", limits=limits).container("s", "t", 1, "d")
    program = int(dict(row.split("=", 1) for row in made["Env"])["BT_STUDIO_APPLICATION_MEMORY_MB"])
    assert program + limits.disk_mb + limits.shm_mb + MANAGER_MIB <= limits.memory_mb


def editors_mib(variables):
    """The language servers of one user."""
    return setting(variables, "max_user_language_servers") * setting(variables, "language_memory_mib")


def test_the_pod_of_a_users_tools_holds_their_language_servers():
    found = pod("kubernetes/tools-pod.yaml")
    web = environment(pod("kubernetes/web.yaml", "template", "spec"))
    assert editors_mib(web) + files_in_memory(found) + TOOLS_MIB <= limit(found)


def test_the_container_of_a_users_tools_holds_their_language_servers():
    limits = TOOLS_LIMITS.overridden(service("compose.yaml", "keeper")["environment"], TOOLS_PREFIX)
    web = service("compose.yaml", "web")["environment"]
    assert editors_mib(web) + limits.disk_mb + limits.shm_mb + TOOLS_MIB <= limits.memory_mb


@pytest.mark.parametrize("group", ["headGroupSpec", "workerGroupSpecs"])
def test_the_pods_of_an_evaluation_hold_the_runs_that_are_under_way(group):
    (document, _) = yaml.safe_load_all((DOCKER / "kubernetes-evaluations/evaluation-rayjob.yaml").read_text())
    found = document["spec"]["rayClusterSpec"][group]
    found = found[0] if isinstance(found, list) else found
    pods = found["template"]["spec"]
    # The head records one run that somebody plays again; its store of objects is in /dev/shm.
    runs = max(1, int(found["rayStartParams"]["num-cpus"]))
    each = int(environment(pods)["BT_STUDIO_EVALUATION_MEMORY_MB"])
    store = int(found["rayStartParams"]["object-store-memory"]) >> 20
    assert store <= mib(next(v["emptyDir"]["sizeLimit"] for v in pods["volumes"] if v["name"] == "shm"))
    assert runs * each + files_in_memory(pods) + RAY_MIB <= limit(pods)
