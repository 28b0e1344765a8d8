"""The libraries of Groot2's protocol, which are imported when it is used."""

from typing import Any


def libraries() -> tuple[Any, Any]:
    """Returns pyzmq and msgpack.

    Raises:
        ModuleNotFoundError: one of them is not installed; the text says what to do.
    """
    try:
        import msgpack  # noqa: PLC0415
        import zmq  # noqa: PLC0415
    except ModuleNotFoundError as error:
        text = f"Groot2's protocol needs pyzmq and msgpack: pip install pyzmq msgpack ({error})"
        raise ModuleNotFoundError(text) from error
    return zmq, msgpack
