"""Sessions over a bridge: the inputs of clients have the same effect as in a local session."""

import socket
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from bridge_client import Client, Refused, __file__ as game
from scene2hap import HapticBundle, HapticSession, Pose, Touch, bake_object
from scene2hap.bridge import BridgeServer
from scene2hap.cli import main
from scene2hap.devices.protocol import Block, Fill, SinkFormat, SinkStats
from scene2hap.testing import check_bridge_client
from serial_bench import eventually

Bridge = Callable[..., BridgeServer]

REST = {"table": (0.0, 0.7, 0.0), "phone": (0.2, 0.724, 0.0), "mug": (-0.3, 0.765, 0.0)}
ON_TABLE = Touch("left", "table", (0.0, 0.72, 0.0))


def poses(*ids: str, **moved: tuple[float, float, float]) -> np.ndarray:
    return np.array([[*{**REST, **moved}[key], 0, 0, 0, 1] for key in ids], np.float32)


def test_the_game_of_the_protocol_page_loses_no_answer_with_frames_in_flight() -> None:
    found = check_bridge_client([sys.executable, "-W", "error", game], n_frames=60, rate_hz=400.0)
    assert (found.n_frames, found.n_resumed) == (60, 1)
    assert found.worst < 1e-6


@pytest.mark.parametrize(
    ("program", "says"),
    [
        ("raise SystemExit(3)", "the client ended with status 3"),
        ("pass", "the client has not written gains.csv"),
        ("write('')", "the lines lack 600 of 600 frames, the first with sequence 1"),
        ("write('1,0.5,nan')", "a line of gains.csv is '1,0.5,nan'; it must be a sequence and gains"),
        ("write(' '.join(f'{i},0' for i in range(600, 0, -1)))", "the lines are not in the order of their sequences"),
        ("write(' '.join(f'{i or 1},0' for i in range(601)))", "601 lines are written for 600 frames"),
        ("write(' '.join(f'{i}' + i % 7 * ',0' for i in range(1, 601)))", "a line has 1 gains; it must have 4"),
    ],
)
def test_a_client_that_fails_the_check_learns_why(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], program: str, says: str
) -> None:
    file = tmp_path / "client.py"
    head = "import os, pathlib\nwrite = pathlib.Path(os.environ['SCENE2HAP_OUT']).write_text\n"
    file.write_text(head + program)
    assert main(["bridge", "--check", f"{sys.executable} {file}"]) == 1
    said = " ".join(capsys.readouterr().err.split())
    assert f"the client fails the check: {says}" in said


def test_a_command_that_does_not_start_is_no_traceback(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["bridge", "--check", "no-such-client"]) == 1
    assert "--check is 'no-such-client', which cannot be started" in " ".join(capsys.readouterr().err.split())


def test_gains_over_the_bridge_equal_a_local_session(bridge: Bridge, desk: HapticBundle) -> None:
    session = HapticSession(desk)
    with Client(bridge().url) as client:
        order = client.play(bundle="desk.bundle", moving=["phone", "mug"])
        assert order["objects"] == ["phone", "mug", "table"]
        assert order["n_moving"] == 2
        assert [source["id"] for source in order["sources"]] == ["phone"]
        for i in range(20):
            x = 0.2 - 0.02 * i
            client.socket.send(client.frame(i + 1, i / 60, poses("phone", "mug", phone=(x, 0.724, 0.1)), [ON_TABLE]))
            sent = np.array([x, 0.724, 0.1], np.float32).tolist()  # frames have single precision
            here = session.update({"phone": Pose(tuple(sent))}, [ON_TABLE])
            found = client.next_gains()
            assert (found.sequence, found.time_s, found.layout) == (i + 1, i / 60, 1)
            np.testing.assert_allclose(found.gains, here.gains, atol=1e-6)
        assert found.gains[0, 0, 0] > 0.0
        assert found.gains[1, 0, 0] == 0.0


