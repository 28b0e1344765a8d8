"""Ports of actions: how they are declared, read and written.

```python
class Forward(py_trees.behaviour.Behaviour):
    INPUT_PORTS = {"speed": Port(float, default=0.3, description="Speed ahead in m/s.")}

    def update(self):
        drive(get_input(self, "speed"))
```
"""

import dataclasses
import functools
import re
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any, Final

from tree_gardener.blackboard import EMPTY
from tree_gardener.errors import PortError
from tree_gardener.type_words import type_words
from tree_gardener.values import ANY, ConversionError, ValueType, value_type

if TYPE_CHECKING:
    from _collections_abc import dict_items, dict_values

    from tree_gardener.node import Node

INPUT: Final = "input"
OUTPUT: Final = "output"
INOUT: Final = "inout"

NO_DEFAULT: Final = EMPTY
IDENTITY: Final = frozenset(("name", "ID"))
"""Attributes of a node in XML that are no ports."""

FORBIDDEN: Final = re.compile(r"""[\x00-\x20\x7f/\\:*?|.<>&"']""")
"""A character that no ID and no name of a port may have."""
_LETTER = re.compile("[A-Za-z]")
_POINTER = re.compile(r" *\{(.+)\} *\Z", re.DOTALL)


class Port:
    """A port of an action, as declared in ``INPUT_PORTS``, ``OUTPUT_PORTS`` or ``INOUT_PORTS``.

    Attributes:
        type: a Python type; ``Any`` accepts all values.
        default: a value, ``"{key}"``, or ``"{=}"`` for the entry named like the port.
        required: whether a tree must give it a value.
        description: one sentence for users.
    """

    __slots__ = ("default", "description", "required", "type")

    def __init__(
        self,
        type: Any = Any,  # noqa: A002 - it is what users write
        *,
        default: Any = NO_DEFAULT,
        required: bool = False,
        description: str = "",
    ) -> None:
        self.type = type
        self.default = default
        self.required = required
        self.description = description

    def __repr__(self) -> str:
        return f"Port({self.type!r}, default={self.default!r})"


@dataclasses.dataclass(frozen=True)
class PortSpec:
    """A port as the engine knows it.

    Attributes:
        name: the attribute in XML.
        direction: ``input``, ``output`` or ``inout``.
        type: the type of its value.
        default: NO_DEFAULT if there is none.
        required: whether a missing value is refused at load.
        description: one sentence.
    """

    name: str
    direction: str
    type: ValueType
    default: Any = NO_DEFAULT
    required: bool = False
    description: str = ""


Manifest = Mapping[str, PortSpec]


@functools.lru_cache
def is_port_name(attribute: str) -> bool:
    """Returns whether an attribute of a node in XML is a port; others mean nothing to the engine."""
    return (
        _LETTER.match(attribute) is not None
        and attribute not in IDENTITY
        and FORBIDDEN.search(attribute) is None
    )


def entry_key(text: str) -> str:
    """Returns the name of an entry that a port is given bare or in braces; ``{=}`` has no meaning here."""
    match = _POINTER.match(text) if "{" in text else None
    return text if match is None else match.group(1)


def pointer_key(text: str, port: str) -> str | None:
    """Returns the name of the entry that ``{key}`` or ``{=}`` names, or None if the text is a literal."""
    if "{" not in text:
        return None
    match = _POINTER.match(text)
    if match is None:
        return None
    key = match.group(1)
    return port if key == "=" else key


def manifest_of(cls: type, types: Mapping[str, ValueType] | None = None) -> dict[str, PortSpec] | None:
    """Returns the ports that a class declares; None if it is *open*: it declares none and accepts any.

    `types` are those that a port can name, in addition to those of the catalogue.

    Raises:
        ValueError: a name cannot be that of a port.
    """
    specs: dict[str, PortSpec] = {}
    is_open = True
    for attribute, direction in (("INPUT_PORTS", INPUT), ("OUTPUT_PORTS", OUTPUT), ("INOUT_PORTS", INOUT)):
        declared = getattr(cls, attribute, None)
        if declared is None:
            continue
        is_open = False
        for name, port in declared.items():
            if not isinstance(name, str) or not name or name in IDENTITY or name.startswith("_"):
                raise ValueError(f"{attribute}: {name!r} cannot be the name of a port")
            both = name in specs and specs[name].direction != direction
            spec = _spec(name, INOUT if both else direction, port)
            given = getattr(port, "type", port)
            if types and isinstance(given, str) and given in types:
                spec = dataclasses.replace(spec, type=types[given])
            specs[name] = spec
    return None if is_open else specs


def _spec(name: str, direction: str, port: Any) -> PortSpec:
    if isinstance(port, Port):
        return PortSpec(name, direction, value_type(port.type), port.default, port.required, port.description)
    if hasattr(port, "data_type"):  # py_trees.ports.PortInformation, whose `required` is about reading
        default = NO_DEFAULT if port.default_value is None else port.default_value
        return PortSpec(name, direction, value_type(port.data_type), default, description=port.description)
    return PortSpec(name, direction, value_type(port))


