from executor import messages
from executor.generate import typescript


def test_the_generated_module_is_current():
    assert typescript.TARGET.read_text() == typescript.generate()


def test_every_message_has_its_interface():
    text = typescript.generate()
    for table in (messages.COMMANDS, messages.EVENTS):
        for name, struct in table.items():
            assert f"export interface {struct.__name__} " in text or f"export type {struct.__name__} " in text
            assert name in text


def test_defaults_are_optional_only_where_they_may_be_absent():
    text = typescript.generate()
    assert "  max_hz?: number;" in text  # a command: the client may omit it
    assert "  hint: string;" in text  # an event: the server always sends it
    assert "  mesh?: string;" in text  # omit_defaults


def test_generation_is_deterministic():
    assert typescript.generate() == typescript.generate()