def test_intensity_is_the_rendered_level_of_the_hand(bridge: Bridge, desk: HapticBundle) -> None:
    session = HapticSession(desk)
    session.wait_prepared(30)
    blocks = []
    for i in range(60):
        session.update(touches=[ON_TABLE])
        blocks.append(session.render_s(1 / 60 if i else session.config.control_period_s))
    with Client(bridge().url) as client:
        client.play(bundle="desk.bundle", moving=[])
        heard = []
        for i in range(60):
            client.socket.send(client.frame(i + 1, i / 60, poses(), [ON_TABLE]))
            heard.append(client.next_gains().intensities)
    expected = [np.sqrt(2 * np.mean(np.square(block, dtype=float), axis=0)) for block in blocks]
    np.testing.assert_allclose(heard, expected, atol=1e-4)
    assert max(one[0] for one in heard) > 0.01


def test_touches_without_poses_and_lifted_hands(bridge: Bridge) -> None:
    with Client(bridge().url) as client:
        client.play(bundle="desk.bundle")
        client.socket.send(client.frame(1, 0.0, np.empty((0, 7)), [ON_TABLE]))
        assert client.next_gains().gains[0].max() > 0.0
        client.socket.send(client.frame(2, 0.1, np.empty((0, 7)), []))
        assert client.next_gains().gains.max() == 0.0


def test_several_watch_and_one_plays(bridge: Bridge) -> None:
    server = bridge()
    with Client(server.url) as player, Client(server.url) as first, Client(server.url) as second:
        session = player.play(bundle="desk.bundle", moving=[])["session"]
        for one in (first, second):
            assert one.ask("watch", session=session)["objects"] == player.order["objects"]
        player.socket.send(player.frame(1, 0.0, poses(), [ON_TABLE]))
        heard = [one.next_gains() for one in (player, first, second)]
        assert [one.gains.tolist() for one in heard] == [heard[0].gains.tolist()] * 3
        with pytest.raises(Refused, match="only its player"):
            first.ask("pause")
        assert first.ask("explain", hand="left")["felt"][0]["source_id"] == "phone"
        assert second.ask("leave")["type"] == "left"
        player.ask("remove", object="mug")
        assert first.hear(lambda one: one["type"] == "order")["objects"] == ["table", "phone"]
        player.ask("leave")
        assert first.hear(lambda one: one["type"] == "state")["is"] == "ended"


@pytest.mark.parametrize("frames", ["newest", "every"])
def test_who_watches_a_session_takes_it_over(bridge: Bridge, frames: str) -> None:
    server = bridge()
    with Client(server.url) as player, Client(server.url) as watcher, Client(server.url) as other:
        playing = player.play(bundle="desk.bundle", moving=[], frames=frames)
        for one in (watcher, other):
            one.ask("watch", session=playing["session"])
        with pytest.raises(Refused, match="another key"):
            watcher.ask("resume", session=playing["session"], key="0" * 16)
        player.socket.send(player.frame(1, 1.0, poses(), [ON_TABLE]))
        assert [one.next_gains().time_s for one in (player, watcher, other)] == [1.0] * 3
        watcher.order = watcher.ask("resume", session=playing["session"], key=playing["key"])
        watcher.key = player.key
        assert watcher.order["sequence"] == 1
        watcher.socket.send(watcher.frame(2, 2.0, poses(), [ON_TABLE]))
        assert [watcher.next_gains().time_s for _ in range(2)] == [1.0, 2.0]  # the last are repeated
        assert other.next_gains().time_s == 2.0
        with pytest.raises(Refused, match="there is no session"):
            player.ask("pause")
        watcher.ask("leave")
        other.hear(lambda one: one["type"] == "state" and one["is"] == "ended")


