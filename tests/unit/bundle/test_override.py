"""User overrides of inferred values."""

import json
import warnings
from pathlib import Path

import numpy as np
import pytest

from scene2hap import AudioClip, Credit, HapticBundle, HapticSession, Material, SceneWarning, Touch, materials
from scene2hap.audio.encoding import encoded
from scene2hap.bundle import BundleWarning, Override
from scene2hap.errors import AudioError, BundleError, MaterialError, UnknownMaterial, UnknownObject
from scenes import RATE, table_with_two_phones


@pytest.fixture
def bundle() -> HapticBundle:
    return table_with_two_phones()[1]


def test_silencing_override_removes_the_loops(bundle: HapticBundle) -> None:
    source, other = bundle.loops
    quiet = bundle.override(source, vibrates=False)
    assert list(quiet.loops) == [other]
    assert not quiet.objects[source].vibrates
    assert quiet.objects[source].states == ()
    assert quiet.objects[source].provenance["vibrates"] == "user"
    assert bundle.objects[source].vibrates


def test_state_override_is_the_state_that_a_session_begins_with(bundle: HapticBundle) -> None:
    changed = bundle.override("phone", state="alarm")
    assert [state.name for state in bundle.objects["phone"].states] == ["ringing", "alarm"]
    assert [state.name for state in changed.objects["phone"].states] == ["alarm", "ringing"]
    assert HapticSession(changed).source("phone").state == "alarm"


@pytest.mark.parametrize("number", [0.5, 1, np.float32(0.5)], ids=repr)
def test_a_number_beside_a_state_changes_all_states_and_warns(bundle: HapticBundle, number: float) -> None:
    with pytest.warns(SceneWarning, match=rf"every state.* write start_up_s=\{{'alarm': {float(number):g}\}}"):
        changed = bundle.override("phone", state="alarm", start_up_s=number)
    assert [one.start_up_s for one in changed.objects["phone"].states] == [float(number)] * 2
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        bundle.override("phone", state="alarm", start_up_s={"alarm": 0.9})


def test_material_override_accepts_a_name_or_constants(bundle: HapticBundle) -> None:
    assert bundle.override("table", material="steel").objects["table"].material == materials.lookup("steel")
    jelly = Material("jelly", 1000.0, 1e5, 0.49, 0.4)
    changed = bundle.override("table", material=jelly).objects["table"]
    assert (changed.material, changed.material_category) == (jelly, "jelly")
    assert changed.provenance["material"] == "user"
    constants = {"name": "jelly", "density_kg_m3": 1000, "youngs_modulus_pa": 1e5, "poisson_ratio": 0.49}
    assert bundle.override("table", material={**constants, "loss_factor": 0.4}).objects["table"] == changed
    assert bundle.override("table", feet=constants).objects["table"].feet == Material("jelly", 1000.0, 1e5, 0.49)


def test_thickness_override_changes_how_far_vibration_goes(bundle: HapticBundle, tmp_path: Path) -> None:
    """Cremer & Heckl: a bending wave's number is proportional to 1 / sqrt(h), so a quarter of h doubles the loss."""

    def loss_db(of: HapticBundle) -> float:
        with HapticSession(of, hands=("left",)) as session:
            near, far = (
                session.update(touches=[Touch("left", "table", (x_m, 0.72, 0.4))]).gain("left", "phone")
                for x_m in (0.3, 0.9)
            )
        return float(20.0 * np.log10(near / far))

    thin = bundle.override("table", thickness_m=0.005)
    assert loss_db(thin) / loss_db(bundle) == pytest.approx(2.0, rel=0.01)
    assert thin.objects["table"].estimated_size_m == (1.6, 0.8, 0.005)
    assert thin.objects["table"].provenance["estimated_size_m"] == "user"
    loaded = HapticBundle.load(thin.save(tmp_path / "b"))
    assert loaded.objects == thin.objects
    assert loaded.overrides == thin.overrides
    assert loaded.reset("table").objects == bundle.objects


@pytest.mark.parametrize("thickness_m", [3.0, 1e-6, -0.02])
def test_thickness_that_the_object_cannot_have_is_refused(bundle: HapticBundle, thickness_m: float) -> None:
    with pytest.raises(BundleError, match=rf"thickness_m.* is {thickness_m:g}.* m"):
        bundle.override("table", thickness_m=thickness_m)


def test_thickness_in_millimetres_is_refused_without_a_bundle_too() -> None:
    with pytest.raises(BundleError, match=r"thickness_m is 30 m; it must be at most 10"):
        Override(thickness_m=30)


