"""Why there is no transform."""


class TransformException(Exception):  # noqa: N818 - its name in tf2
    """Anything that tf2 raises."""


class ConnectivityException(TransformException):
    """Both frames are known, and nothing connects them."""


class LookupException(TransformException):
    """A frame is not known."""


class ExtrapolationException(TransformException):
    """The time lies outside of what was heard."""


class InvalidArgumentException(TransformException):
    """The name of a frame is none."""


class TimeoutException(TransformException):
    """No answer came in time."""
