from executor.generate.topics_table import text
from translator.world_topics import TABLE


def test_the_table_is_that_of_the_robots_and_universes() -> None:
    assert TABLE.read_text(encoding="utf-8") == text(), "run `make generate`"
