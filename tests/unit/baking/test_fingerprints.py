"""`rebake` rebuilds loops whose inputs have changed, and reports them."""

import json
import warnings
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import soundfile

from scene2hap import AudioClip, BakeConfig, Credit, HapticBundle, SceneSnapshot, VibrationDescription, bake, rebake
from scene2hap.audio.actuators import ACTUATORS
from scene2hap.audio.levels import felt_level_db
from scene2hap.audio.protocol import ConversionContext
from scene2hap.audio.scene_loops import Plan
from scene2hap.audio.sources.synth import Synthesizer
from scene2hap.audio.tactile.adaptive import Adaptive
from scene2hap.audio.tactile.stages import StageStream
from scene2hap.baking import fingerprint
from scene2hap.baking.fingerprint import converter_settings, made_by, request_digests
from scene2hap.bundle import BundleWarning
from scene2hap.errors import BundleError, ConfigError
from scenes import box, scene, tone_loop

# Some scenes here have a distant table, or no sources.
pytestmark = [pytest.mark.filterwarnings("ignore::scene2hap.SceneWarning"), pytest.mark.usefixtures("short_tones")]

NAMES = ("desk_fan", "microwave_oven", "refrigerator")  # the last two hum at 100 Hz, and are moved apart
RATE = 8000


def room(*names: str) -> SceneSnapshot:
    things = [box(name, (0.4, 0.3, 0.4), (2.0 * i, 0.15, 0.0)) for i, name in enumerate(names)]
    return scene(box("wooden_table", (1.2, 0.05, 0.8), (-3.0, 0.7, 0.0)), *things)


ROOM = room(*NAMES)


def own_tone(frequency_hz: float = 155.0) -> AudioClip:
    t = np.arange(4 * RATE) / RATE
    return AudioClip((0.5 * np.sin(2 * np.pi * frequency_hz * t)).astype(np.float32), RATE, Credit("mine", "me", "CC0"))


class Recordings:
    """A sound source with one clip for every description; counts its queries."""

    def __init__(self, clip: AudioClip) -> None:
        self.clip, self.n_asked = clip, 0

    def find(self, description: VibrationDescription) -> list[AudioClip]:
        self.n_asked += 1
        return [self.clip]


class Hums:
    """A sound source with a short hum for each machine, of which two are equally high."""

    def find(self, description: VibrationDescription) -> list[AudioClip]:
        t, rng = np.arange(3 * RATE) / RATE, np.random.default_rng(description.seed)
        pitch_hz = {"desk_fan": 45.0, "fan": 45.0}.get(description.object_category, 100.0)
        x = 0.4 * np.sin(2 * np.pi * pitch_hz * t) + 0.02 * rng.standard_normal(len(t))
        credit = Credit(description.object_category, "hums", "CC0", query=description.keywords)
        return [AudioClip(x.astype(np.float32), RATE, credit)]


HUMS: dict[str, Any] = {"audio": Hums()}


@pytest.fixture(scope="module")
def bundle() -> HapticBundle:
    return bake(ROOM, HUMS)


def felt(bundle: HapticBundle) -> dict[str, float]:
    return {key: loop.frequency_tactile_hz for key, states in bundle.loops.items() for loop in states.values()}


def assert_same_loops(one: HapticBundle, other: HapticBundle) -> None:
    assert {key: list(states) for key, states in one.loops.items()} == {k: list(s) for k, s in other.loops.items()}
    for key, states in one.loops.items():
        for state, loop in states.items():
            for kind in ("audible", "tactile"):
                mine, theirs = getattr(loop, kind), getattr(other.loops[key][state], kind)
                np.testing.assert_array_equal(mine.samples, theirs.samples, err_msg=f"{key} {state} {kind}")
            assert loop.audible.credit == other.loops[key][state].audible.credit
            assert loop.fingerprint == other.loops[key][state].fingerprint


def remade(bundle: HapticBundle, config: Any = None, **more: Any) -> tuple[HapticBundle, Mapping[str, Any]]:
    told: list[Any] = []
    again = rebake(bundle, config, on_remade=told.append, **more)
    return again, told[0]


