"""The engine is a separate distribution; another version of it is refused with one sentence."""

from __future__ import annotations

from pathlib import Path

import tree_gardener
from backend import __version__
from backend.cli.shared.errors import CliError


def require_engine() -> None:
    """Raises an error with what to do if the installed engine is not the one of this version."""
    if tree_gardener.__version__ != __version__:
        folder = Path(str(tree_gardener.__file__)).parent
        raise CliError(
            f"bt-studio {__version__} needs tree-gardener {__version__}, and {folder} is "
            f"{tree_gardener.__version__}: run `make run` in a clone, else "
            f"`pip install tree-gardener=={__version__}`"
        )