def test_another_session_takes_the_place_of_a_watched_one(bridge: Bridge) -> None:
    server = bridge()
    with Client(server.url) as one, Client(server.url) as other, Client(server.url) as watcher:
        sessions = [player.play(bundle="desk.bundle", moving=[])["session"] for player in (one, other)]
        for session in sessions:
            assert watcher.ask("watch", session=session)["session"] == session
        one.socket.send(one.frame(1, 0.0, poses(), [ON_TABLE]))
        one.next_gains()
        other.socket.send(other.frame(1, 7.0, poses(), []))
        assert watcher.next_gains().time_s == 7.0
        with pytest.raises(Refused, match="no session"):
            watcher.ask("watch", session="c2f1a09b")
        other.socket.send(other.frame(2, 8.0, poses(), []))
        assert watcher.next_gains().time_s == 8.0  # a refused request changes nothing
        watcher.play(bundle="desk.bundle", moving=[])
        with pytest.raises(Refused, match="leave"):
            watcher.ask("watch", session=sessions[0])
        other.socket.send(other.frame(3, 9.0, poses(), []))
        other.ask("stats")
        watcher.socket.send(watcher.frame(1, 1.0, poses(), [ON_TABLE]))
        assert watcher.next_gains().time_s == 1.0


def test_states_levels_and_pauses(bridge: Bridge) -> None:
    with Client(bridge().url) as client:
        client.play(bundle="desk.bundle", moving=[])

        def gain(sequence: int) -> float:
            client.socket.send(client.frame(sequence, sequence / 60, poses(), [ON_TABLE]))
            return float(client.next_gains().gains[0, 0, 0])

        full = gain(1)
        client.ask("set_source", source="phone", gain_db=-6.0)
        assert gain(2) == pytest.approx(full * 10 ** (-6 / 20), rel=1e-5)
        client.ask("set_source", source="phone", gain_db=0.0, mute=True)
        assert gain(3) == 0.0
        client.ask("set_source", source="phone", mute=False)
        client.ask("set_user", gain_db=-20.0)
        assert gain(4) == pytest.approx(0.1 * full, rel=1e-5)
        client.ask("set_user", gain_db=0.0)
        client.ask("pause")
        assert gain(5) == 0.0
        client.ask("unpause")
        assert gain(6) == pytest.approx(full)
        with pytest.raises(Refused, match="no state 'singing'") as refused:
            client.ask("set_source", source="phone", state="singing")
        assert refused.value.kind == "SessionError"
        with pytest.raises(Refused, match="no source 'fone'") as refused:
            client.ask("set_source", source="fone")
        assert refused.value.kind == "UnknownObject"


def test_objects_come_and_go_and_frames_on_the_way_are_read(bridge: Bridge, desk: HapticBundle) -> None:
    with Client(bridge().url) as client:
        client.play(bundle="desk.bundle", moving=["phone", "mug"])
        # Encoded before the mug is removed, read afterwards: its pose and touch are ignored.
        late = client.frame(2, 0.02, poses("phone", "mug"), [ON_TABLE, Touch("right", "mug", (-0.3, 0.81, 0.0))])
        order = client.ask("remove", object="mug")
        assert (order["layout"], order["objects"]) == (2, ["phone", "table"])
        client.socket.send(late)
        found = client.next_gains()
        assert found.layout == 2
        assert found.gains[0, 0, 0] > 0.0
        assert found.gains[1].max() == 0.0
        row = {
            "id": "tray",
            "name": "Steel tray",
            "pose": {"position_m": [0.0, 0.725, -0.2]},
            "geometry": {"kind": "box", "size_m": [0.3, 0.01, 0.2]},
        }
        client.order = client.ask("add", object=row)
        assert "tray" in client.order["objects"]
        client.socket.send(client.frame(3, 0.04, poses("phone"), [Touch("left", "tray", (0.0, 0.73, -0.2))]))
        client.next_gains()
        client.order = client.ask("moving", moving=["tray", "phone"])
        assert client.order["objects"][:2] == ["tray", "phone"]
        with pytest.raises(Refused, match="no object 'tra'"):
            client.ask("moving", moving=["tra"])


