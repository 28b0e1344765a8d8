"""JUnit's XML of an evaluation."""

from xml.etree import ElementTree as ET

from backend.cli.evaluating.junit import junit_xml
from executor.evaluation.gates import check_gate, read_gate
from executor.evaluation.outcome import Outcome
from executor.evaluation.summary import Summary


def test_each_seed_and_each_gate_is_a_case():
    names = ("success", "failure", "crashed", "lost")
    summary = Summary(tuple(Outcome(seed, name, "why \x00") for seed, name in enumerate(names)), 4)
    written = junit_xml("room", summary, [check_gate(read_gate("rate(success)>=0.1"), summary)])
    suite = ET.fromstring(written)[0]  # noqa: S314 - our own
    assert {key: suite.get(key) for key in ("tests", "failures", "errors", "skipped")} == {
        "tests": "5",
        "failures": "2",
        "errors": "1",
        "skipped": "1",
    }
    kinds = [[child.tag for child in case] for case in suite]
    assert kinds == [[], ["failure"], ["error"], ["skipped"], ["failure"]]
    assert suite[1][0].get("message") == "why \ufffd"
