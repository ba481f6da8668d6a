"""Events of a session's sink: in warnings, in `explain`, and for a game that listens itself."""

from __future__ import annotations

import pytest

from scene2hap import HapticSession, MemorySink, SceneWarning, TeeSink, Touch
from scene2hap.devices.protocol import EventCallback, Fill, SinkEvent
from scenes import RATE, table_with_two_phones

CONFIG = {"sample_rate_hz": RATE}
ON_TABLE = Touch("left", "table", (0.8, 0.72, 0.4))


class Deviceless(MemorySink):
    """A sink whose device is not there."""

    on_event: EventCallback | None = None

    def start(self, fill: Fill) -> None:
        super().start(fill)
        if self.on_event is not None:
            self.on_event(SinkEvent("unavailable", "no card. Plug one in.", 0.0, "card"))


def test_a_sink_without_its_device_is_named_once() -> None:
    with HapticSession(*table_with_two_phones(), CONFIG, sink=Deviceless()) as s:
        with pytest.warns(SceneWarning, match=r"no card\. Plug one in\."):
            s.update(touches=[ON_TABLE])
        s.update(touches=[ON_TABLE])
        assert "no card" in s.explain("left").text


def test_a_missing_device_is_named_although_another_one_plays() -> None:
    card, amplifier = Deviceless(), MemorySink()
    amplifier.on_event = None  # type: ignore[attr-defined]  # looked up by name
    tee = TeeSink([card, amplifier])
    with HapticSession(*table_with_two_phones(), CONFIG, sink=tee) as s:
        assert tee.on_event is not None
        tee.on_event(SinkEvent("unavailable", "no card.", 0.0, "card"))
        tee.on_event(SinkEvent("connected", "the amplifier plays.", 0.1, "amplifier"))
        with pytest.warns(SceneWarning, match="no card"):
            s.update(touches=[ON_TABLE])
        assert "no card" in s.explain("left").text
        tee.on_event(SinkEvent("connected", "the card plays.", 0.2, "card"))
        assert "no card" not in s.explain("left").text


def test_a_game_that_listens_to_its_sink_gets_no_warning() -> None:
    sink, events = Deviceless(), list[SinkEvent]()
    listener = sink.on_event = events.append
    with HapticSession(*table_with_two_phones(), CONFIG, sink=sink) as s:
        s.update(touches=[ON_TABLE])
        assert "no card" in s.explain("left").text
    assert [one.kind for one in events] == ["unavailable"]
    assert sink.on_event == listener


def test_a_missing_device_is_named_although_the_game_listens_to_this_part_of_a_group() -> None:
    card, other, events = Deviceless(), Deviceless(), list[SinkEvent]()
    listener = card.on_event = events.append
    with HapticSession(*table_with_two_phones(), CONFIG, sink=TeeSink([TeeSink([card]), MemorySink()])) as s:
        s.update(touches=[ON_TABLE])  # without a warning
        assert "no card" in s.explain("left").text
        card.on_event(SinkEvent("connected", "the card plays.", 0.1, "card"))
        assert "no card" not in s.explain("left").text
    assert [one.kind for one in events] == ["unavailable", "connected"]
    assert card.on_event == listener
    with (
        HapticSession(*table_with_two_phones(), CONFIG, sink=TeeSink([card, other])) as s,
        pytest.warns(SceneWarning, match="no card"),  # of the other one
    ):
        s.update(touches=[ON_TABLE])
    assert len(events) == 3


def test_a_game_that_begins_to_listen_later_is_not_told_of_the_past() -> None:
    sink, events = Deviceless(), list[SinkEvent]()
    with HapticSession(*table_with_two_phones(), CONFIG, sink=sink) as s:
        sink.on_event = events.append  # from now on the session knows of no event, such as that the device came
        s.update(touches=[ON_TABLE])
        assert "no card" not in s.explain("left").text
    assert sink.on_event == events.append


def test_a_session_that_takes_a_sink_over_gets_its_events() -> None:
    sink = Deviceless()
    old = HapticSession(*table_with_two_phones(), CONFIG, sink=sink)
    new = HapticSession(*table_with_two_phones(), CONFIG, sink=sink)
    old.start()
    old.stop()
    new.start()
    assert "no card" in new.explain("left").text
    new.close()


def test_a_missing_device_is_named_by_each_session_that_plays_on_it_alone_or_with_others() -> None:
    card = Deviceless()
    for sink in (TeeSink([card, MemorySink()]), card, TeeSink([card, MemorySink()])):
        with (
            HapticSession(*table_with_two_phones(), CONFIG, sink=sink) as s,
            pytest.warns(SceneWarning, match="no card"),
        ):
            s.update(touches=[ON_TABLE])
        assert card.on_event is None


def test_a_callback_that_calls_the_one_before_is_called_once_after_a_second_start() -> None:
    sink, events = Deviceless(), list[SinkEvent]()
    s = HapticSession(*table_with_two_phones(), CONFIG, sink=sink)
    s.start()
    before = sink.on_event
    assert before is not None

    def chained(event: SinkEvent) -> None:
        events.append(event)
        before(event)

    sink.on_event = chained
    s.stop()
    s.start()
    assert [one.kind for one in events] == ["unavailable"]
    assert "no card" in s.explain("left").text
    s.close()
    assert sink.on_event is chained


def test_a_sink_whose_callback_cannot_be_set_is_free_after_the_error() -> None:
    class Closed(MemorySink):
        on_event = property(lambda self: None)

    sink = Closed()
    sessions = [HapticSession(*table_with_two_phones(), CONFIG, sink=sink) for _ in range(2)]
    for one in sessions:  # the second one gets no error that the first one uses the sink
        with pytest.raises(AttributeError):
            one.start()
