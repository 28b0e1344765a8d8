"""A program: says what the real `launch` would start for each of the launch files that it reads the names of.

Nothing is started: the action that would do so notes the command line instead.
"""

from __future__ import annotations

import contextlib
import io
import json
import sys
from pathlib import Path
from typing import Any

import yaml
from launch import LaunchDescription, LaunchService
from launch.actions import IncludeLaunchDescription
from launch.actions.execute_local import ExecuteLocal
from launch.launch_description_sources import AnyLaunchDescriptionSource
from launch.utilities import perform_substitutions

noted: list[dict[str, Any]] = []


def note(self: Any, context: Any) -> None:
    """Takes the place of `ExecuteLocal.execute`."""
    self.prepare(context)
    described = self.process_description
    words = [str(word) for word in described.final_cmd]
    pairs = [
        [perform_substitutions(context, part) for part in pair] for pair in described.additional_env or []
    ]
    files = {word: Path(word) for word in words if "/launch_params_" in word}
    values = {word: yaml.safe_load(path.read_text()) for word, path in files.items()}
    noted.append({"words": words, "files": values, "environment": sorted(pairs)})


def main() -> None:
    """Reads a JSON list of paths, and writes a list of what would be started; null where it is refused."""
    ExecuteLocal.execute = note
    answers: list[Any] = []
    for path in json.load(sys.stdin):
        noted.clear()
        service = LaunchService(noninteractive=True)
        source = AnyLaunchDescriptionSource(path)
        service.include_launch_description(LaunchDescription([IncludeLaunchDescription(source)]))
        with contextlib.redirect_stdout(io.StringIO()):
            status = service.run()
        answers.append(None if status else [*noted])
    sys.stdout.write(f"answer {json.dumps(answers)}\n")


main()
