"""Makes a project of a tree that a Python file builds with py_trees.

The description of the tree comes from a child process that ran the file; nothing of it runs here. Where a
node of the library ticks as py_trees' class does, it takes its place. Others become classes in `actions/`
that derive from the class of the file or of py_trees and are made with the same arguments. If a class has no
such form, the whole tree becomes one action that holds it.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import PurePosixPath
from typing import TYPE_CHECKING, Any, Final
from xml.sax.saxutils import quoteattr

from translator.action import source_text
from translator.catalog import builtins
from translator.importer import from_xml
from translator.stub import can_be_class

if TYPE_CHECKING:
    from collections.abc import Mapping

    from translator.project import Project

Description = dict[str, Any]
"""A behaviour: `module`, `class`, `kind`, `name`, `arguments` as Python writes them, and `children`."""

_COMPOSITES: Final = "py_trees.composites"
_DECORATORS: Final = "py_trees.decorators"
_BEHAVIOURS: Final = "py_trees.behaviours"
_NATIVE: Final = {
    (_COMPOSITES, "Sequence", "True"): "Sequence",
    (_COMPOSITES, "Sequence", "False"): "ReactiveSequence",
    (_COMPOSITES, "Selector", "True"): "Fallback",
    (_COMPOSITES, "Selector", "False"): "ReactiveFallback",
    (_DECORATORS, "Inverter", ""): "Inverter",
    (_DECORATORS, "FailureIsSuccess", ""): "ForceSuccess",
    (_DECORATORS, "SuccessIsFailure", ""): "ForceFailure",
    (_BEHAVIOURS, "Success", ""): "AlwaysSuccess",
    (_BEHAVIOURS, "Failure", ""): "AlwaysFailure",
}
"""The nodes of the library that tick as a class of py_trees, by module, class and memory."""
_EMPTY: Final = {"Sequence": "AlwaysSuccess", "Selector": "AlwaysFailure", "Parallel": "AlwaysSuccess"}
"""What a composite of py_trees without children does."""
_SHIPPED: Final = {"composite": _COMPOSITES, "decorator": _DECORATORS}
_NOT_XML: Final = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]")

_LEAF: Final = '''"""`{cls}`, made as the tree of {file} makes it."""

{imports}


class {name}({base}):
    """`{cls}` with its arguments."""

    def __init__(self, name):
        super().__init__({arguments})
'''
_DECORATOR: Final = _LEAF.replace("(self, name)", "(self, name, child)")
_WHOLE: Final = '''"""The tree of {file} in one block. The blackboard's panel shows the statuses inside."""

import py_trees

import {module}


class {name}(py_trees.decorators.PassThrough):
    """Holds the tree of {file}."""

    def __init__(self, name):
        super().__init__(name, child={module}.{expression})