def test_prefabs_are_spawned(bridge: Bridge, root: Path, desk: HapticBundle) -> None:
    bake_object(desk.snapshot.object("phone")).save(root / "phone.bundle")
    with Client(bridge().url) as client:
        client.play(bundle="desk.bundle", moving=[])
        client.order = client.ask("spawn", prefab="phone.bundle", object="phone_2", position_m=[-0.1, 0.724, 0.0])
        assert [source["id"] for source in client.order["sources"]] == ["phone", "phone_2"]
        client.socket.send(client.frame(1, 0.0, poses(), [ON_TABLE]))
        assert (client.next_gains().gains[0, :, 0] > 0.0).all()


def test_impacts_are_sent_to_clients(bridge: Bridge) -> None:
    with Client(bridge().url) as client:
        client.play(bundle="desk.bundle", moving=[])
        client.socket.send(client.frame(1, 0.0, poses(), [ON_TABLE]))
        client.next_gains()
        client.ask("strike", object="table", point_m=[0.1, 0.72, 0.0], speed_m_s=1.0)
        client.socket.send(client.frame(2, 0.02, poses(), [ON_TABLE]))
        impact = client.hear(lambda one: one["type"] == "impact")
        assert impact["object"] == "table"
        assert 0.0 < impact["felt"]["left"] <= 1.0
        client.socket.send(client.frame(3, 0.2, poses(), [ON_TABLE]))
        client.next_gains()
        client.ask("strike", object="table", point_m=[0.1, 0.72, 0.0], speed_m_s=1.0)
        client.socket.send(client.frame(4, 0.3, poses(), [ON_TABLE]))
        client.hear(lambda one: one["type"] == "impact")
        client.socket.send(client.frame(5, 0.4, poses(), [ON_TABLE]))
        client.ask("stats")
        assert not [one for one in client.heard if one["type"] == "impact"], "an impact is told once"


def held_updates(monkeypatch: pytest.MonkeyPatch) -> tuple[threading.Event, threading.Event]:
    """Hold updates of sessions. Returns an event that the first of them sets, and one that lets them go on."""
    entered, may_go_on = threading.Event(), threading.Event()
    update = HapticSession.update

    def slow(self: HapticSession, *args: Any, **options: Any) -> Any:
        entered.set()
        assert may_go_on.wait(60)
        return update(self, *args, **options)

    monkeypatch.setattr(HapticSession, "update", slow)
    return entered, may_go_on


def test_the_newest_frame_wins(bridge: Bridge, monkeypatch: pytest.MonkeyPatch) -> None:
    with Client(bridge().url) as client:
        client.play(bundle="desk.bundle", moving=[])
        entered, may_go_on = held_updates(monkeypatch)
        for sequence in range(1, 11):
            client.socket.send(client.frame(sequence, sequence / 60, poses(), [ON_TABLE]))
        assert entered.wait(60)
        may_go_on.set()
        found = client.next_gains()
        while found.sequence < 10:
            found = client.next_gains()
        frames = client.ask("stats")["frames"]
        assert frames["skipped"] > 0
        assert frames["received"] + frames["skipped"] == 10
        assert found.skipped == frames["skipped"]


def test_poses_of_a_skipped_frame_hold(bridge: Bridge, monkeypatch: pytest.MonkeyPatch) -> None:
    with Client(bridge().url) as client:
        client.play(bundle="desk.bundle", moving=["phone"])
        client.socket.send(client.frame(1, 0.0, poses("phone"), [ON_TABLE]))
        on_table = client.next_gains().gains[0, 0, 0]
        entered, may_go_on = held_updates(monkeypatch)
        client.socket.send(client.frame(2, 0.1, np.empty((0, 7)), [ON_TABLE]))
        assert entered.wait(60)
        client.socket.send(client.frame(3, 0.2, poses("phone", phone=(0.2, 5.0, 0.0)), [ON_TABLE]))
        client.socket.send(client.frame(4, 0.3, np.empty((0, 7)), [ON_TABLE]))
        may_go_on.set()
        found = client.next_gains()
        while found.sequence < 4:
            found = client.next_gains()
        assert client.ask("stats")["frames"]["skipped"] >= 1
        assert on_table > 0.0
        assert found.gains[0, 0, 0] == 0.0


