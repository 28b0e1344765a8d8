"""The page of the evaluation format."""

from typing import get_args

from executor.evaluation.document import FAULT_FIELDS, Criterion, Draw, Evaluation, Fault, Measure
from executor.evaluation.reference import page as reference


def test_the_committed_page_is_what_the_schema_says():
    assert reference.PAGE.read_text(encoding="utf-8") == reference.page()


def test_every_key_has_a_meaning_and_every_kind_of_fault_its_fields():
    page = reference.page()
    for model in (Evaluation, Draw, Criterion, Fault):
        for name, field in model.model_fields.items():
            assert field.description, f"{model.__name__}.{name}"
            assert f"| `{name}` | " in page
    for kind in FAULT_FIELDS:
        assert f"| `{kind}` | `" in page
    for measure in get_args(Measure):
        assert f"`{measure}`" in page


def test_bounds_and_defaults_are_written():
    page = reference.page()
    assert "| `runs` | whole number ≥ 1, ≤ 100,000 | How many runs." in page
    assert (
        "| `duration_s` | number > 0, ≤ 36,000 | The longest time of a run, in simulated s. (required) |"
        in page
    )
    assert (
        "`to` | text | `anything`, `models`, `actors`, `robots`, or the id of one. (anything without it)"
        in page
    )