'''


class _NoFormError(Exception):
    """A behaviour cannot be a node."""


@dataclass
class _Writer:
    """Writes the nodes of one tree, and the classes that they need."""

    file: str
    modules: frozenset[str]
    taken: set[str] = field(default_factory=set)
    made: dict[tuple[str, ...], str] = field(default_factory=dict)
    actions: dict[str, bytes] = field(default_factory=dict)

    def xml(self, given: Description) -> str:
        """Returns a behaviour and all below it as XML.

        Raises:
            _NoFormError: one has no form.
        """
        kind, children = given["kind"], given["children"]
        arguments = given["arguments"] or {}
        name = f" name={quoteattr(_NOT_XML.sub('', given['name']))}" if given["name"] else ""
        is_plain = given["module"] == _COMPOSITES and given["class"] in _EMPTY
        if kind == "composite" and not children and is_plain:
            return f"<{_EMPTY[given['class']]}{name}/>"
        key = given["module"], given["class"], arguments.get("memory", "")
        tag = _NATIVE.get(key) or self.class_of(given)
        inside = "".join(self.xml(child) for child in children)
        return f"<{tag}{name}>{inside}</{tag}>" if inside else f"<{tag}{name}/>"

    def class_of(self, given: Description) -> str:
        """Returns the class in `actions/` for a behaviour."""
        module, cls, kind = given["module"], given["class"], given["kind"]
        is_named = bool(module) and can_be_class(cls)
        if not is_named or given["arguments"] is None:
            why = "is made with more than plain values" if is_named else "is not one of a module"
            raise _NoFormError(f"the class {cls} of '{given['name']}' {why}")
        if kind != "leaf" and module != _SHIPPED[kind]:
            raise _NoFormError(f"{cls} of '{given['name']}' is a {kind} of its own")
        if kind == "leaf" and given["children"]:
            raise _NoFormError(f"{cls} of '{given['name']}' has children and is no composite")
        if "SuccessOnSelected" in given["arguments"].get("policy", ""):
            raise _NoFormError(f"'{given['name']}' succeeds on selected children")
        key = (module, cls, *(f"{name}={text}" for name, text in given["arguments"].items()))
        if key not in self.made:
            name = self.free(cls)
            self.made[key] = name
            self.actions[f"{name}.py"] = self.source(name, given).encode()
        return self.made[key]

    def free(self, wanted: str) -> str:
        """Returns a name for a class that nothing else has."""
        base = wanted if can_be_class(wanted) and wanted not in builtins() else f"PyTrees{wanted}"
        name, number = base, 1
        while name in self.taken or name in self.modules:
            number += 1
            name = f"{base}{number}"
        self.taken.add(name)
        return name

    def source(self, name: str, given: Description) -> str:
        """Returns the source of a class."""
        module, cls = given["module"], given["class"]
        given_texts = [f"{each}={text}" for each, text in given["arguments"].items()]
        is_decorator = given["kind"] == "decorator"
        arguments = ", ".join(["name=name", *(["child=child"] if is_decorator else []), *given_texts])
        imports = ["import operator"] if "operator." in arguments else []
        if "py_trees." in arguments or module.startswith("py_trees."):
            imports += [*([""] if imports else []), "import py_trees"]
        base = f"{module}.{cls}"
        if not module.startswith("py_trees."):
            imports += [*([""] if imports else []), f"from {module} import {cls} as Made"]
            base = "Made"
        text = _DECORATOR if is_decorator else _LEAF
        return text.format(
            cls=cls, file=self.file, imports="\n".join(imports), name=name, base=base, arguments=arguments
        )


def project_of_py_trees(
    description: Mapping[str, Any], sources: Mapping[str, bytes], *, file: str
) -> tuple[Project, str]:
    """Returns the project of a tree, and why the tree is one block, or "".

    Args:
        description: what the child found: `module`, `expression` and `root`.
        sources: the files that the tree's file imports from its folder, and itself, by name.
        file: the name of the tree's file.

    Raises:
        TranslatorError: the tree is too large for a project.
    """
    modules = frozenset(PurePosixPath(path).stem for path in sources)
    writer, why = _Writer(file, modules), ""
    try:
        xml = writer.xml(description["root"])
    except _NoFormError as error:
        why = str(error)
        writer = _Writer(file, modules)
        stem = "".join(part.capitalize() for part in re.split(r"\W|_", description["module"])) or "Whole"
        name = writer.free(stem if can_be_class(stem) else "WholeTree")
        text = _WHOLE.format(
            file=file, module=description["module"], expression=description["expression"], name=name
        )
        writer.actions[f"{name}.py"] = text.encode()
        xml = f"<{name}/>"
    document = f'<root BTCPP_format="4"><BehaviorTree ID="MainTree">{xml}</BehaviorTree></root>'
    shared = {path: source_text(raw.decode("utf-8", "replace")).encode() for path, raw in sources.items()}
    project = from_xml(document, file=f"{PurePosixPath(file).stem}.xml", actions={**shared, **writer.actions})
    return project, why