def test_every_frame_is_answered_on_request(bridge: Bridge) -> None:
    with Client(bridge().url) as client:
        client.play(bundle="desk.bundle", moving=[], frames="every")
        for sequence in range(1, 201):
            client.socket.send(client.frame(sequence, sequence / 60, poses(), [ON_TABLE]))
        assert [client.next_gains().sequence for _ in range(200)] == [*range(1, 201)]


def test_old_frames_are_dropped_and_counted(bridge: Bridge) -> None:
    with Client(bridge().url) as client:
        client.play(bundle="desk.bundle", moving=[], frames="every")
        for sequence, at_s in ((5, 1.0), (5, 1.1), (4, 1.2), (7, 1.3)):
            client.socket.send(client.frame(sequence, at_s, poses(), [ON_TABLE]))
        assert [client.next_gains().sequence for _ in range(2)] == [5, 7]
        assert client.ask("stats")["frames"] == {"received": 4, "skipped": 0, "outdated": 2}


def test_session_is_kept_across_connections(bridge: Bridge) -> None:
    server = bridge()
    with Client(server.url) as watcher, Client(server.url) as client:
        client.play(bundle="desk.bundle", moving=["phone"])
        session, key = client.order["session"], client.order["key"]
        watcher.ask("watch", session=session)
        client.ask("set_source", source="phone", gain_db=-6.0)
        client.ask("remove", object="mug")
        client.socket.send(client.frame(7, 1.0, poses("phone", phone=(0.3, 0.724, 0.0)), [ON_TABLE]))
        before = client.next_gains()
        watcher.next_gains()
        client.socket.socket.close()
        assert watcher.hear(lambda one: one["type"] == "state")["is"] == "waiting"
        assert watcher.next_gains().gains.max() == 0.0
        with Client(server.url) as again:
            with pytest.raises(Refused, match="another key") as refused:
                again.ask("resume", session=session, key="0" * 16)
            assert refused.value.kind == "UnknownSession"
            again.order = again.ask("resume", session=session, key=key)
            again.key = bytes.fromhex(key)
            assert again.order["sequence"] == 7
            assert again.order["objects"] == ["phone", "table"]
            repeated = again.next_gains()
            assert repeated.sequence == 7
            np.testing.assert_array_equal(repeated.gains, before.gains)
            again.socket.send(again.frame(8, 1.1, np.empty((0, 7)), [ON_TABLE]))
            np.testing.assert_allclose(again.next_gains().gains, before.gains, rtol=1e-6)
            assert watcher.hear(lambda one: one["type"] == "state")["is"] == "playing"


@pytest.mark.parametrize("restarts_at_s", [0.0, -5.0])
def test_a_clock_that_goes_back_begins_anew(bridge: Bridge, restarts_at_s: float) -> None:
    """Clocks of engines restart, as at a new level; the hands must not fall silent until they have caught up."""
    with Client(bridge().url) as client:
        client.play(bundle="desk.bundle", moving=[], frames="every")
        times_s = (1000.0, 1000.02, 1e9, restarts_at_s, restarts_at_s + 0.02)
        for sequence, at_s in enumerate(times_s, 1):
            client.socket.send(client.frame(sequence, at_s, poses(), [ON_TABLE]))
            found = client.next_gains()
            assert (found.sequence, found.time_s) == (sequence, at_s)
            assert found.intensities[0] > 0.0
        assert client.ask("stats")["frames"] == {"received": 5, "skipped": 0, "outdated": 0}


