"""Workers take the longest file that suits them; a browser's files stay with one worker."""

from __future__ import annotations

import pytest

from tests.tools.selection.schedule import Files, Kind, Queue
from tests.tools.selection.table import Duration, Table, file_of

BROWSER = ["tests/e2e/test_a.py", "tests/e2e/test_b.py"]
WORKING = ["tests/test_long.py", "tests/test_short.py", "tests/test_new.py"]
WAITING = ["tests/test_wait.py"]
TABLE = Table(
    tests={
        "tests/test_wait.py::test_0": Duration((1.5,), 40.0),
        "tests/test_long.py::test_0": Duration((9.0,), 11.0),
    },
    files={"tests/test_wait.py": 1.6, "tests/test_long.py": 9.1, "tests/test_short.py": 0.1, BROWSER[1]: 5.0},
)


class Node:
    """A worker, as the scheduler sees it."""

    def __init__(self, name: str) -> None:
        self.gateway = type("Gateway", (), {"id": name})
        self.shutting_down = False
        self.sent: list[int] = []

    def send_runtest_some(self, indices: list[int]) -> None:
        self.sent += indices

    def shutdown(self) -> None:
        self.shutting_down = True


def run(pytestconfig: pytest.Config, files: list[str], workers: int = 3) -> list[list[str]]:
    """Returns the files in the order in which each worker runs them, if all tests take the same time."""
    tests = [f"{file}::test_{number}" for file in files for number in range(4)]
    pytestconfig.option.tx = ["popen"] * workers
    queue = Queue(pytestconfig, None, Files.of(TABLE), file_of)
    nodes = [Node(f"gw{number}") for number in range(workers)]
    for node in nodes:
        queue.add_node(node)
        queue.add_node_collection(node, tests)
    queue.schedule()
    done = [0] * workers
    while not queue.tests_finished or any(done[at] < len(node.sent) for at, node in enumerate(nodes)):
        before = list(done)
        for at, node in enumerate(nodes):
            is_last = done[at] == len(node.sent) - 1
            if done[at] < len(node.sent) and (not is_last or node.shutting_down):
                queue.mark_test_complete(node, node.sent[done[at]])
                done[at] += 1
        assert done != before, "no worker continues"
    assert sorted(test for node in nodes for test in node.sent) == list(range(len(tests)))
    return [list(dict.fromkeys(file_of(tests[index]) for index in node.sent)) for node in nodes]


@pytest.fixture(autouse=True)
def _options(pytestconfig, monkeypatch):
    monkeypatch.setattr(pytestconfig.option, "tx", [], raising=False)
    monkeypatch.setattr(pytestconfig.option, "loadscopereorder", False, raising=False)


def test_files_are_known_by_what_they_ask():
    files = Files.of(TABLE)
    assert files.kind(BROWSER[0]) is Kind.BROWSER
    assert files.kind(WAITING[0]) is Kind.WAITING
    assert {files.kind(file) for file in WORKING} == {Kind.WORKING}


def test_each_worker_has_its_kinds_and_the_longest_file_first(pytestconfig):
    browser, waiting, working = run(pytestconfig, sorted([*BROWSER, *WORKING, *WAITING]))
    assert browser == [BROWSER[1], BROWSER[0]]
    assert waiting[0] == WAITING[0]
    assert working[0] == "tests/test_long.py"
    assert sorted([*waiting, *working]) == sorted([*WORKING, *WAITING])


@pytest.mark.parametrize("files", [BROWSER[:1], WORKING[:1], WAITING, [BROWSER[0], WORKING[0]]])
def test_few_files_run_though_not_all_workers_start(pytestconfig, files):
    ran = run(pytestconfig, sorted(files))
    assert sorted(file for worker in ran for file in worker) == sorted(files)


def test_a_browser_file_comes_last_where_its_worker_does_other_work(pytestconfig):
    assert run(pytestconfig, sorted([BROWSER[0], WORKING[0]]), workers=1) == [[WORKING[0], BROWSER[0]]]


def test_a_worker_in_the_place_of_a_crashed_one_takes_its_kind(pytestconfig):
    pytestconfig.option.tx = ["popen"]
    queue = Queue(pytestconfig, None, Files.of(TABLE), file_of)
    first, second = Node("gw0"), Node("gw1")
    tests = [f"{file}::test_{number}" for file in BROWSER for number in range(4)]
    queue.add_node(first)
    queue.add_node_collection(first, tests)
    queue.schedule()
    crashed = queue.remove_node(first)
    assert crashed == tests[first.sent[0]]
    queue.add_node(second)
    queue.add_node_collection(second, tests)
    queue.schedule()
    assert second.sent
