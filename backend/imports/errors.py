"""Errors of imports into a project; the tree of exceptions starts at `backend.core.problems.StudioError`."""

from __future__ import annotations

from backend.core.problems import StudioError


class ImportRefusedError(StudioError):
    """A robot, a world or a map cannot be imported; the reasons are in `diagnostics`."""

    status = 422
    code = "import_refused"
    title = "It cannot be imported"


class ImportChoiceError(StudioError):
    """The upload does not say which file to import; those that may be meant are in `items`."""

    status = 422
    code = "import_choice"
    title = "Choose what to import"


class ImportUnavailableError(StudioError):
    """No process may read the files of a user on this server, or it does not answer."""

    status = 503
    code = "import_unavailable"
    title = "Nothing can be imported at the moment"


class NotLookedAtError(StudioError):
    """The process that looks at robots with macros gave no answer."""

    status = 503
    code = "robots_not_looked_at"
    title = "The robots were not looked at"


class PartTakenError(StudioError):
    """The project has a robot or a universe of this name; `free` is a name that it has not."""

    status = 409
    code = "name_taken"
    title = "The name is taken"