@pytest.mark.parametrize("settings", [{"actuator": "lra"}, {"tactile": "svf_bandpass"}, {"spread": {"octaves": 0.0}}])
def test_changed_settings_rebuild_the_same_sounds_as_a_bake(bundle: HapticBundle, settings: dict[str, Any]) -> None:
    again, told = remade(bundle, settings)
    assert told
    assert_same_loops(again, bake(ROOM, settings | HUMS))


@pytest.mark.parametrize(
    ("settings", "why"), [({"actuator": "lra"}, "actuator"), ({"tactile": "lowpass"}, "converter")]
)
def test_changed_setting_rebuilds_every_source_with_a_reason(
    bundle: HapticBundle, settings: dict[str, Any], why: str
) -> None:
    lines: list[str] = []

    def tell(stage: str, what: str, done: int, total: int) -> None:
        lines.append(f"{stage}: {what}")

    again, told = remade(bundle.override("desk_fan", clip=own_tone()), settings, progress=tell)
    assert set(told) == set(bundle.loops) == set(NAMES)
    for name in NAMES[1:]:
        assert list(told[name].values()) == [(why,)]
        assert f"touch: {name} ({why})" in lines
    assert len({loop.fingerprint[why] for states in again.loops.values() for loop in states.values()}) == 1


def test_unchanged_settings_rebuild_nothing(bundle: HapticBundle, tmp_path: Path) -> None:
    loaded = HapticBundle.load(bundle.save(tmp_path / "b"))
    for before in (bundle, loaded):
        again, told = remade(before)
        assert told == {}
        assert all(again.loops[key] is before.loops[key] for key in before.loops)
    assert all(loop.fingerprint for states in loaded.loops.values() for loop in states.values())


def test_missing_settings_default_to_those_of_the_bundle(tmp_path: Path) -> None:
    settings = {"actuator": "lra", "tactile": {"kind": "adaptive", "q": 3.0}, "seed": 4, "spread": {"level_db": 0.0}}
    loaded = HapticBundle.load(bake(ROOM, settings | HUMS).save(tmp_path / "b"))
    assert loaded.actuator == ACTUATORS["lra"]
    assert remade(loaded)[1] == {}
    assert remade(loaded, settings)[1] == {}
    again, told = remade(loaded, {"actuator": "flat"})
    assert set(told) == set(NAMES)
    assert again.made_with is not None
    assert again.made_with.tactile == {"kind": "adaptive", "q": 3.0, "shift_octaves": pytest.approx(1 / 3)}
    assert_same_loops(again, bake(ROOM, settings | HUMS | {"actuator": "flat"}))


def test_an_edited_intensity_is_felt_after_baking_again(tmp_path: Path) -> None:
    bundle = bake(ROOM, {"spread": {"octaves": 0.0, "level_db": 0.0}})
    folder = bundle.save(tmp_path / "b")
    objects = json.loads((folder / "objects.json").read_text())
    (state,) = objects["desk_fan"]["states"]
    before_db = asked_db(bundle, "desk_fan")
    state["intensity"] /= 2
    (folder / "objects.json").write_text(json.dumps(objects))
    again, told = remade(HapticBundle.load(folder))
    assert told["desk_fan"][state["name"]] == ("intensity",)
    assert set(told) == {"desk_fan"}
    assert level_db(again, "desk_fan") == pytest.approx(before_db - 17.0 * np.log10(2.0), abs=0.1)
    assert level_db(bundle, "desk_fan") > level_db(again, "desk_fan") + 3.0
    assert again.loops["desk_fan"][state["name"]].audible.credit.origin == "synth"


def test_an_edit_of_a_loop_by_hand_is_kept_by_a_lock_and_else_lost_with_a_warning(tmp_path: Path) -> None:
    folder = bake(ROOM).save(tmp_path / "b")
    file = folder / "sounds" / "desk_fan.on.tactile.wav"
    samples, rate = soundfile.read(file)
    soundfile.write(file, samples / 2, rate, subtype="PCM_24")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        edited = HapticBundle.load(rebake(folder).save(folder))  # nothing has changed, so nothing is made again
        assert edited.loops["desk_fan"]["on"].tactile.samples == pytest.approx(samples / 2, abs=2**-23)
        locked = rebake(edited.override("desk_fan", locked=True), {"seed": 7})
        assert locked.loops["desk_fan"] is edited.loops["desk_fan"]
    with pytest.warns(
        BundleWarning, match="edited by hand are made again or removed, and the edits are lost: desk_fan"
    ):
        again = rebake(edited.override("desk_fan", intensity=0.123))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        rebake(again.override("desk_fan", intensity=0.2))


