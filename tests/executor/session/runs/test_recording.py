"""The recording of a session: runs, segments, and a recorder that is lost."""

from __future__ import annotations

import pytest
from msgspec import structs

from executor import child_messages, messages, recorder_messages
from executor.session.events import (
    ChildExited,
    ChildLooked,
    ChildSaid,
    ClientJoined,
    RecordingWanted,
    Spawn,
    StreamOpened,
    Tell,
    Unpack,
    Unpacked,
)
from executor.session.ladder import State
from executor.session.runs.recording import MOST_LOST, SILENT_S
from tests.executor.session.play import APPLICATION, Play


def recorded(state: State = State.APPLICATION_RUNNING) -> Play:
    play = Play()
    play.happens(RecordingWanted("/folder"))
    play.climb(state)
    return play


def segment(number: int = 0, size: int = 10) -> messages.Segment:
    return messages.Segment("a1", 0, number, 0, 0.0, 1.0, size)


def says(play: Play, message: recorder_messages.FromRecorder) -> None:
    number = play.session.children.living["recorder"].number
    play.happens(ChildSaid("recorder", number, message))


def told(play: Play, kind: type) -> list:
    return [e.message for e in play.effects if hasattr(e, "message") and isinstance(e.message, kind)]


def test_a_run_begins_at_the_recorder_before_world_and_application():
    play = recorded()
    [begun] = told(play, recorder_messages.BeginRun)
    assert begun.folder == "/somewhere"
    runs = told(play, child_messages.BeginRecording)
    assert [run.run for run in runs] == [begun.run] * 2
    order = [name for kind in ("application",) for name in play.told(kind)]
    assert order.index("begin_recording") < order.index("resume")


@pytest.mark.parametrize("command", ["run", "run_application", "restart_application"])
def test_each_start_of_a_program_begins_a_run(command):
    play = recorded()
    assert play.reply(play.command(command)) == "ack"
    first, second = told(play, recorder_messages.BeginRun)
    assert first.run != second.run
    children = [begun.run for begun in told(play, child_messages.BeginRecording)]
    assert children == [first.run] * 2 + [second.run] * 2


@pytest.mark.parametrize("code", ["", "not_applied"])
def test_the_files_of_a_changed_program_are_recorded_and_those_before_if_it_is_refused(code):
    play = recorded()
    play.obedient = False
    play.command("apply", app_zip_base64="eA==", dry=False)
    unpack = next(effect for effect in reversed(play.effects) if isinstance(effect, Unpack))
    play.happens(Unpacked(unpack.token, "/changed"))
    (asked,) = told(play, child_messages.ApplyApplication)
    error = {"code": code, "message": "It does not fit."} if code else None
    play.child_says("application", "answer", request=asked.request, error=error)
    changes = [(change.run, change.folder) for change in told(play, recorder_messages.ChangeFiles)]
    run = play.session.recording.run
    order = [type(effect.message) for effect in play.effects if isinstance(effect, Tell)]
    assert order.index(recorder_messages.ChangeFiles) < order.index(child_messages.ApplyApplication)
    assert changes == [(run, "/changed"), *([(run, "/somewhere")] if code else [])]


def test_what_would_be_applied_is_not_recorded():
    play = recorded()
    assert play.reply(play.command("apply", app_zip_base64="eA==", dry=True)) == "ack"
    assert told(play, recorder_messages.ChangeFiles) == []


def test_the_recording_says_where_the_run_was():
    play = recorded()
    own = {"document": "name: Yard", "file": "yard.yaml"}
    universe = {"universe": own, "robot": "scout", "seed": 7}
    application = {**APPLICATION, "revision": 12}
    assert play.reply(play.command("run", universe=universe, application=application)) == "ack"
    first, second = told(play, recorder_messages.BeginRun)
    assert (first.about["robot"], first.about.get("revision"), first.universe) == ("", None, "")
    assert second.about["revision"] == "12"
    assert (second.about["robot"], second.about["seed"], second.universe) == ("scout", "7", "name: Yard")


def test_without_a_wish_nothing_is_recorded():
    play = Play()
    play.climb(State.APPLICATION_RUNNING)
    assert told(play, child_messages.BeginRecording) == []
    assert play.did(Spawn).count("recorder") == 0
    assert play.reply(play.command("flag", text="x")) == "not_recorded"
    assert play.reply(play.command("read_recording")) == "no_stream"


