"""Rights and limits of a container."""

from __future__ import annotations

import pytest

from backend.sessions.keeper.plan import Limits, Plan, read_plan
from tests.backend.sessions.keeper.test_service import DOOR, TOKEN


def test_a_container_gets_no_more_processors_than_there_are(monkeypatch):
    monkeypatch.setattr("os.cpu_count", lambda: 2)
    for wanted, given in ((1.5, 1_500_000_000), (4, 2_000_000_000)):
        plan = Plan("executor:1", "gate", "stack", limits=Limits(cpus=wanted))
        assert plan.container("id", TOKEN, 7, DOOR)["HostConfig"]["NanoCpus"] == given


def test_a_container_may_do_little(monkeypatch):
    monkeypatch.setattr("os.cpu_count", lambda: 2)
    plan = Plan("executor:1", "gate", "stack", limits=Limits(cpus=1.5, memory_mb=1024, pids=100, disk_mb=64))
    config = plan.container("id", TOKEN, 7, DOOR)
    host = config["HostConfig"]
    assert config["User"] == "10001:10001"
    assert (host["NetworkMode"], host["IpcMode"]) == ("none", "private")
    assert host["ReadonlyRootfs"]
    assert not host["Privileged"]
    assert host["CapDrop"] == ["ALL"]
    no_new, seccomp = host["SecurityOpt"]
    assert (no_new, seccomp.partition("=")[0]) == ("no-new-privileges:true", "seccomp")
    assert host["Memory"] == host["MemorySwap"] == 1024 << 20
    assert (host["NanoCpus"], host["PidsLimit"]) == (1_500_000_000, 100)
    assert ["size=64m" in options for options in host["Tmpfs"].values()] == [True]
    mount = {"Type": "volume", "Source": "gate", "Target": "/run/bt-studio", "ReadOnly": True}
    assert host["Mounts"] == [mount]
    assert not {"Binds", "Devices", "CapAdd", "PortBindings", "PidMode", "VolumesFrom"} & set(host)
    assert TOKEN not in " ".join(config["Cmd"])
    assert f"/run/bt-studio/{DOOR}" in config["Cmd"]


def test_a_tree_may_be_held_as_long_as_the_environment_says():
    for given, minutes in (({}, "15"), ({"BT_STUDIO_HOLD_MINUTES": "0"}, "0")):
        plan = read_plan(given, gate_source="/gate", stack="s")
        assert f"BT_STUDIO_HOLD_MINUTES={minutes}" in plan.container("id", TOKEN, 1, DOOR)["Env"]
    for wrong in ("long", "-1", "nan"):
        with pytest.raises(ValueError, match="BT_STUDIO_HOLD_MINUTES"):
            read_plan({"BT_STUDIO_HOLD_MINUTES": wrong}, gate_source="/gate", stack="s")


def test_limits_come_from_the_environment_and_wrong_ones_are_refused_by_name():
    plan = read_plan({"BT_STUDIO_SESSION_PIDS": "33"}, gate_source="/gate", stack="s")
    assert plan.limits.pids == 33
    assert plan.container("id", TOKEN, 1, DOOR)["HostConfig"]["Mounts"][0]["Type"] == "bind"
    for wrong in ("many", "0", "-1", "nan", "inf"):
        with pytest.raises(ValueError, match="BT_STUDIO_SESSION_PIDS"):
            read_plan({"BT_STUDIO_SESSION_PIDS": wrong}, gate_source="gate", stack="s")
