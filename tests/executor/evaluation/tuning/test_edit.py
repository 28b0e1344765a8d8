"""The best values as an edit."""

import dataclasses

from executor.evaluation.tuning.edit import edited_trees
from executor.evaluation.tuning.space import Port
from tests.executor.evaluation.projects import project
from translator import open_files

TEXT = "duration_s: 1\nruns: 2\njudge: {success: [{never: collision}]}\n"


def test_only_the_tree_of_the_port_changes():
    before = project(TEXT)
    files = edited_trees(before, {Port("MainTree.go.speed", "MainTree", "a", "speed", 0, 1): 0.25})
    assert files.keys() == {"trees/MainTree.json"}
    after = open_files({**before.files, **files})
    assert after.trees["MainTree"].nodes["a"].ports == {"speed": "0.25"}
    assert before.trees["MainTree"].nodes["a"].ports == {}


def test_no_name_of_a_tree_leads_out_of_the_project():
    before = project(TEXT)
    tree = dataclasses.replace(before.trees["MainTree"], id="../../away")
    before = dataclasses.replace(before, trees={"../../away": tree})
    [path] = edited_trees(before, {Port("away.go.speed", "../../away", "a", "speed", 0, 1): 0.25})
    assert path.count("/") == 1
    assert ".." not in path