def test_a_reset_begins_another_run():
    play = recorded()
    play.command("reset_world")
    first, second = told(play, recorder_messages.BeginRun)
    assert first.run != second.run


@pytest.mark.parametrize("why", ["not_answering", "process_died"])
def test_a_reset_that_no_world_can_take_begins_no_other_run(why):
    play = recorded()
    before = play.session.recording.run
    if why == "process_died":
        del play.session.children.living["world"]
    else:
        world = play.session.children.living["world"]
        world.hang, world.vitals.silent_s = "The simulated world does not answer.", 60.0
    assert play.reply(play.command("reset_world")) == why
    assert len(told(play, recorder_messages.BeginRun)) == 1
    assert play.session.recording.run == before


def test_lines_faults_and_flags_are_recorded():
    play = recorded()
    play.child_says("application", "log", level="info", text="hello", time=2.0)
    assert play.reply(play.command("flag", text="here")) == "ack"
    lines = [(t.name, t.t, t.data["text"]) for t in told(play, recorder_messages.RunEvent)]
    assert lines == [("log", 2.0, "hello"), ("flag", play.session.sim_time_s, "here")]


def test_all_clients_see_a_flag_at_once_and_a_late_one_too():
    play = recorded()
    play.session.sim_time_s = 5.0
    assert play.reply(play.command("flag", text="here", t=2.0, user="ada")) == "ack"
    [flag] = play.sent("flag")
    assert (flag.run, flag.t, flag.text, flag.user) == (play.session.recording.run, 2.0, "here", "ada")
    play.command("flag", text="there", id=flag.id)
    assert [f.text for f in play.session.snapshot().flags] == ["there"]
    play.command("flag", text="", id=flag.id)
    assert play.session.snapshot().flags == []
    assert play.reply(play.command("flag", text="again", id=flag.id)) == "unknown_flag"


def test_a_client_cannot_flag_in_the_name_of_another():
    play = recorded()
    play.happens(ClientJoined("c1", "Ada"))
    play.command("flag", text="mine", user="Grace")
    play.command("take_over", "c1")
    play.command("flag", "c1", text="hers", user="Grace")
    play.command("flag", "c1", text="also hers")
    play.happens(ClientJoined("c1", "Grace"))  # another user connects as the same client
    play.command("flag", "c1", text="not Ada's", user="Ada")
    assert [(f.text, f.user) for f in play.sent("flag")] == [
        ("mine", "Grace"),  # nobody vouches for this client
        ("hers", "Ada"),
        ("also hers", "Ada"),
        ("not Ada's", "Grace"),
    ]


def test_who_changes_a_flag_becomes_its_user():
    play = recorded()
    play.command("flag", text="of Grace", user="Grace")
    [flag] = play.sent("flag")
    play.happens(ClientJoined("c1", "Ada"))
    play.command("take_over", "c1")
    play.command("flag", "c1", text="changed", id=flag.id)
    assert [(f.text, f.user) for f in play.session.snapshot().flags] == [("changed", "Ada")]


def test_viewers_set_no_flags():
    play = recorded()
    play.happens(ClientJoined("v"))
    assert play.reply(play.command("flag", "v", text="mine")) == "not_driver"
    assert play.sent("flag") == []


def test_another_recorder_hears_of_the_flags_and_the_gap():
    play = recorded()
    play.command("flag", text="here")
    play.child_dies("recorder", "was killed by SIGKILL")
    [flag, again] = [t for t in told(play, recorder_messages.RunEvent) if t.name == "flag"]
    assert again.data == flag.data
    [gap] = [t for t in told(play, recorder_messages.RunEvent) if t.name == "recording_stopped"]
    assert (gap.data["reason"], gap.data["goes_on"]) == ("recorder_died", True)
    for _ in range(MOST_LOST):
        play.child_dies("recorder", "was killed by SIGKILL")
    assert [stop.goes_on for stop in play.sent("recording_stopped")] == [True] * MOST_LOST + [False]
    assert play.reply(play.command("flag", text="late")) == "not_recorded"