@pytest.mark.parametrize("kind", ["tactile", "audible"])
def test_a_new_bake_keeps_loops_that_were_edited_by_hand_or_warns(tmp_path: Path, kind: str) -> None:
    edited = bundle_with_halved_fan(tmp_path / "b", kind)
    with warnings.catch_warnings():
        warnings.simplefilter("error", BundleWarning)
        again = bake(ROOM, earlier=edited)
    assert getattr(again.loops["desk_fan"]["on"], kind) == getattr(edited.loops["desk_fan"]["on"], kind)
    assert_same_loops(
        replace(again, loops={**again.loops, "desk_fan": {}}), replace(edited, loops={**edited.loops, "desk_fan": {}})
    )
    lost = "edited by hand are made again or removed, and the edits are lost: desk_fan"
    with pytest.warns(BundleWarning, match=lost):
        bake(ROOM, HUMS, earlier=edited)
    without = replace(ROOM, objects=tuple(item for item in ROOM.objects if item.id != "desk_fan"))
    with pytest.warns(BundleWarning, match=lost):
        bake(without, earlier=edited)


def test_an_edit_of_a_loop_by_hand_outlives_changes_of_other_sources(tmp_path: Path) -> None:
    edited = bundle_with_halved_fan(tmp_path / "b", "tactile")
    others = edited.override("microwave_oven", pitch_hz=felt(edited)["desk_fan"])
    with warnings.catch_warnings():
        warnings.simplefilter("error", BundleWarning)
        again, told = remade(others)
    assert "desk_fan" not in told
    assert again.loops["desk_fan"]["on"].tactile == edited.loops["desk_fan"]["on"].tactile
    assert again.loops["desk_fan"]["on"].fingerprint["plan"] != edited.loops["desk_fan"]["on"].fingerprint["plan"]
    with pytest.warns(BundleWarning, match="edits are lost: desk_fan"):
        rebake(edited.override("desk_fan", pitch_hz=130.0))


def test_a_reset_takes_back_an_edit_of_a_loop_by_hand(tmp_path: Path) -> None:
    made = bake(ROOM)
    reset = bundle_with_halved_fan(tmp_path / "b", "tactile").reset("desk_fan")
    loaded = HapticBundle.load(reset.save(tmp_path / "c"))
    with warnings.catch_warnings():
        warnings.simplefilter("error", BundleWarning)
        again, told = remade(loaded)
    assert told == {"desk_fan": {"on": ("sound",)}}
    assert_same_loops(again, made)
    assert made.reset("desk_fan") == made


def test_an_edit_of_a_loop_by_hand_outlives_a_row_that_is_removed(tmp_path: Path) -> None:
    edited = bundle_with_halved_fan(tmp_path / "b", "tactile").override("desk_fan", gain_db=-3.0, mass_kg=2.0)
    folder = edited.save(tmp_path / "c")
    (folder / "overrides.json").write_text("{}")
    again, told = remade(HapticBundle.load(folder))
    assert told == {}
    assert again.objects["desk_fan"].mass_kg != 2.0
    assert again.loops["desk_fan"]["on"].tactile == edited.loops["desk_fan"]["on"].tactile


def bundle_with_halved_fan(folder: Path, kind: str) -> HapticBundle:
    """Bake the room, and halve the amplitude of a loop of the fan by hand."""
    file = bake(ROOM).save(folder) / "sounds" / f"desk_fan.on.{kind}.wav"
    samples, rate = soundfile.read(file)
    soundfile.write(file, samples / 2, rate, subtype="PCM_24")
    return HapticBundle.load(folder)