def test_a_restarted_game_resumes_with_a_new_clock(bridge: Bridge) -> None:
    server = bridge()
    with Client(server.url) as client:
        client.play(bundle="desk.bundle", moving=[])
        client.socket.send(client.frame(1, 1000.0, poses(), [ON_TABLE]))
        client.next_gains()
    with Client(server.url) as again:
        again.order = again.ask("resume", session=client.order["session"], key=client.order["key"])
        again.key = client.key
        again.next_gains()  # those of the last frame, again
        for sequence, at_s in ((2, 0.5), (3, 0.6)):
            again.socket.send(again.frame(sequence, at_s, poses(), [ON_TABLE]))
            found = again.next_gains()
            assert (found.sequence, found.time_s) == (sequence, at_s)
            assert found.intensities[0] > 0.0


def test_session_key_allows_takeover(bridge: Bridge) -> None:
    server = bridge()
    with Client(server.url) as old, Client(server.url) as new:
        old.play(bundle="desk.bundle", moving=[])
        new.order = new.ask("resume", session=old.order["session"], key=old.order["key"])
        new.key = old.key
        with pytest.raises(Refused, match="no session"):
            old.ask("pause")
        new.socket.send(new.frame(1, 0.0, poses(), [ON_TABLE]))
        assert new.next_gains().gains.max() > 0.0


