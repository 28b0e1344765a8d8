"""The base of all filters."""


def test_callbacks_get_each_output_and_their_own_arguments() -> None:
    from message_filters.simple import SimpleFilter, stamp_of

    heard: list[object] = []
    source = SimpleFilter()
    source.registerCallback(lambda message, more: heard.append((message, more)), "x")
    source.signalMessage("a")
    source.signalMessage("b")
    assert heard == [("a", "x"), ("b", "x")]
    assert stamp_of("no header", allow_headerless=False, who="test") is None
    assert stamp_of("no header", allow_headerless=True, who="test") is not None