def asked_db(bundle: HapticBundle, object_id: str) -> float:
    (loop,) = bundle.loops[object_id].values()
    assert loop.felt is not None
    return loop.felt.asked_level_db


def level_db(bundle: HapticBundle, object_id: str) -> float:
    (loop,) = bundle.loops[object_id].values()
    return felt_level_db(loop.tactile.samples, loop.tactile.sample_rate_hz)


def test_edited_keywords_select_another_sound(bundle: HapticBundle, tmp_path: Path) -> None:
    folder = bundle.save(tmp_path / "b")
    objects = json.loads((folder / "objects.json").read_text())
    objects["desk_fan"]["states"][0]["keywords"] = "telephone ringing"
    (folder / "objects.json").write_text(json.dumps(objects))
    again, told = remade(HapticBundle.load(folder))
    (loop,) = again.loops["desk_fan"].values()
    assert loop.audible.credit.query == "telephone ringing"
    assert all(why[0] == "sound" for why in told["desk_fan"].values())


def test_another_seed_is_another_request_for_a_sound() -> None:
    asked = VibrationDescription("fan", "on", "fan humming", "fan humming", 0.5, (0.3, 0.3, 0.3), seed=1)
    one, other = (request_digests(each, BakeConfig()) for each in (asked, replace(asked, seed=2)))
    assert one["words"] != other["words"]
    assert one["sources"] == other["sources"]


def test_sound_sources_are_queried_only_when_given(bundle: HapticBundle) -> None:
    source = Recordings(own_tone(90.0))
    again, told = remade(bundle, {"audio": source})
    assert source.n_asked == len(NAMES) == len(told)
    assert remade(again)[1] == {}
    assert "sound" in remade(again, objects=["desk_fan"])[1]["desk_fan"]["on"]
    assert {loop.audible.credit.title for states in again.loops.values() for loop in states.values()} == {"mine"}
    assert remade(again, {"audio": source})[1] == {}
    assert source.n_asked == len(NAMES)


def test_a_new_bake_takes_locked_loops_from_the_bundle_before(bundle: HapticBundle) -> None:
    locked = bundle.override("desk_fan", locked=True).overrides
    again = bake(ROOM, {"audio": Recordings(own_tone(90.0))}, overrides=locked, earlier=bundle)
    assert again.loops["desk_fan"] == bundle.loops["desk_fan"]
    assert {again.loops[key]["on"].audible.credit.title for key in NAMES[1:]} == {"mine"}


def test_user_clip_keeps_its_pitch_and_others_are_moved_away(bundle: HapticBundle, tmp_path: Path) -> None:
    # The fan's neighbour hums at 100 Hz, so that a selected recording of 101 Hz would be moved.
    wished = bundle.override("desk_fan", clip=own_tone(101.0))
    again, told = remade(wished)
    assert felt(again)["desk_fan"] == pytest.approx(101.0, abs=0.2)
    assert again.loops["desk_fan"]["on"].source is None  # the override has the clip
    assert abs(np.log2(felt(again)["microwave_oven"] / 101.0)) > 0.1
    assert told["microwave_oven"]
    kept = HapticBundle.load(wished.save(tmp_path / "b")).overrides
    assert_same_loops(again, bake(ROOM, HUMS, overrides=wished.overrides))
    assert felt(bake(ROOM, HUMS, overrides=kept)) == pytest.approx(felt(again), abs=0.01)


def test_user_clip_can_be_moved_on_request(bundle: HapticBundle, tmp_path: Path) -> None:
    wished = bundle.override("desk_fan", clip=own_tone(101.0), keep=False)
    loaded = HapticBundle.load(wished.save(tmp_path / "b"))
    assert loaded.overrides["desk_fan"].keep is False
    again = rebake(loaded)
    assert_same_loops(again, bake(ROOM, HUMS, overrides=loaded.overrides))
    frequencies = felt(again)
    assert min(abs(np.log2(frequencies["desk_fan"] / frequencies[name])) for name in NAMES[1:]) > 0.1
    assert remade(again)[1] == {}
    kept, told = remade(again.override("desk_fan", keep=True))
    assert "desk_fan" in told
    assert felt(kept)["desk_fan"] == pytest.approx(101.0, abs=0.2)