def test_bridge_error_is_reported_and_logged(
    bridge: Bridge, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    with Client(bridge().url) as client:
        client.play(bundle="desk.bundle", moving=[])
        with monkeypatch.context() as patched:
            patched.setattr(HapticSession, "update", lambda *_, **__: 1 / 0)
            client.socket.send(client.frame(1, 0.0, poses(), [ON_TABLE]))
            with pytest.raises(Refused, match="its log has the details"):
                client.hear(lambda one: one["type"] == "error")
            patched.setattr(HapticSession, "set_source", lambda *_, **__: 1 / 0)
            with pytest.raises(Refused, match="its log has the details"):
                client.ask("set_source", source="phone")
        assert "ZeroDivisionError" in caplog.text
        client.socket.send(client.frame(2, 0.1, poses(), [ON_TABLE]))
        assert client.next_gains().gains.max() > 0.0


def test_pause_is_kept_across_connections(bridge: Bridge) -> None:
    server = bridge()
    with Client(server.url) as client:
        client.play(bundle="desk.bundle", moving=[])
        session, key = client.order["session"], client.order["key"]
        client.ask("pause")
    with Client(server.url) as again:
        again.order, again.key = again.ask("resume", session=session, key=key), bytes.fromhex(key)
        again.socket.send(again.frame(1, 0.0, poses(), [ON_TABLE]))
        assert again.next_gains().gains.max() == 0.0
        again.ask("unpause")
        again.socket.send(again.frame(2, 0.1, poses(), [ON_TABLE]))
        assert again.next_gains().gains.max() > 0.0


def test_session_without_client_ends_after_a_timeout(bridge: Bridge) -> None:
    server = bridge()
    with Client(server.url) as watcher, Client(server.url) as again:
        with Client(server.url) as client:
            client.play(bundle="desk.bundle", keep_s=0.1)
            session, key = client.order["session"], client.order["key"]
            watcher.ask("watch", session=session)
        watcher.hear(lambda one: one["type"] == "state" and one["is"] == "ended")
        with pytest.raises(Refused, match="play` again") as refused:
            again.ask("resume", session=session, key=key)
        assert refused.value.kind == "UnknownSession"
        assert again.play(bundle="desk.bundle")["layout"] == 1


def test_frames_by_udp(bridge: Bridge) -> None:
    server = bridge(udp=True)
    with Client(server.url) as client, socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as datagrams:
        port = client.play(bundle="desk.bundle", moving=["phone"])["udp_port"]
        assert port == client.welcome["udp_port"]
        datagrams.settimeout(60)
        datagrams.sendto(b"S2HB not of any session", ("127.0.0.1", port))
        datagrams.sendto(client.frame(1, 0.0, poses("phone"), [ON_TABLE]), ("127.0.0.1", port))
        from bridge_frames import decode_gains

        found = decode_gains(datagrams.recv(1 << 16))
        assert found.sequence == 1
        assert found.gains[0, 0, 0] > 0.0
        datagrams.sendto(client.frame(2, 0.1, poses("phone"), [ON_TABLE])[:-1], ("127.0.0.1", port))
        with pytest.raises(Refused, match="must have 88"):
            client.hear(lambda one: one["type"] == "error")


def test_an_overtaken_datagram_does_not_replace_a_newer_frame(bridge: Bridge, monkeypatch: pytest.MonkeyPatch) -> None:
    server = bridge(udp=True)
    with Client(server.url) as client, socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as datagrams:
        port = client.play(bundle="desk.bundle", moving=[], session={"prepare": "blocking"})["udp_port"]
        datagrams.settimeout(60)
        entered, may_go_on = held_updates(monkeypatch)
        for sequence in (1, 3, 2, 3):
            datagrams.sendto(client.frame(sequence, sequence / 60, poses(), [ON_TABLE]), ("127.0.0.1", port))
            assert entered.wait(60)
        (connection,) = server.connections
        hosted = connection.client.hosted
        assert hosted is not None
        assert eventually(lambda: hosted.played.n_outdated == 2)
        may_go_on.set()
        from bridge_frames import decode_gains

        assert [decode_gains(datagrams.recv(1 << 16)).sequence for _ in range(2)] == [1, 3]
        assert client.ask("stats")["frames"] == {"received": 4, "skipped": 0, "outdated": 2}


class ClockedSink:
    """A sink that takes blocks of 10 ms on its own clock, like a sound card, and stores them."""

    def __init__(self) -> None:
        self.blocks: list[Block] = []
        self._ends = threading.Event()
        self.format: SinkFormat | None = None

    def open(self, format: SinkFormat) -> None:
        self.format = format
        self._ends.clear()

    def start(self, fill: Fill) -> None:
        def run() -> None:
            while not self._ends.wait(0.01):
                self.blocks.append(fill(480))

        self._worker = threading.Thread(target=run)
        self._worker.start()

    def stop(self) -> None:
        self._ends.set()
        self._worker.join()

    def close(self) -> None:
        pass

    @property
    def stats(self) -> SinkStats:
        return SinkStats(480 * len(self.blocks))


def test_the_server_s_sink_falls_silent_when_its_player_is_killed(bridge: Bridge) -> None:
    sink = ClockedSink()
    server = bridge(sink=sink)
    with Client(server.url) as client, Client(server.url) as other:
        with pytest.raises(Refused):
            client.play(bundle="desk.bundle", moving=["no such object"])  # it leaves the sink to others
        assert client.play(bundle="desk.bundle", moving=[])["sink"] == "ClockedSink"
        with pytest.raises(Refused, match="another session plays on the sink"):
            other.play(bundle="desk.bundle")
        other.play(bundle="desk.bundle", use_sink=False)
        for sequence in range(1, 1200):  # until the phone rings
            client.socket.send(client.frame(sequence, sequence / 60, poses(), [ON_TABLE]))
            time.sleep(1 / 60)
            if sink.blocks and np.abs(sink.blocks[-1]).max() > 0.01:
                break
        else:
            pytest.fail("the phone does not ring")
        counted = client.ask("stats")["sink"]
        assert counted["frames"] >= 480
        assert (counted["connected"], counted["latency_s"], counted["watchdog_trips"]) == (True, None, 0)
        assert other.ask("stats")["sink"] is None
        client.socket.socket.close()
        # The watchdog of a session fades out after 0.1 s; a busy machine may run it later.
        assert eventually(lambda: not any(block.any() for block in sink.blocks[-50:]))
        n_heard = len(sink.blocks)
        assert eventually(lambda: len(sink.blocks) > n_heard + 50)
        assert not any(block.any() for block in sink.blocks[n_heard:])
        # A session that waits for its player releases the sink to another session.
        other.ask("leave")
        assert other.play(bundle="desk.bundle")["sink"] == "ClockedSink"
