"""The page of the evaluation format."""

from executor.evaluation import reference_page
from executor.evaluation.document import FAULT_FIELDS, MEASURES, Criterion, Draw, Evaluation, Fault


def test_the_committed_page_is_what_the_schema_says():
    assert reference_page.PAGE.read_text(encoding="utf-8") == reference_page.page()


def test_every_key_has_a_meaning_and_every_kind_of_fault_its_fields():
    page = reference_page.page()
    for model in (Evaluation, Draw, Criterion, Fault):
        for name, field in model.model_fields.items():
            assert field.description, f"{model.__name__}.{name}"
            assert f"| `{name}` | " in page
    for kind in FAULT_FIELDS:
        assert f"| `{kind}` | `" in page
    for measure in MEASURES:
        assert f"`{measure}`" in page


def test_bounds_and_defaults_are_written():
    page = reference_page.page()
    assert "| `runs` | whole number ≥ 1, ≤ 100,000 | How many runs." in page
    assert (
        "| `duration_s` | number > 0, ≤ 36,000 | The longest time of a run, in simulated s. (required) |"
        in page
    )
    assert (
        "`to` | text | `anything`, `models`, `actors`, `robots`, or the id of one. (anything without it)"
        in page
    )
