"""Invariants of sessions for any scene, any touch and any block size."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from edge_scenes import EDGE_SCENES, on_top_of
from scene2hap import AudioClip, Bands, Contact, HapticBundle, HapticLoop, HapticSession, Pose, SceneSnapshot, Touch
from scene2hap.audio.levels import threshold_db
from scenes import RATE, box, haptics, scene, table_with_two_phones, tone_loop

N_FRAMES = 4000
X = st.floats(0.0, 1.6)
EVENTS = st.lists(
    st.tuples(
        st.integers(0, N_FRAMES - 1),
        st.sampled_from(["left", "right"]),
        st.sampled_from(["table", "phone", "alarm", "cup"]),
        X,
        st.sampled_from([None, 0.0, 0.2]),
    ),
    max_size=8,
)


def new_session(bundle: tuple[SceneSnapshot, HapticBundle] | None = None, **config: object) -> HapticSession:
    return HapticSession(*(bundle or table_with_two_phones()), {"sample_rate_hz": RATE, **config})


def play(session: HapticSession, events: list[tuple], blocks: list[int]) -> np.ndarray:
    """Play with each update just before the block that holds its sample; touches end with the next event."""
    home = session.snapshot.object("phone").pose
    waiting = sorted(events, key=lambda event: event[0])
    parts: list[np.ndarray] = []
    done = 0
    while done < N_FRAMES:
        n = min(blocks[len(parts) % len(blocks)], N_FRAMES - done)
        while waiting and waiting[0][0] < done + n:
            at, hand, on, x, lift = waiting.pop(0)
            x0, y0, z0 = home.position_m
            moved = {} if lift is None else {"phone": Pose((x0, y0 + lift, z0))}
            session.update(moved, [Touch(hand, on, (x, 0.72, 0.4))], at_sample=at)
        parts.append(session.render(n))
        done += n
    return np.concatenate(parts)


@settings(max_examples=15)
@given(EVENTS, st.lists(st.integers(1, 4096), min_size=1, max_size=5))
def test_session_output_does_not_depend_on_block_size(events: list[tuple], blocks: list[int]) -> None:
    whole = play(new_session(), events, [N_FRAMES])
    np.testing.assert_allclose(play(new_session(), events, blocks), whole, atol=1e-6)


def test_single_samples_give_the_same_as_one_block() -> None:
    events = [(0, "left", "table", 0.3, None), (777, "right", "phone", 0.1, 0.2), (1500, "left", "table", 0.9, 0.0)]
    np.testing.assert_allclose(play(new_session(), events, [1]), play(new_session(), events, [N_FRAMES]), atol=1e-6)


@settings(max_examples=15)
@given(
    EVENTS,
    st.lists(st.floats(-200.0, 120.0), min_size=2, max_size=2),
    st.floats(-200.0, 120.0),
    st.sampled_from([None, 0.0, 20.0]),
    st.sampled_from([Bands.dominant(), Bands.third_octaves()]),
)
def test_every_sample_is_finite_and_within_full_scale(
    events: list[tuple], gains_db: list[float], user_db: float, limit_db: float | None, bands: Bands
) -> None:
    session = new_session(gain_limit_db=limit_db, bands=bands)
    for source, gain_db in zip(session.source_ids, gains_db, strict=True):
        session.set_source(source, gain_db=gain_db)
    session.set_user(gain_db=user_db)
    out = play(session, events, [512])
    assert out.dtype == np.float32
    assert np.isfinite(out).all()
    assert np.abs(out).max() <= 1.0


@settings(max_examples=15)
@given(EVENTS, st.sampled_from([Bands.dominant(), Bands.third_octaves()]))
def test_silence_in_silence_out(events: list[tuple], bands: Bands) -> None:
    snapshot, bundle = table_with_two_phones()
    silent = AudioClip(np.zeros(4000, dtype=np.float32), RATE)
    loops = {
        key: dict.fromkeys(states, HapticLoop(silent, silent, 100.0, 100.0)) for key, states in bundle.loops.items()
    }
    out = play(new_session((snapshot, replace(bundle, loops=loops)), bands=bands), events, [512])
    assert not out.any()


def play_edge(session: HapticSession, data: list[tuple[int, int, float]], blocks: list[int]) -> np.ndarray:
    """Touch one object after another with a hand, and lift it or put it back."""
    scene, parts, n = session.snapshot, [], 0
    for object_number, hand, lift in data:
        item = scene.objects[object_number % len(scene.objects)]
        x, y, z = item.pose.position_m
        session.update({item.id: Pose((x, y + lift, z))}, [Touch(session.hands[hand], item.id, on_top_of(item))])
        for _ in range(2):
            parts.append(session.render(blocks[n % len(blocks)]))
            n += 1
    return np.concatenate(parts)


@pytest.mark.parametrize("name", EDGE_SCENES)
@settings(max_examples=8)
@given(
    data=st.lists(
        st.tuples(st.integers(0, 59), st.integers(0, 1), st.sampled_from([0.0, 0.3])), min_size=1, max_size=6
    ),
    bands=st.sampled_from([Bands.dominant(), Bands.third_octaves()]),
)
def test_edge_scenes_stay_within_full_scale_and_lose_no_samples(
    name: str, data: list[tuple[int, int, float]], bands: Bands
) -> None:
    lean, whole = (new_session(EDGE_SCENES[name](), bands=bands, skip=skip, impacts=False) for skip in (True, False))
    outs = [play_edge(session, data, [256, 777]) for session in (lean, whole)]
    for out in outs:
        assert np.isfinite(out).all()
        assert np.abs(out).max() <= 1.0
    weights = 10 ** (-threshold_db(np.fft.rfftfreq(len(outs[0]), 1 / RATE)) / 20)
    felt = np.fft.irfft(np.fft.rfft(outs[0] - outs[1], axis=0) * weights[:, None], axis=0)
    assert np.abs(felt).max() <= 10 ** (-10 / 20) + 1e-6 * 10 ** (45 / 20) * 10
    if not lean.source_ids:
        assert not outs[0].any()


def rotation(axis: tuple[float, float, float], angle: float) -> Pose:
    x, y, z = np.array(axis) / np.linalg.norm(axis) * math.sin(angle / 2)
    return Pose((0, 0, 0), (x, y, z, math.cos(angle / 2)))


def stack() -> tuple[SceneSnapshot, HapticBundle]:
    """A source on a shelf on a table: two hops with contacts from an engine, so that only distances count."""
    from scene2hap import Contact

    objects = (
        box("table", (1.6, 0.02, 0.8), (0.8, 0.71, 0.4)),
        box("shelf", (0.6, 0.02, 0.3), (0.5, 0.73, 0.4)),
        box("phone", (0.1, 0.01, 0.1), (0.3, 0.745, 0.4)),
    )
    contacts = (Contact("phone", "shelf", (0.3, 0.74, 0.4)), Contact("shelf", "table", (0.7, 0.72, 0.5)))
    plain = scene(*objects)
    snapshot = SceneSnapshot("stack", "y", plain.objects, contacts)
    inferred = {
        "table": haptics("oak", (1.6, 0.8, 0.02)),
        "shelf": haptics("steel", (0.6, 0.3, 0.02)),
        "phone": haptics("glass", (0.1, 0.1, 0.01), "ringing"),
    }
    return snapshot, HapticBundle(snapshot, "room", inferred, {"phone": {"ringing": tone_loop(180)}})


@settings(max_examples=30)
@given(
    st.tuples(*[st.floats(-1, 1)] * 3).filter(lambda a: np.linalg.norm(a) > 0.1),
    st.floats(-math.pi, math.pi),
    st.tuples(*[st.floats(-20.0, 20.0)] * 3),
    st.tuples(X, st.floats(0.0, 0.8)),
)
def test_moving_scene_and_hands_together_changes_nothing(
    axis: tuple[float, float, float], angle: float, shift: tuple[float, float, float], at: tuple[float, float]
) -> None:
    snapshot, bundle = stack()
    motion = Pose(shift, rotation(axis, angle).rotation_xyzw)
    moved = {item.id: motion.compose(item.pose) for item in snapshot.objects}
    contacts = [
        replace(contact, point_m=tuple(motion.to_world(np.array(contact.point_m)).tolist()))
        for contact in snapshot.contacts or ()
    ]
    point = np.array([at[0], 0.72, at[1]])
    still, carried = new_session((snapshot, bundle)), new_session((snapshot, bundle))
    before = still.update(touches=[Touch("left", "table", tuple(point.tolist()))])
    after = carried.update(moved, [Touch("left", "table", tuple(motion.to_world(point).tolist()))], contacts=contacts)
    np.testing.assert_allclose(after.gains, before.gains, rtol=1e-5)
    assert before.gain("left", "phone") > 0.0


@settings(max_examples=15)
@given(st.floats(-math.pi, math.pi), st.tuples(*[st.floats(-20.0, 20.0)] * 3), X)
def test_geometric_contacts_are_invariant_under_common_motion(
    angle: float, shift: tuple[float, float, float], x: float
) -> None:
    # Rotation about the vertical only, since support depends on the direction of gravity.
    snapshot, _ = table_with_two_phones()
    motion = Pose(shift, rotation((0, 1, 0), angle).rotation_xyzw)
    moved = {item.id: motion.compose(item.pose) for item in snapshot.objects}
    point = np.array([x, 0.72, 0.4])
    before = new_session().update(touches=[Touch("left", "table", tuple(point.tolist()))])
    after = new_session().update(moved, [Touch("left", "table", tuple(motion.to_world(point).tolist()))])
    np.testing.assert_allclose(after.gains, before.gains, rtol=1e-4)
    assert before.gain("left", "phone") > 0.0


OBJECTS = [f"x{i}" for i in range(8)]
PLACES = st.tuples(*[st.floats(-0.2, 0.2)] * 3)


@st.composite
def rooms(draw: st.DrawFn) -> tuple[SceneSnapshot, HapticBundle]:
    """Eight objects of random materials, some in contact, with up to three tones on any of them."""
    pairs = draw(st.lists(st.tuples(*[st.integers(0, 7)] * 2).filter(lambda p: p[0] < p[1]), max_size=9, unique=True))
    contacts = tuple(
        Contact(OBJECTS[a], OBJECTS[b], draw(PLACES), weight=draw(st.sampled_from([0.0, 0.3, 1.0]))) for a, b in pairs
    )
    plain = scene(*(box(name, (0.4, 0.01, 0.4), (0.0, 0.0, 0.0)) for name in OBJECTS))
    snapshot = SceneSnapshot("room", "y", plain.objects, contacts)
    thing = st.sampled_from(["oak", "steel", "glass", "rubber", None])
    vibrating = draw(st.lists(st.sampled_from(OBJECTS), min_size=1, max_size=3, unique=True))
    inferred = {
        name: haptics(draw(thing), (0.4, 0.4, 0.01), *(["on"] if name in vibrating else [])) for name in OBJECTS
    }
    loops = {
        name: {"on": tone_loop(2 * draw(st.integers(10, 450)), 10 ** draw(st.floats(-4.0, -0.7)))} for name in vibrating
    }
    return snapshot, HapticBundle(snapshot, "room", inferred, loops)


@settings(max_examples=15)
@given(
    rooms(),
    st.lists(st.lists(st.tuples(st.sampled_from(OBJECTS), PLACES), max_size=3), min_size=1, max_size=4),
    st.sampled_from(["exponential_plate", "infinite_plate"]),
    st.sampled_from([Bands.dominant(), Bands.third_octaves(10, 1000)]),
)
def test_skipped_sources_are_10_db_below_the_threshold_of_touch(
    room: tuple[SceneSnapshot, HapticBundle], steps: list[list[tuple]], kind: str, bands: Bands
) -> None:
    model = {"kind": kind, "outside_domain": "ignore"}
    lean, whole = (
        new_session(room, skip=skip, propagation=model, bands=bands, prepare="blocking") for skip in (True, False)
    )
    weights = 10 ** (-threshold_db(np.fft.rfftfreq(RATE // 2, 1 / RATE)) / 20)
    for n, step in enumerate(steps):
        touches = [Touch(("left", "right")[i % 2], name, point) for i, (name, point) in enumerate(step)]
        contacts = list((room[0].contacts or ())[n:])
        for _ in range(2):
            frames = [s.update(touches=touches, contacts=contacts) for s in (lean, whole)]
        # With skipping, a coupled model may solve in another order.
        np.testing.assert_allclose(frames[0].gains, frames[1].gains, rtol=1e-5, atol=1e-9)
        for s in (lean, whole):
            s.render(RATE // 4)
        lost = lean.render(RATE // 2) - whole.render(RATE // 2)
        felt = np.fft.irfft(np.fft.rfft(lost, axis=0) * weights[:, None], axis=0)
        # In units of the threshold. The second term is single-precision rounding: 1e-6 of full scale at -45 dB.
        assert np.abs(felt).max() <= 10 ** (-10 / 20) + 1e-6 * 10 ** (45 / 20) * 10