def test_removed_override_restores_the_selected_sound(bundle: HapticBundle, tmp_path: Path) -> None:
    folder = rebake(bundle.override("desk_fan", clip=own_tone())).save(tmp_path / "b")
    (folder / "overrides.json").write_text("{}")
    again, told = remade(HapticBundle.load(folder), HUMS)
    assert list(told["desk_fan"].values()) == [("sound",)]
    assert_same_loops(again, bundle)


def test_audible_loop_replaces_a_missing_source_clip(bundle: HapticBundle) -> None:
    bare = {
        key: {name: replace(loop, source=None) for name, loop in states.items()} for key, states in bundle.loops.items()
    }
    again, told = remade(replace(bundle, loops=bare))
    assert set(told) == set(NAMES)
    for key, states in again.loops.items():
        for name, loop in states.items():
            assert loop.audible.credit == bundle.loops[key][name].audible.credit
            assert loop.frequency_raw_hz == pytest.approx(bundle.loops[key][name].frequency_raw_hz, rel=0.01)
    assert remade(again)[1] == {}


def test_sources_stay_clear_of_a_locked_loop(bundle: HapticBundle) -> None:
    assert remade(bundle.override("microwave_oven", locked=True))[1] == {}


def test_locked_loops_of_another_actuator_are_named(bundle: HapticBundle) -> None:
    """In an earlier version a bundle for another actuator kept them without a word, at a wrong level."""
    locked = bundle.override("desk_fan", locked=True)
    with pytest.warns(BundleWarning, match="another actuator than 'lra': 'desk_fan'. They may be felt too"):
        again = rebake(locked, {"actuator": "lra"})
    assert again.loops["desk_fan"] == bundle.loops["desk_fan"]
    with warnings.catch_warnings(action="error"):
        rebake(again.override("desk_fan", gain_db=-3.0))  # nothing is made, so nothing is said again


def test_only_a_loop_without_a_target_depends_on_its_neighbours() -> None:
    def plan_name(target_hz: float | None, neighbour_hz: float) -> str:
        context = ConversionContext(neighbours_hz=(neighbour_hz,), target_hz=target_hz)
        return made_by(own_tone(), "", Plan(context, 0.0))["plan"]

    assert plan_name(None, 100.0) != plan_name(None, 101.0)
    assert plan_name(80.0, 100.0) == plan_name(80.0, 101.0)


def without_fingerprints(folder: Path) -> Path:
    """Rewrite a folder like those of earlier versions, without fingerprints and settings."""
    rows = json.loads((folder / "loops.json").read_text())
    for states in rows.values():
        for row in states.values():
            del row["fingerprint"], row["source"]
    (folder / "loops.json").write_text(json.dumps(rows))
    manifest = json.loads((folder / "bundle.json").read_text())
    del manifest["made_with"]
    (folder / "bundle.json").write_text(json.dumps(manifest))
    return folder


def test_bundle_without_fingerprints_is_kept_until_a_setting_changes(bundle: HapticBundle, tmp_path: Path) -> None:
    old = HapticBundle.load(without_fingerprints(bundle.save(tmp_path / "b")))
    assert old.actuator is None
    with pytest.warns(UserWarning, match="3 sources .* stay as they are"):
        again, told = remade(old)
    assert told == {}
    assert again.loops == old.loops
    assert again.actuator is None  # nothing says with what its loops were made
    again, told = remade(old, {"actuator": "lra"})
    assert set(told) == set(NAMES)
    assert {why for states in told.values() for why in states.values()} == {("no fingerprint",)}
    assert again.actuator is not None
    assert again.actuator.name == "lra"
    for key, states in again.loops.items():
        for state, loop in states.items():
            assert loop.audible.credit == old.loops[key][state].audible.credit
            assert loop.frequency_raw_hz == pytest.approx(old.loops[key][state].frequency_raw_hz, rel=0.01)
    assert remade(again)[1] == {}


