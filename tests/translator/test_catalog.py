"""The built-in nodes as the translator knows them."""

from __future__ import annotations

from translator.catalog import PortModel, builtins, did_you_mean, nearest


def test_the_built_in_nodes_have_their_ports_and_counts_of_children() -> None:
    repeat = builtins()["Repeat"]
    assert (repeat.kind, repeat.min_children, repeat.max_children) == ("decorator", 1, 1)
    assert repeat.ports["num_cycles"].type == "int"
    by_the_interface = ["RosAction", "RosService", "RosPublish", "RosSubscribe"]
    assert [name for name, model in builtins().items() if model.open] == ["TestNode", *by_the_interface]


def test_a_port_is_read_written_or_both() -> None:
    ways = {way: PortModel("p", direction=way) for way in ("input", "output", "inout")}
    assert [(port.is_read, port.is_written) for port in ways.values()] == [
        (True, False),
        (False, True),
        (True, True),
    ]


def test_the_nearest_name_is_offered() -> None:
    assert nearest("Sequenc", builtins()) == "Sequence"
    assert did_you_mean("Sequenc", builtins()) == "Did you mean Sequence?"
    assert did_you_mean("Xyzzyx", builtins(), otherwise="Write it.") == "Write it."


def test_a_string_that_has_only_some_values_is_a_choice() -> None:
    assert builtins()["RosSubscribe"].ports["mode"].type == "mode[latest;new;wait]"