def test_a_full_disk_is_a_mark_for_all_and_the_next_run_is_recorded_again():
    play = recorded()
    run = play.session.recording.run
    says(play, recorder_messages.Stopped(run, 3.5, "disk_full", "No space left on device"))
    [stop] = play.sent("recording_stopped")
    assert stop == messages.RecordingStopped(run, 3.5, "disk_full", "No space left on device", goes_on=False)
    assert play.session.snapshot().stops == [stop]
    [line] = play.sent("log")
    assert line.text == "The recording stops here: No space left on device. The run continues."
    assert play.state is State.APPLICATION_RUNNING
    assert play.reply(play.command("flag", text="late")) == "not_recorded"
    play.command("reset_world")
    assert play.reply(play.command("flag", text="in time")) == "ack"


def test_all_clients_get_segments_and_a_late_one_too():
    play = recorded()
    says(play, recorder_messages.Recorded(segment(0)))
    says(play, recorder_messages.Recorded(segment(1)))
    says(play, recorder_messages.Recorded(segment(0, size=0)))
    assert [s.number for s in play.sent("segment")] == [0, 1, 0]
    assert play.session.snapshot().segments == [segment(1)]


def test_each_run_has_a_number_of_its_own():
    play = recorded()
    assert play.reply(play.command("run_application")) == "ack"
    runs = [begun.run for begun in told(play, recorder_messages.BeginRun)]
    for run in reversed(runs):
        says(play, recorder_messages.Recorded(structs.replace(segment(), run=run)))
    assert [(each.run, each.run_number) for each in play.sent("segment")] == [(runs[1], 2), (runs[0], 1)]


def test_a_read_is_asked_of_the_recorder_and_answered_by_it():
    play = recorded()
    play.obedient = False
    request = play.command("read_recording")
    assert play.reply(request) == "no_stream"
    play.happens(StreamOpened("d"))
    request = play.command("read_recording")
    [asked] = told(play, recorder_messages.ReadSegment)
    assert (asked.client, asked.length) == ("d", 100)
    says(play, child_messages.Answer(request=asked.request))
    assert play.reply(request) == "ack"


def test_a_read_without_a_recorder_is_refused():
    play = Play()
    play.happens(StreamOpened("d"))
    assert play.reply(play.command("read_recording")) == "not_recorded"


def test_a_recorder_that_dies_is_replaced_and_the_run_continues():
    play = recorded()
    for lost in range(1, MOST_LOST + 2):
        play.child_dies("recorder", "was killed by SIGKILL")
        assert play.state is State.APPLICATION_RUNNING
        assert play.did(Spawn).count("recorder") == min(1 + lost, 1 + MOST_LOST)
    lines = [line.text for line in play.sent("log")]
    assert lines[0] == "The recorder was killed by SIGKILL. Another one records from here; the run continues."
    assert lines[-1] == "The recorder was killed by SIGKILL. Nothing more is recorded; the run continues."
    runs = {begun.run for begun in told(play, recorder_messages.BeginRun)}
    assert len(runs) == 1
    assert [line.level for line in play.sent("log")] == ["warning"] * len(lines)


def test_a_recorder_that_hangs_is_ended():
    play = recorded()
    play.obedient = False
    number = play.session.children.living["recorder"].number
    at = 0.0
    while at < SILENT_S + 1:
        play.now += 0.25
        at += 0.25
        play.happens(ChildLooked("recorder", number, "T", 0.0, 0.0))
    assert play.session.children.living["recorder"].number != number
    assert "did not answer for 8 s" in play.sent("log")[0].text
    play.happens(ChildExited("recorder", number, "was ended"))
    assert play.state is State.APPLICATION_RUNNING


def test_a_manager_that_was_away_blames_nobody_and_a_sign_of_life_counts():
    play = recorded()
    number = play.session.children.living["recorder"].number
    for _ in range(3):
        play.now += 100.0
        play.happens(ChildLooked("recorder", number, "S", 0.0, 0.0))
    for _ in range(100):
        play.now += 0.25
        says(play, child_messages.Beat(0))
        play.happens(ChildLooked("recorder", number, "S", 0.0, 0.0))
    assert play.session.children.living["recorder"].number == number


def test_what_the_recorder_says_is_a_line_of_the_manager():
    play = recorded()
    says(play, child_messages.Log("warning", "The recording stops here."))
    [line] = play.sent("log")
    assert (line.source, line.level, line.text) == ("manager", "warning", "The recording stops here.")
