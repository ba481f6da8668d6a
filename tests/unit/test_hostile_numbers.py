"""Invalid numbers and arrays given to public names are refused with an error of the library that names the argument."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from scene2hap import (
    ActuatorProfile,
    AudioClip,
    BakeConfig,
    Bands,
    Contact,
    ConversionContext,
    ExponentialPlate,
    HapticSession,
    LocalBackend,
    Material,
    ModalPlate,
    Plate,
    Pose,
    PoseTable,
    SceneSnapshot,
    SessionConfig,
    SoundCardSink,
    SourceState,
    Touch,
    TriMesh,
    UserProfile,
    load_scene,
    plate_modes,
)
from scene2hap.bundle import Override
from scene2hap.devices.vhp_amp import VhpSink
from scene2hap.errors import Scene2HapError
from scenes import table_with_two_phones

OAK = Material("oak", 700.0, 1e10, 0.3)


class Raising(float):
    """A number whose conversion raises."""

    def __float__(self) -> float:
        raise ZeroDivisionError("no number")


class NoSequence:
    """A sequence whose iteration raises."""

    def __iter__(self) -> Any:
        raise RuntimeError("no sequence")


def plate(**fields: Any) -> Plate:
    return Plate(**{"length_m": 1.0, "width_m": 0.5, "thickness_m": 0.02, "material": OAK, **fields})


def playing(act: Callable[[HapticSession], object]) -> object:
    return act(HapticSession(*table_with_two_phones(), {"prepare": "blocking"}))


# A numpy value that cannot be compared with text.
VOID: Any = np.void(b"abc")
HUGE: Any = 10**5000
REFUSED: dict[str, Callable[[], object]] = {
    "a sample of 5000 digits": lambda: playing(lambda session: session.update({}, [], at_sample=HUGE)),
    "a hand that is removed": lambda: playing(lambda session: session.remove_hand(VOID)),
    "a hand that is explained": lambda: playing(lambda session: session.explain(VOID)),
    "an object that is removed": lambda: playing(lambda session: session.remove(VOID)),
    "a touch of an array": lambda: playing(lambda session: session.update({}, [Touch("left", VOID, (0, 0, 0))])),
    "channels of 5000 digits": lambda: SoundCardSink(channels=[HUGE]),
    "a block of 5000 digits": lambda: SoundCardSink(block_frames=HUGE),
    "a board of 5000 digits": lambda: VhpSink("port", board=HUGE),
    "a board of numpy": lambda: VhpSink("port", board=VOID),
    "a material of 5000 digits": lambda: Override(material=HUGE),
    "an up axis of 5000 digits": lambda: load_scene("room.glb", up_axis=HUGE),
    "an axis of numpy": lambda: load_scene("room.glb", up_axis=VOID),
    "a number that raises": lambda: Pose((Raising(1.0), 0, 0)),
    "a number of 5000 digits as a vector": lambda: Pose(10**5000),
    "a number of 5000 digits as a name": lambda: Material(10**5000, 1.0, 1.0, 0.3),
    "a vector without end": lambda: Pose(range(10**18)),
    "a vector that raises": lambda: Pose(NoSequence()),
    "points of texts": lambda: Pose().to_world(["x", "y", "z"]),
    "ragged points": lambda: Pose().to_own([[0.0, 1.0, 2.0], [0.0]]),
    "points of huge numbers": lambda: Pose().to_world([10**400, 0, 0]),
    "complex points": lambda: Pose().to_world(np.array([1j, 0, 0])),
    "masked points": lambda: Pose().to_world(np.ma.masked_all((2, 3))),
    "points of two numbers": lambda: Pose().to_world([[0.0, 1.0]]),
    "a matrix of one number": lambda: Pose.from_matrix(1.0),
    "a matrix that is too large": lambda: Pose.from_matrix(np.eye(4) * 1e308),
    "vertices of huge numbers": lambda: TriMesh([[10**400, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]),
    "dates as vertices": lambda: TriMesh(np.zeros((3, 3), "M8[s]"), [[0, 1, 2]]),
    "poses of huge numbers": lambda: PoseTable(["a"], [[10**400, 0, 0]], [[0, 0, 0, 1]]),
    "flags as samples": lambda: AudioClip(np.array([True, False]), 48_000),
    "flags as vertices": lambda: TriMesh(np.eye(3, dtype=bool), [[0, 1, 2]]),
    "a flag as a level": lambda: UserProfile(gain_db=True),
    "a flag of NumPy as a limit": lambda: UserProfile(max_amplitude=np.True_),
    "a flag as the level of a hand": lambda: UserProfile(hands={"left": {"gain_db": False}}),
    "a flag in a curve": lambda: UserProfile(curve_db=[(60, True), (70, 1)]),
    "a flag as a time": lambda: SessionConfig(watchdog_s=True),
    "a flag as a limit or none": lambda: SessionConfig.parse({"gain_limit_db": False}),
    "a flag as a count": lambda: BakeConfig.parse({"concurrency": True}),
    "samples of texts": lambda: AudioClip(np.array(["a"]), 48_000),
    "masked samples": lambda: AudioClip(np.ma.masked_all(9), 48_000),
    "complex samples": lambda: AudioClip(np.array([1.0, 2.0j]), 48_000),
    "an id that is a list": lambda: playing(lambda session: session.snapshot.object([])),
    "a contact of numbers": lambda: Contact(1, 2, (0, 0, 0)),
    "an axis of 5000 digits": lambda: SceneSnapshot("a", 10**5000, ()),
    "a plate thicker than the earth": lambda: plate(thickness_m=1e200),
    "a plate thinner than anything": lambda: plate(thickness_m=1e-320),
    "edges that are no text": lambda: plate(boundary=[]),
    "frequencies of texts": lambda: plate().wavenumber_rad_m(["x"]),
    "a frequency beyond any": lambda: plate().wavenumber_rad_m(1e308),
    "modes up to a frequency beyond any": lambda: plate_modes(plate(), max_frequency_hz=1e308),
    "points of dicts": lambda: ModalPlate().plate_transfer(plate(), (0.1, 0.1), [{}], [100.0]),
    "hops of texts": lambda: ExponentialPlate(max_hops="x"),
    "hops that are not a number": lambda: ExponentialPlate(max_hops=float("nan")),
    "bands from almost nothing": lambda: Bands.third_octaves(1e-320, 1000.0),
    "a response that is a number": lambda: ActuatorProfile(response_db=1.0),
    "neighbours that are a number": lambda: ConversionContext(neighbours_hz=1.0),
    "a need that is a number": lambda: SourceState("on", 0.5, "", "", 1.0),
    "settings that are a number": lambda: SessionConfig.parse(1.0),
    "an address that is a number": lambda: LocalBackend("m", base_url=1.0),
    "an address without its bracket": lambda: LocalBackend("m", base_url="http://[::1"),
    "frames below 0": lambda: playing(lambda session: session.render(-1)),
    "frames beyond any": lambda: playing(lambda session: session.render(10**12)),
    "frames that are a text": lambda: playing(lambda session: session.render("x")),
    "a sample that is not a number": lambda: playing(lambda session: session.update(at_sample=float("nan"))),
    "a time that is not a number": lambda: playing(lambda session: session.wait_prepared(float("nan"))),
    "a source that is a list": lambda: playing(lambda session: session.set_source([], on=True)),
    "a state that is a list": lambda: playing(lambda session: session.set_source("phone", state=[])),
    "touches that raise": lambda: playing(lambda session: session.update({}, NoSequence())),
}


@pytest.mark.parametrize("case", REFUSED)
def test_hostile_number_is_refused_with_a_message(case: str) -> None:
    with pytest.raises(Scene2HapError) as caught:
        REFUSED[case]()
    assert 20 < len(str(caught.value)) < 2000


def test_flags_stay_settings_where_they_are_meant() -> None:
    assert SessionConfig(skip={"unreachable": False}).skip.unreachable is False
    assert UserProfile(gain_db=1, curve_db=[(60, 1), (70, np.float32(2.5))]).curve_db == ((60.0, 1.0), (70.0, 2.5))


def test_arrays_in_any_order_of_bytes_and_rows_are_taken() -> None:
    points = np.arange(12.0).reshape(4, 3)
    read_only = points.copy()
    read_only.setflags(write=False)
    for other in (
        np.asfortranarray(points),
        points.astype(">f8"),
        points.astype(np.float32),
        read_only,
        points.tolist(),
    ):
        np.testing.assert_array_equal(Pose((1, 2, 3)).to_world(other), np.add(points, [1, 2, 3]))


def test_a_contact_of_almost_no_weight_carries_nothing() -> None:
    assert Contact("a", "b", (0, 0, 0), weight=1e-320).weight == 0.0
