"""Generates the sources of an interface package: `python generate_interfaces.py STEP FOLDER SHARE…`.

It is a separate program, since it needs `empy<4` while other packages need a newer version. FOLDER has the
package's name and its interface files, and receives the sources; SHARE are the folders of the packages that
it uses. The steps after `describe` may run in parallel.
"""

from __future__ import annotations

import functools
import sys
from pathlib import Path
from typing import Any, Final

import rosidl_generator_py.generate_py_impl as py_generator
import rosidl_parser.parser as idl_parser
import rosidl_pycommon
from rosidl_adapter import convert_to_idl
from rosidl_generator_c.cli import GenerateC
from rosidl_generator_py.cli import GeneratePython
from rosidl_generator_type_description.cli import HashTypeDescription
from rosidl_parser.definition import IdlLocator
from rosidl_typesupport_c.cli import GenerateCTypesupport
from rosidl_typesupport_fastrtps_c.cli import GenerateFastRTPSCTypesupport
from rosidl_typesupport_introspection_c.cli import GenerateIntrospectionCTypesupport

KINDS: Final = ("msg", "srv", "action")
INTROSPECTION: Final = "introspection"


def describe(folder: Path, share: list[str]) -> None:
    """Translates the interface files to IDL, and writes a description of each type with its hash."""
    for kind in KINDS:
        for path in sorted((folder / kind).glob(f"*.{kind}")):
            convert_to_idl(folder, folder.name, path.relative_to(folder), folder)
    HashTypeDescription("hash").generate_type_hashes(folder.name, _idl(folder), share, folder)


def structures(folder: Path, share: list[str]) -> None:
    """Writes the C structures.

    They are written kind by kind, since the generator confuses a message with an action of the same name.
    """
    for kind in KINDS:
        if files := _idl(folder, kind):
            described = sorted((folder / kind).glob("*.json"))
            GenerateC("c").generate(folder.name, files, share, folder, described)


def support(folder: Path, share: list[str]) -> None:
    """Writes the type support: serialization, and the description of types for other participants."""
    GenerateFastRTPSCTypesupport("fastrtps_c").generate(folder.name, _idl(folder), share, folder)
    # A separate folder, since the introspection sources have the same file names as those of FastRTPS.
    beside = folder.parent / INTROSPECTION / folder.name
    GenerateIntrospectionCTypesupport("introspection_c").generate(folder.name, _idl(folder), share, beside)
    kinds = ["rosidl_typesupport_fastrtps_c", "rosidl_typesupport_introspection_c"]
    GenerateCTypesupport("c", typesupport_implementations=kinds).generate(
        folder.name, _idl(folder), share, folder
    )


def python(folder: Path, share: list[str]) -> None:
    """Writes the Python classes."""
    GeneratePython("py", typesupport_implementations=["rosidl_typesupport_c"]).generate(
        folder.name, _idl(folder), share, folder
    )


STEPS: Final = {step.__name__: step for step in (describe, structures, support, python)}


def _idl(folder: Path, kind: str = "*") -> list[str]:
    return [f"{folder}:{path.relative_to(folder)}" for path in sorted(folder.glob(f"{kind}/*.idl"))]


def _parse_each_file_once() -> None:
    """Caches parsed files for all generators of a step."""
    parse = idl_parser.parse_idl_file

    @functools.cache
    def read(base: str, relative: str) -> Any:
        return parse(IdlLocator(base, relative))

    def parse_once(locator: Any, png_file: object = None) -> Any:
        return read(str(locator.basepath), str(locator.relative_path))

    for module in (idl_parser, rosidl_pycommon, py_generator):
        module.parse_idl_file = parse_once


if __name__ == "__main__":
    _parse_each_file_once()
    STEPS[sys.argv[1]](Path(sys.argv[2]), sys.argv[3:])
