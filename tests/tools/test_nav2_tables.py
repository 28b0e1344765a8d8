"""The tool that makes the tables of Nav2's nodes, with a clone that has Nav2's branches."""

from __future__ import annotations

import json
import subprocess
from typing import TYPE_CHECKING

import pytest

from tests.tools.nav2_tables import (
    MODEL,
    UNLISTED,
    filled,
    main,
    table_of,
    table_text,
    tables_in,
)
from translator.nav2.distributions import DISTRIBUTIONS

if TYPE_CHECKING:
    from pathlib import Path

NODES = """<root BTCPP_format="4"><TreeNodesModel>
  <Action ID="Cut">
    <input_port name="far" type="double" default="numeric_limits&lt;double&gt;::infinity()">How
      far.</input_port>
    <output_port name="path" type="nav_msgs::msg::Path"/>
  </Action>
  <Condition ID="Low"><input_port name="topic" type="string" default="&quot;/b&quot;">Topic.</input_port></Condition>
  <Control ID="Both"/>{more}
</TreeNodesModel></root>"""  # noqa: E501
UNTYPED = """<Condition ID="IsPathValid"><input_port name="path"/>
<input_port name="max_cost">Cost.</input_port></Condition>"""
TYPED = """<Action ID="ValidatePath"><input_port name="path" type="nav_msgs::msg::Path">The path.</input_port>
<input_port name="max_cost" type="unsigned int" default="254"/></Action>"""


def of_nodes(more: str = "") -> str:
    return NODES.replace("{more}", more + "".join(f'<Action ID="{type_}"/>' for _, type_ in UNLISTED))


def git(folder: Path, *arguments: str) -> None:
    name = ("-c", "user.name=A", "-c", "user.email=a@example.org")
    subprocess.run(["git", "-C", str(folder), *name, *arguments], check=True, capture_output=True)


@pytest.fixture
def clone(tmp_path: Path) -> Path:
    git(tmp_path, "init", "-q", "-b", "main")
    file = tmp_path / MODEL
    file.parent.mkdir()
    for name in DISTRIBUTIONS:
        file.write_text(of_nodes(TYPED if name == "lyrical" else UNTYPED))
        git(tmp_path, "checkout", "-q", "-B", name)
        git(tmp_path, "add", "-A")
        git(tmp_path, "commit", "-q", "--allow-empty", "-m", name)
    return tmp_path


def test_kind_ports_and_defaults_are_kept_and_the_text_is_the_table() -> None:
    table = table_of(NODES.replace("{more}", ""), "lyrical", "f" * 40)
    cut, low, both = table["nodes"]
    assert cut["ports"][0] == {
        "name": "far", "direction": "input", "type": "double", "default": "inf", "description": "How far.",
    }  # fmt: skip
    assert cut["ports"][1] == {
        "name": "path", "direction": "output", "type": "nav_msgs::msg::Path", "description": "",
    }  # fmt: skip
    assert (low["kind"], low["ports"][0]["default"]) == ("condition", "/b")
    assert both == {"type": "Both", "kind": "control", "ports": []}
    assert json.loads(table_text(table)) == table


def test_types_and_defaults_that_a_branch_leaves_out_come_from_the_newest(clone: Path) -> None:
    tables = {name: json.loads(text) for name, text in tables_in(clone).items()}
    assert tuple(tables) == DISTRIBUTIONS
    path, cost = next(n for n in tables["humble"]["nodes"] if n["type"] == "IsPathValid")["ports"]
    assert path == {
        "name": "path", "direction": "input", "type": "nav_msgs::msg::Path", "description": "The path.",
    }  # fmt: skip
    assert (cost["default"], cost["description"]) == ("254", "Cost.")
    kilted = next(n for n in tables["kilted"]["nodes"] if n["type"] == "IsPathValid")["ports"][1]
    assert kilted["default"] == "253"  # as the node's header says


def test_a_clone_of_other_branches_or_a_node_twice_is_one_sentence(clone: Path, capsys) -> None:
    assert main(["--check", str(clone)]) == 1
    assert capsys.readouterr().out == "other than the clone's: humble, jazzy, kilted, lyrical\n"
    git(clone, "branch", "-D", "humble")
    assert main([str(clone)]) == 2
    assert capsys.readouterr().err == (
        f"{clone} has no {MODEL} in the branch humble: clone Nav2 with all its branches\n"
    )
    twice = table_of(of_nodes('<Action ID="Cut"/>'))
    with pytest.raises(ValueError, match="lyrical: Cut is there twice"):
        filled({**dict.fromkeys(DISTRIBUTIONS, table_of(of_nodes())), "lyrical": twice})
