"""A small tree, and short ways to test it."""

from __future__ import annotations

from tree_gardener.testing import LeafModel, Suite, read_tests

MODELS = {
    "Near": LeafModel("Condition", returns=frozenset(("SUCCESS", "FAILURE"))),
    "Turn": LeafModel(
        "Action", (("output", "angle", "double", None), ("input", "speed", "double", "0.5")), open=False
    ),
    "Drive": LeafModel("Action", returns=frozenset(("RUNNING",))),
    "Note": LeafModel("SyncAction"),
    "Mine": LeafModel("control", children=(1, None)),
}
BODY = """
<ReactiveSequence name="main" _bts_id="n1">
  <ReactiveFallback name="keep clear" _bts_id="n2">
    <Inverter _bts_id="n3"><Near _bts_id="n4"/></Inverter>
    <Turn angle="{angle}" _bts_id="n5"/>
  </ReactiveFallback>
  <Drive _bts_id="n6"/>
</ReactiveSequence>"""


def document(body: str = BODY, more: str = "") -> str:
    return (
        f'<root BTCPP_format="4" main_tree_to_execute="Main"><BehaviorTree ID="Main">{body}</BehaviorTree>'
        f"{more}</root>"
    )


def suite(body: str = BODY, more: str = "", **options) -> Suite:
    return Suite(document(body, more), MODELS, **options)


def read(test: dict, of: Suite | None = None):
    """Returns the cases and the problems of one test, whose usual parts are filled in."""
    usual = {"name": "t", "ticks": 10, "expect": [{"at": 1, "root": "RUNNING"}]}
    content = {"format": "bt-studio/test", "version": 1, "tests": [{**usual, **test}]}
    return read_tests(content, "tests/t.test.yaml", suite=of)


def run(test: dict, of: Suite | None = None):
    of = of or suite()
    cases, problems = read(test, of)
    assert problems == []
    return of.run(cases[0])


def sentences(test: dict, of: Suite | None = None) -> list[str]:
    return [str(failure) for failure in run(test, of).failures]
