from __future__ import annotations

import json

from tree_gardener.testing.cases import Failure, Result


def test_a_result_survives_the_way_through_json():
    failure = Failure(
        "wrong", 3, 2, 0.05, "a/b", "Main", "n2", "RUNNING", "IDLE", (("a", "RUNNING"), ("b", "IDLE"))
    )
    result = Result("t", "f", 2, "Main", (failure,), 2, "RUNNING", 0.1, {"Main": {"n2": ("ticked",)}})
    again = Result.from_json(json.loads(json.dumps(result.to_json())))
    assert again.failures == result.failures
    assert json.dumps(again.to_json()) == json.dumps(result.to_json())
    assert not result.passed
    assert str(failure) == "tick 2 (0.05 s): 'a/b' [Main n2]: wrong"