def test_thickness_of_a_person_stays_where_the_mesh_is_another_now(bundle: HapticBundle, tmp_path: Path) -> None:
    folder = bundle.override("table", thickness_m=0.2).save(tmp_path / "b")
    document = json.loads((folder / "scene.json").read_text())
    (table,) = (item for item in document["objects"] if item["id"] == "table")
    table["surface"]["width_m"] = 0.3  # a third of it is less than 0.2 m, and so is three times the measured 0.02 m
    (folder / "scene.json").write_text(json.dumps(document))
    rows = json.loads((folder / "objects.json").read_text())
    rows["table"]["estimated_size_m"][1] = 0.3
    (folder / "objects.json").write_text(json.dumps(rows))
    with pytest.warns(BundleWarning, match=r"thickness_m of 'table' is 0\.2 m, but it was measured as .* to 0\.1 m\."):
        assert HapticBundle.load(folder).objects["table"].estimated_size_m[2] == 0.2


def test_level_override_changes_the_output(bundle: HapticBundle) -> None:
    source = next(iter(bundle.loops))
    touch = [Touch("left", source, bundle.snapshot.object(source).pose.position_m)]

    def peak(of: HapticBundle) -> float:
        with HapticSession(of.snapshot, of, hands=("left",)) as session:
            session.update(touches=touch)
            return float(np.abs(session.render(24000)).max())

    assert peak(bundle.override(source, gain_db=-6.0)) == pytest.approx(10 ** (-6 / 20) * peak(bundle), rel=1e-3)


def test_overrides_accumulate(bundle: HapticBundle) -> None:
    source = next(iter(bundle.loops))
    twice = bundle.override(source, gain_db=-3.0).override(source, material="brass")
    assert twice.gain_db(source) == -3.0
    assert twice.objects[source].material == materials.lookup("brass")


def test_a_number_is_of_all_states_that_have_none_of_their_own() -> None:
    wish = Override(pitch_hz={"*": 120.0, "high": 90.0})
    assert [wish.pitch_of("on"), wish.pitch_of("high"), Override().pitch_of("on")] == [120.0, 90.0, None]
    assert wish.changed({"pitch_hz": {"low": 60.0}}).pitch_hz == {"*": 120.0, "high": 90.0, "low": 60.0}
    assert wish.changed({"pitch_hz": 150.0}).pitch_hz == {"*": 150.0}


def test_corrections_are_kept_in_the_folder(bundle: HapticBundle, tmp_path: Path) -> None:
    source, other = bundle.loops
    clip = AudioClip(np.sin(np.arange(800) / 7).astype(np.float32), RATE, Credit("hum", "me", "CC0", origin="user"))
    changed = bundle.override(source, gain_db=2.0, clip=clip).override(other, vibrates=False, material="oak")
    loaded = HapticBundle.load(changed.save(tmp_path / "b"))
    assert loaded.objects == changed.objects
    assert list(loaded.loops) == [source]
    assert loaded.overrides[other] == changed.overrides[other]
    assert loaded.gain_db(source) == 2.0
    kept = loaded.overrides[source].clip
    assert kept is not None
    assert kept.credit == clip.credit
    np.testing.assert_allclose(kept.samples, clip.samples, atol=2**-15)


def test_bundle_without_overrides_file_has_no_overrides(bundle: HapticBundle, tmp_path: Path) -> None:
    folder = bundle.save(tmp_path / "b")
    (folder / "overrides.json").unlink()
    manifest = json.loads((folder / "bundle.json").read_text())
    manifest["files"].remove("overrides.json")
    (folder / "bundle.json").write_text(json.dumps(manifest))
    assert HapticBundle.load(folder).overrides == {}


@pytest.mark.parametrize(
    ("wish", "error", "sentence"),
    [
        ({"vibrates": "yes"}, BundleError, "vibrates is 'yes'"),
        ({"gain_db": 300.0}, BundleError, "gain_db"),
        ({"gain_db": float("nan")}, BundleError, "gain_db"),
        ({"material": "unobtainium"}, UnknownMaterial, "unobtainium"),
        ({"material": 7}, BundleError, "material is 7"),
        (
            {"material": {}},
            BundleError,
            "material has no field; the fields of a material are name, density_kg_m3, youngs",
        ),
        (
            {"feet": {"name": "a", "colour": 2}},
            BundleError,
            "feet has name, colour; .* Only loss_factor may be left out",
        ),
        ({"material": {7: 1}}, BundleError, "material has 7; the fields of a material are name"),
        (
            {"feet": {"name": "a", "density_kg_m3": -1, "youngs_modulus_pa": 1e9, "poisson_ratio": 0.3}},
            MaterialError,
            "density_kg_m3 is -1 kg/m3",
        ),
        ({"clip": "hum.wav"}, AudioError, "hum.wav is not a file"),
        ({"clip": 3}, BundleError, "clip is 3"),
    ],
)
def test_invalid_override_is_refused(
    bundle: HapticBundle, wish: dict[str, object], error: type[Exception], sentence: str
) -> None:
    with pytest.raises(error, match=sentence):
        bundle.override("table", **wish)