def test_handmade_loops_can_be_converted_again(bundle: HapticBundle) -> None:
    by_hand = HapticBundle(
        bundle.snapshot, "room", bundle.objects, {"desk_fan": {"on": tone_loop(120.0, seconds=0.05)}}
    )
    again = rebake(by_hand, {"actuator": "flat", "tactile": "lowpass"})
    loop = next(iter(again.loops["desk_fan"].values()))
    assert loop.frequency_raw_hz == pytest.approx(120.0, abs=1.0)


def test_settings_of_a_built_in_converter_are_told_without_reading_installed_packages(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """That takes some 10 ms, several times in each bake."""
    monkeypatch.setattr(fingerprint, "entry_points", lambda **_: pytest.fail("read"))
    assert converter_settings(Adaptive(q=3.0))["kind"] == "adaptive"


class InstalledPlugin:
    """A converter object without a registered kind."""

    def stream(self, sample_rate_hz: int, context: ConversionContext) -> StageStream:
        return Adaptive().stream(sample_rate_hz, context)


def test_converter_object_must_be_given_again() -> None:
    baked = bake(room("desk_fan"), {"tactile": InstalledPlugin()})
    with pytest.raises(ConfigError, match="test_fingerprints:InstalledPlugin"):
        rebake(baked)
    assert remade(baked, {"tactile": InstalledPlugin()})[1] == {}


@pytest.mark.parametrize(
    "damage", [3, [], {"tactile": {}}, {"actuator": {"q": -1}, "tactile": {}, "spread": {}, "seed": 0}]
)
def test_invalid_settings_of_a_bundle_are_refused(bundle: HapticBundle, tmp_path: Path, damage: object) -> None:
    folder = bundle.save(tmp_path / "b")
    manifest = json.loads((folder / "bundle.json").read_text())
    (folder / "bundle.json").write_text(json.dumps(manifest | {"made_with": damage}))
    with pytest.raises(BundleError, match="made_with"):
        HapticBundle.load(folder)


def test_rebake_of_a_scene_without_sources_works() -> None:
    silent = bake(scene(box("wooden_table", (1.2, 0.05, 0.8), (0.0, 0.7, 0.0))))
    again, told = remade(silent, {"actuator": "lra"})
    assert (again.loops, told) == ({}, {})
    assert again.actuator is not None
    assert again.actuator.name == "lra"


def test_copies_are_synthesized_once(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[VibrationDescription] = []
    find = Synthesizer.find
    monkeypatch.setattr(Synthesizer, "find", lambda self, wanted: [asked.append(wanted), find(self, wanted)][1])
    baked = bake(room(*(f"desk_fan_{i}" for i in range(8))))
    assert len(baked.loops) == 8
    assert len(asked) == 1
    loops = [loop for states in baked.loops.values() for loop in states.values()]
    assert len({id(loop.tactile) for loop in loops}) == 1


@pytest.mark.filterwarnings("ignore::scene2hap.audio.loops.LoopWarning")  # no seam would be sought there
def test_a_marked_loop_is_the_loop_and_stays_it_in_the_bundle(tmp_path: Path) -> None:
    x = own_tone().samples
    marked = AudioClip(x, RATE, Credit("mine", "me", "CC0"), loop=(4100, 12_000))
    sounds = {"audio": Recordings(marked)}
    for bundle in (bake(ROOM, sounds), rebake(bake(ROOM).override("desk_fan", clip=marked))):
        loaded = HapticBundle.load(bundle.save(tmp_path / "b"))
        audible = loaded.loops["desk_fan"]["on"].audible.samples
        assert audible == pytest.approx(x[4100:12_000] * audible.max() / x.max(), abs=1e-5)
        assert remade(loaded)[1] == {}
        assert {key: dict(states) for key, states in loaded.loops.items()} == {
            k: dict(s) for k, s in bundle.loops.items()
        }
        assert loaded.overrides == bundle.overrides
    again = rebake(HapticBundle.load(bake(ROOM, sounds).save(tmp_path / "c")), {"actuator": "lra"})
    assert_same_loops(again, bake(ROOM, sounds | {"actuator": "lra"}))
    other = replace(marked, loop=(4000, 12_000))
    assert set(remade(loaded.override("desk_fan", clip=other))[1]["desk_fan"]) == {"on"}
