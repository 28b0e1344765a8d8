"""No false alarm: trees that are known to be good have no finding, other than those listed with a reason."""

from __future__ import annotations

import itertools
import json
from pathlib import Path

import pytest

from tests.budget import count
from tests.translator.check.results.engine import corpus, corpus_project, places_of, play
from translator import from_xml, load
from translator.check import check
from translator.check.context import Context
from translator.check.effect import check_effects
from translator.diagnostic import Severity, TranslatorError

ROOT = Path(__file__).parents[3]
EXAMPLES = sorted(path for path in (ROOT / "examples").iterdir() if path.is_dir())
BEHAVIOURS = ROOT / "backend/catalog/behaviours"

LISTED = {
    (
        "search_color",
        "BT0402",
    ): "the action that looks for a colour says where it is; this tree needs no more",
    ("SearchColor", "BT0402"): "the same tree in the library",
}
"""By example or behaviour and code: why the finding is there and does no harm."""


def files_of(folder: Path) -> dict[str, bytes]:
    return {
        path.relative_to(folder).as_posix(): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file() and "__pycache__" not in path.parts
    }


def unlisted(name, project):
    return [str(item) for item in check(project) if (name, item.code) not in LISTED]


@pytest.mark.parametrize("folder", EXAMPLES, ids=lambda path: path.name)
def test_examples(folder):
    assert unlisted(folder.name, load(files_of(folder))) == []


def test_behaviours_of_the_library():
    files = files_of(BEHAVIOURS)
    names = [Path(path).stem for path in files if path.startswith("trees/")]
    assert len(names) > 10
    assert [item for name in names for item in behaviour_findings(files, name)] == []


def behaviour_findings(files, name):
    """The findings in a behaviour that a tree calls, with an entry for each of its ports."""
    tree = json.loads(files[f"trees/{name}.json"])
    call = {"type": "SubTree", "tree": name, "ports": {row["name"]: "{=}" for row in tree.get("ports", ())}}
    main = {"format": "bt-studio/diagram", "version": 1, "id": "MainTree", "root": "n", "nodes": {"n": call}}
    settings = {"format": "bt-studio/project", "version": 1, "name": name}
    more = {"project.json": settings, "trees/MainTree.json": main}
    project = load({**files, **{path: json.dumps(text).encode() for path, text in more.items()}})
    return [item for item in unlisted(name, project) if item.startswith(f"trees/{name}.json")]


NAV2 = """<root BTCPP_format="4"><BehaviorTree ID="A">
<RecoveryNode number_of_retries="6">
  <PipelineSequence>
    <RateController hz="1.0"><RecoveryNode number_of_retries="1">
      <ComputePathToPose goal="{goal}" path="{path}"/>
      <ClearEntireCostmap service_name="global_costmap/clear"/>
    </RecoveryNode></RateController>
    <RecoveryNode number_of_retries="1">
      <FollowPath path="{path}"/><ClearEntireCostmap service_name="local_costmap/clear"/>
    </RecoveryNode>
  </PipelineSequence>
  <ReactiveFallback>
    <GoalUpdated/>
    <RoundRobin><Spin/><Wait/><BackUp/></RoundRobin>
  </ReactiveFallback>
</RecoveryNode></BehaviorTree></root>"""


def test_a_tree_of_nav2():
    """The goal comes from the navigator: nothing in the tree writes it, as its warning says."""
    assert {item.code for item in check(from_xml(NAV2))} == {"BT0401", SAYS_WHICH}


SAYS_WHICH = "BT0749"
"""The note that says for which ROS distribution an imported tree is."""
NAVIGATOR = {
    SAYS_WHICH: "it is no alarm",
    "BT0401": "the navigator or the application writes the goal; an unset plugin is the only one there is",
    "BT0402": "the navigator reads the errors; other outputs are for trees that are made from this one",
}
TREES_OF_NAV2 = {
    ("application_example", "BT0112"): "the node is called Inverter: Nav2 cannot load this tree either",
    ("nav_to_pose_with_consistent_replanning_and_if_path_becomes_invalid", "BT0405"): "true: at the first "
    "tick there is no path, TruncatePathLocal fails, and a path is computed",
    ("navigate_to_pose_w_bounds_check", "BT0405"): "true: at the first tick there is no feedback yet",
    ("navigate_to_pose_w_replanning_goal_patience_and_recovery", "BT0121"): "true, and meant: waiting "
    "cancels what follows the path",
    ("navigate_to_pose_w_replanning_goal_patience_and_recovery", "BT0123"): "true: one attempt is none more",
    ("navigate_w_routing_global_planning_and_control_w_recovery", "BT0108"): "true: two nodes have one name",
}
"""By tree and code: why a finding in one of Nav2's own trees is no false alarm."""


def test_the_trees_of_nav2():
    files = sorted((ROOT / "tests/translator/fixtures/nav2").glob("*.xml"))
    found = {(file.stem, item.code) for file in files for item in check(from_xml(file.read_text()))}
    assert len(files) == 16
    assert {each for each in found if each[1] not in NAVIGATOR} == set(TREES_OF_NAV2)


def test_decorators_that_change_nothing_change_nothing_in_the_corpus():
    found = 0
    for case in corpus(every=max(1, 6000 // count("checker_soundness"))):
        try:
            project, types = corpus_project(case)
        except TranslatorError:
            continue
        context = Context(project)
        check_effects(context)
        idle = {(item.place.tree, item.place.node) for item in context.found if item.code != "BT0124"}
        if not idle or case.get("extra_xml"):
            continue
        log, tree = play(case, types)
        if tree is None:
            continue
        places = places_of(project, tree)
        for (below, result), (uid, own) in itertools.pairwise(log):
            node = tree.nodes[uid - 1]
            if places[uid] in idle and node.children and node.children[0].uid == below:
                found += 1
                assert own is result, (case["name"], places[uid])
    assert found


def test_new_findings_are_warnings():
    assert all(item.severity is not Severity.ERROR for item in check(from_xml(NAV2)))