def test_a_level_of_silence_is_refused_and_says_how_to_mute(bundle: HapticBundle) -> None:
    with pytest.raises(BundleError, match=r"'phone': gain_db is -600 dB.*at least -120.*muted=True.*mute ID"):
        bundle.override("phone", gain_db=-600)
    assert bundle.override("phone", gain_db=-120).gain_db("phone") == -120


def test_a_state_that_is_not_there_is_refused_with_the_next_step(bundle: HapticBundle) -> None:
    with pytest.raises(BundleError, match=r"'phone' has no state 'off'; it has 'ringing', 'alarm'.*muted=True.* mute"):
        bundle.override("phone", state="off")
    with pytest.raises(BundleError, match=r"'phone' has no state 'on'; it has 'ringing', 'alarm'\.$"):
        bundle.override("phone", pitch_hz={"on": 200})
    with pytest.raises(BundleError, match=r"'table' has no state 'on'; it does not vibrate.*vibrates=True.*vibrate ID"):
        bundle.override("table", state="on")


def test_a_sound_that_is_too_short_is_refused_with_its_file_and_object(bundle: HapticBundle, tmp_path: Path) -> None:
    click = AudioClip(np.ones(RATE // 50, np.float32) / 2, RATE, Credit("click", "me", "mine"))
    (tmp_path / "click20ms.wav").write_bytes(encoded(click.samples, RATE))
    with pytest.raises(AudioError, match=r"'phone': the sound .*click20ms.wav lasts 0.02 s; .* at least 0.1 s"):
        bundle.override("phone", clip=tmp_path / "click20ms.wav")
    with pytest.raises(AudioError, match="'phone': the sound 'click' lasts 0.02 s"):
        bundle.override("phone", clip=click)


def test_override_of_a_missing_object_is_refused(bundle: HapticBundle) -> None:
    with pytest.raises(UnknownObject):
        bundle.override("chair", vibrates=False)


@pytest.mark.parametrize(
    "row",
    [{"material": {"name": "x"}}, {"loud": True}, {"material": {**vars(Material("x", 1, 1, 0)), "density_kg_m3": -1}}],
)
def test_invalid_overrides_file_is_refused(bundle: HapticBundle, tmp_path: Path, row: dict[str, object]) -> None:
    folder = bundle.save(tmp_path / "b")
    (folder / "overrides.json").write_text(json.dumps({"table": row}))
    with pytest.raises(BundleError, match=r"overrides\.json"):
        HapticBundle.load(folder)


def test_a_sound_beyond_full_scale_is_scaled_down(bundle: HapticBundle, tmp_path: Path) -> None:
    """Editors export float files beyond full scale. The intensity sets the level, so only the shape counts."""
    shape = np.sin(2 * np.pi * 120 * np.arange(RATE) / RATE).astype(np.float32)
    bundle.override("phone", clip=AudioClip(5.0 * shape, RATE)).save(tmp_path / "b")
    clip = HapticBundle.load(tmp_path / "b").overrides["phone"].clip
    assert clip is not None
    np.testing.assert_allclose(clip.samples, shape / np.abs(shape).max(), atol=1e-6)


def test_a_level_like_a_percentage_is_doubted_once(bundle: HapticBundle, recwarn: pytest.WarningsRecorder) -> None:
    source = next(iter(bundle.loops))
    loud = bundle.override(source, gain_db=50.0)
    assert "percent" in str(recwarn.pop().message)
    loud.override(source, gain_db=-3.0)
    loud.override(source, muted=True)
    assert not list(recwarn)


def test_corrections_of_two_people_merge_line_by_line(bundle: HapticBundle, tmp_path: Path) -> None:
    """As git does it: with the conflict's marks deleted, and a comma after all lines but the last."""
    anns = bundle.override("phone", intensity={"ringing": 0.2}, gain_db=-3.0).override("table", material="oak")
    bobs = bundle.override(sorted(bundle.loops.keys() - {"phone"})[0], gain_db=-6.0)
    folders = [anns.save(tmp_path / "ann"), bobs.save(tmp_path / "bob")]
    for name in ("overrides.json", "inferred.json"):
        rows = []
        for folder in folders:
            first, *lines, last = (folder / name).read_text(encoding="utf-8").splitlines()
            assert (first, last) == ("{", "}")
            rows += [line.rstrip(",") for line in lines]
        assert len(rows) == 3
        (tmp_path / "ann" / name).write_text("{\n" + ",\n".join(rows) + "\n}\n", encoding="utf-8")
    merged = HapticBundle.load(tmp_path / "ann")
    assert merged.overrides == {**anns.overrides, **bobs.overrides}
    assert merged.inferred == {**anns.inferred, **bobs.inferred}
    assert (bundle.save(tmp_path / "none") / "overrides.json").read_text() == "{}\n"
