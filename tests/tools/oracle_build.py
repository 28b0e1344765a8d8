"""Builds a program that runs conformance cases in BehaviorTree.CPP 4.10 with Nav2's own control nodes.

The sources come from outside: the program that runs cases (see `FORMAT.md` beside the cases), a checkout of
BehaviorTree.CPP at 4.10.0, and one of Nav2. The time that RateController reads is made virtual, so that a
case gives the same trace on any machine: a step ``sleep`` advances it.
"""

from __future__ import annotations

import subprocess
from pathlib import Path
from typing import Final

NICE: Final = ("nice", "-n", "19")
PRELUDE: Final = """
#pragma once
#include "behaviortree_cpp/bt_factory.h"
#include <chrono>
namespace std::chrono {
struct case_clock {
  using duration = nanoseconds; using rep = duration::rep; using period = duration::period;
  using time_point = std::chrono::time_point<case_clock>;
  static constexpr bool is_steady = true;
  static inline int64_t msec = 0;
  static time_point now() { return time_point(milliseconds(msec)); }
};
}
#define high_resolution_clock case_clock
"""
NODES: Final = {
    "RoundRobin": ("control/round_robin_node", "RoundRobinNode"),
    "PipelineSequence": ("control/pipeline_sequence", "PipelineSequence"),
    "RecoveryNode": ("control/recovery_node", "RecoveryNode"),
    "PersistentSequence": ("control/persistent_sequence", "PersistentSequenceNode"),
    "NonblockingSequence": ("control/nonblocking_sequence", "NonblockingSequence"),
    "RateController": ("decorator/rate_controller", "RateController"),
}
CONTRACT_NODES: Final = Path(__file__).with_name("contract_nodes.hpp")
PROGRAMMED: Final = {
    "Own": ("Control", "false"),
    "OwnMarked": ("Control", "true"),
    "OwnDecorator": ("Decorator", "false"),
    "OwnDecoratorMarked": ("Decorator", "true"),
}
BEFORE_NODES: Final = "static json num"
LEFT_OUT: Final = {"manual_node", "shared_library_WIN"}
DEFINED: Final = '-DBTCPP_LIBRARY_VERSION="4.10.0"'
MARK: Final = 'f.registerNodeType<Leaf>("Leaf");'
SLEEP: Final = 't.sleep(std::chrono::milliseconds(o["ms"].get<int>()))'
START: Final = "EV.clear();CUR.clear();"


def build(folder: Path, program: Path, btcpp: Path, nav2: Path) -> Path:
    """Compiles what is not compiled yet, one file at a time, and returns the program.

    Args:
        folder: for objects and the program.
        program: the C++ source that runs cases.
        btcpp: the checkout of BehaviorTree.CPP.
        nav2: the checkout of Nav2.
    """
    folder.mkdir(parents=True, exist_ok=True)
    prelude = folder / "prelude.hpp"
    _write(prelude, PRELUDE)
    _write(folder / "cases.cpp", _with_nodes(program.read_text()))
    objects, own = _library(folder, btcpp)
    theirs = [*own, nav2 / "nav2_behavior_tree" / "include"]
    plugins = nav2 / "nav2_behavior_tree" / "plugins"
    for path, _ in NODES.values():
        source = plugins / f"{path}.cpp"
        objects.append(_compile(source, folder / f"{source.stem}.o", theirs, prelude))
    objects.append(_compile(folder / "cases.cpp", folder / "cases.o", theirs, prelude))
    result = folder / "cases"
    _run("g++", *map(str, objects), "-o", str(result), "-lpthread", "-ldl")
    return result


def build_contract(folder: Path, program: Path, btcpp: Path) -> Path:
    """Does the same with the nodes of `contract_nodes.hpp` in place of Nav2's."""
    folder.mkdir(parents=True, exist_ok=True)
    objects, own = _library(folder, btcpp)
    lines = "".join(
        f'f.registerNodeType<Programmed<Own{base},{marks}>>("{tag}");'
        for tag, (base, marks) in PROGRAMMED.items()
    )
    include = f'#include "{CONTRACT_NODES}"\n{BEFORE_NODES}'
    text = program.read_text()
    for mark in (MARK, BEFORE_NODES):
        if mark not in text:
            raise ValueError(f"the program has no '{mark}'")
    source = folder / "contract.cpp"
    _write(source, text.replace(MARK, MARK + lines).replace(BEFORE_NODES, include, 1))
    objects.append(_compile(source, folder / "contract.o", own))
    result = folder / "contract"
    _run("g++", *map(str, objects), "-o", str(result), "-lpthread", "-ldl")
    return result


def _library(folder: Path, btcpp: Path) -> tuple[list[Path], list[Path]]:
    """Compiles BehaviorTree.CPP; returns its objects and the folders of its headers."""
    third = btcpp / "3rdparty"
    own = [btcpp / "include", third, *(third / name for name in ("tinyxml2", "minicoro", "minitrace"))]
    sources = (*_sources(btcpp), third / "tinyxml2" / "tinyxml2.cpp")
    return [_compile(source, folder / f"{source.stem}.o", own) for source in sources], own


def _sources(btcpp: Path) -> list[Path]:
    found = sorted((btcpp / "src").rglob("*.cpp"))
    return [path for path in found if path.stem not in LEFT_OUT and path.parent.name != "loggers"]


def _with_nodes(text: str) -> str:
    """Registers Nav2's nodes in the program, and makes its sleeps virtual."""
    includes = "".join(f'#include "nav2_behavior_tree/plugins/{path}.hpp"\n' for path, _ in NODES.values())
    lines = "".join(
        f'f.registerNodeType<nav2_behavior_tree::{name}>("{tag}");' for tag, (_, name) in NODES.items()
    )
    for mark in (MARK, SLEEP, START):
        if mark not in text:
            raise ValueError(f"the program has no '{mark}'")
    text = text.replace(MARK, MARK + lines).replace(
        SLEEP, 'std::chrono::case_clock::msec+=o["ms"].get<int>()'
    )
    return includes + text.replace(START, f"{START}std::chrono::case_clock::msec=0;")


def _write(path: Path, text: str) -> None:
    if not path.exists() or path.read_text() != text:
        path.write_text(text)


def _compile(source: Path, target: Path, includes: list[Path], prelude: Path | None = None) -> Path:
    if not target.exists() or target.stat().st_mtime < source.stat().st_mtime:
        options = [*(f"-I{path}" for path in includes), *(["-include", str(prelude)] if prelude else [])]
        part = target.with_suffix(".part.o")
        _run("g++", "-std=c++17", "-O1", "-w", DEFINED, *options, "-c", str(source), "-o", str(part))
        part.rename(target)
    return target


def _run(*command: str) -> None:
    subprocess.run([*NICE, *command], check=True)