class InputBinding:
    """The source of an input port's value: a literal, which was parsed once, or an entry."""

    __slots__ = ("key", "name", "type", "value")

    def __init__(self, spec: PortSpec, given: Any) -> None:
        self.name = spec.name
        self.type = spec.type
        self.key = pointer_key(given, spec.name) if isinstance(given, str) else None
        self.value: Any = EMPTY
        if self.key is None:
            self.value = spec.type.parse(given) if isinstance(given, str) else given

    def read(self, node: "Node") -> Any:
        """Returns the current value of the port.

        Raises:
            PortError: the entry is missing or empty, or its value cannot be converted.
        """
        if self.key is None:
            return self.value
        entry = node.board.find(self.key)
        if entry is None or entry.value is EMPTY:
            state = "does not exist" if entry is None else "has no value yet"
            raise PortError(f"port '{self.name}': the entry '{self.key}' {state}")
        try:
            return self.type.convert(entry.value)
        except ConversionError as error:
            raise PortError(f"port '{self.name}': the entry '{self.key}': {error}") from None


def read_port(node: "Node", name: str) -> Any:
    """Reads an input port of a node.

    Raises:
        PortError: the port has no value, or its value cannot be converted.
    """
    binding = node.inputs.get(name)
    if binding is None:
        binding = _bind(node, name)
    return binding.read(node)


def _bind(node: "Node", name: str) -> InputBinding:
    manifest = node.manifest
    spec = PortSpec(name, INOUT, ANY) if manifest is None else manifest.get(name)
    if spec is None:
        raise PortError(
            f"'{name}' is not a port of {node.type}; declared are: {', '.join(manifest or ()) or 'none'}"
        )
    given = node.ports.get(name, spec.default)
    if given is NO_DEFAULT:
        raise PortError(f"port '{name}' was given no value and has no default")
    if spec.direction == OUTPUT:
        raise PortError(f"port '{name}' is an output: it can be written, not read")
    try:
        binding = InputBinding(spec, given)
    except ConversionError as error:
        raise PortError(f"port '{name}': {error}") from None
    if not node.inputs:
        node.inputs = {}
    node.inputs[name] = binding
    return binding


def write_port(node: "Node", name: str, value: Any) -> None:
    """Writes an output port of a node.

    Raises:
        PortError: the port leads to no entry, or to an entry of another type.
    """
    manifest = node.manifest
    spec = PortSpec(name, INOUT, ANY) if manifest is None else manifest.get(name)
    if spec is None:
        raise PortError(
            f"'{name}' is not a port of {node.type}; declared are: {', '.join(manifest or ()) or 'none'}"
        )
    if spec.direction == INPUT:
        raise PortError(f"port '{name}' is an input: it can be read, not written")
    given = node.ports.get(name, spec.default)
    if given is NO_DEFAULT:
        raise PortError(f"port '{name}' leads to no entry; give it a {{key}}")
    key = pointer_key(given, name) if isinstance(given, str) else None
    if key is None:
        raise PortError(f"port '{name}' is an output and needs a {{key}}, not '{given}'")
    try:
        value = spec.type.convert(value)
    except ConversionError as error:
        raise PortError(f"port '{name}' takes {type_words(spec.type.name)}: {error}") from None
    node.board.set(key, value, spec.type, node.uid)


def node_of(behaviour: Any) -> "Node":
    """Returns the engine's node of a behaviour that is in a tree.

    Raises:
        PortError: the behaviour is not in a tree, as during ``__init__``.
    """
    node = getattr(behaviour, "tree_gardener_node", None)
    if node is None:
        raise PortError(f"{behaviour!r} is not in a tree yet: ports can be used from setup() on")
    return node  # type: ignore[no-any-return]


def get_input(behaviour: Any, name: str) -> Any:
    """Reads an input port, converted to the port's type.

    Raises:
        PortError: the port has no value, or its value cannot be converted.
    """
    return read_port(node_of(behaviour), name)


def set_output(behaviour: Any, name: str, value: Any) -> None:
    """Writes an output port.

    Raises:
        PortError: the tree gives the port no ``{key}``, or the entry has another type.
    """
    write_port(node_of(behaviour), name, value)


class BoundPorts(dict[str, str]):
    """The ``ports`` argument of an action's constructor: port name to text.

    Attributes:
        read: the names of the ports that were read; a copy reads all of them.
    """

    __slots__ = ("read",)

    def __init__(self, texts: Mapping[str, str]) -> None:
        super().__init__(texts)
        self.read: set[str] = set()

    def replace(self, texts: Mapping[str, str]) -> None:
        """Replaces all texts; the action sees them where it reads its ports later."""
        super().clear()
        super().update(texts)

    def __getitem__(self, name: str) -> str:
        self.read.add(name)
        return super().__getitem__(name)

    def get(self, name: str, default: Any = None, /) -> Any:
        """Returns the text of a port, which was read now."""
        self.read.add(name)
        return super().get(name, default)

    def __iter__(self) -> Iterator[str]:
        self.read.update(super().keys())
        return super().__iter__()

    def items(self) -> "dict_items[str, str]":
        """Returns the names with their texts, all of which were read now."""
        self.read.update(super().keys())
        return super().items()

    def values(self) -> "dict_values[str, str]":
        """Returns the texts, all of which were read now."""
        self.read.update(super().keys())
        return super().values()
