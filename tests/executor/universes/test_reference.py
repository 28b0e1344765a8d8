import json

import pytest
import yaml

from executor.universes import BUILTIN_IDS, builtin_path
from executor.universes.reference import FOLDER, FOR_THE_EDITOR, schemas


@pytest.mark.parametrize("name", schemas())
def test_the_published_schema_is_that_of_the_model(name: str) -> None:
    assert (FOLDER / name).read_text(encoding="utf-8") == schemas()[name], (
        "run: python -m executor.universes.reference"
    )


def test_the_editor_checks_with_the_same_schema() -> None:
    assert FOR_THE_EDITOR.read_text(encoding="utf-8") == schemas()["universe.schema.json"]


def test_the_schema_knows_every_key_of_the_builtins() -> None:
    known = json.loads(schemas()["universe.schema.json"])["properties"]
    for universe_id in BUILTIN_IDS:
        assert set(yaml.safe_load(builtin_path(universe_id).read_text(encoding="utf-8"))) <= set(known)
