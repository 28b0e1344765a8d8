"""The files and words that trees and actions name."""

from __future__ import annotations

import json

from backend.workers.offered import uses


def test_trees_name_the_files_of_their_blocks_and_say_whether_they_are_offered():
    nodes = {"a": {"type": "SubTree", "tree": "T"}, "b": {"type": "Park"}, "c": "no block"}
    offered = json.dumps({"nodes": nodes, "attributes": {"_bts_offered": "1"}})
    found = uses({"1": offered, "2": "[]", "3": "{", "4": '{"nodes": []}'}, {})
    assert found == {
        "used": {"1": ["actions/Park.py", "trees/T.json"], "2": [], "3": [], "4": []},
        "offered": ["1"],
    }


def test_actions_name_every_word_of_their_text():
    assert uses({}, {"a": "from Brake import Brake\n"})["used"] == {"a": ["Brake", "from", "import"]}
