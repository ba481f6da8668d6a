"""Equal sounds share one file; edits of one source leave the others unchanged."""

import json
import os
import re
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from files_of import files_of
from scene2hap import AudioClip, HapticBundle
from scene2hap.audio.conversion import convert
from scene2hap.audio.encoding import encoded
from scene2hap.audio.files import read_clip
from scene2hap.bundle.sounds import file_stems
from scene2hap.errors import BundleError
from scene2hap.export import export_bundle
from scenes import RATE, box, haptics, scene, tone_loop

N = 5


def fans(n: int = N) -> HapticBundle:
    """Equal fans, each with its own loop object of equal content."""
    things = [box(f"fan_{i}", (0.3, 0.3, 0.3), (float(i), 0.15, 0.0)) for i in range(n)]
    humming = haptics("plastic", (0.3, 0.3, 0.3), "on")
    loops = {
        item.id: {"on": replace(tone_loop(120.0), source=tone_loop(120.0, seconds=1.0).audible)} for item in things
    }
    return HapticBundle(scene(*things), "room", dict.fromkeys(loops, humming), loops)


def names(folder: Path) -> list[str]:
    return sorted(path.name for path in (folder / "sounds").iterdir())


def rows(folder: Path) -> dict[str, dict[str, dict[str, str]]]:
    document: dict[str, dict[str, dict[str, str]]] = json.loads((folder / "loops.json").read_text())
    return document


def test_equal_sounds_are_one_file(tmp_path: Path) -> None:
    folder = fans().save(tmp_path / "b")
    assert names(folder) == ["fan_0.on+4.audible.wav", "fan_0.on+4.source.flac", "fan_0.on+4.tactile.wav"]
    loaded = HapticBundle.load(folder)
    first, *others = (loaded.loops[f"fan_{i}"]["on"] for i in range(N))
    assert all(other.tactile is first.tactile for other in others)
    assert first.source is not None
    np.testing.assert_allclose(first.source.samples, fans().loops["fan_0"]["on"].source.samples, atol=2**-23)


def test_saving_again_gives_the_same_bytes(tmp_path: Path) -> None:
    first = fans().save(tmp_path / "a")
    assert files_of(HapticBundle.load(first).save(tmp_path / "b")) == files_of(first)


def test_one_source_alone_keeps_its_plain_name(tmp_path: Path) -> None:
    folder = fans(1).save(tmp_path / "b")
    assert names(folder) == ["fan_0.on.audible.wav", "fan_0.on.source.flac", "fan_0.on.tactile.wav"]


def test_credits_stay_with_their_source(tmp_path: Path) -> None:
    bundle = fans(2)
    loop = bundle.loops["fan_1"]["on"]
    owed = replace(loop.audible.credit, title="another title")
    other = replace(loop, audible=replace(loop.audible, credit=owed), tactile=replace(loop.tactile, credit=owed))
    folder = replace(bundle, loops={**bundle.loops, "fan_1": {"on": other}}).save(tmp_path / "b")
    loaded = HapticBundle.load(folder)
    assert loaded.loops["fan_0"]["on"].audible.credit.title == "untitled"
    assert loaded.loops["fan_1"]["on"].audible.credit.title == "another title"
    assert loaded.loops["fan_0"]["on"].audible.samples is loaded.loops["fan_1"]["on"].audible.samples


def test_edit_of_a_shared_file_affects_all_its_sources(tmp_path: Path) -> None:
    folder = fans().save(tmp_path / "b")
    path = folder / rows(folder)["fan_3"]["on"]["tactile"]
    louder = read_clip(path)
    path.write_bytes(encoded(2.0 * louder.samples, louder.sample_rate_hz))
    loaded = HapticBundle.load(folder)
    peaks = [float(np.abs(states["on"].tactile.samples).max()) for states in loaded.loops.values()]
    assert peaks == pytest.approx([0.6] * N, abs=1e-6)


def test_user_file_separates_one_source(tmp_path: Path) -> None:
    folder = fans().save(tmp_path / "b")
    document = rows(folder)
    quiet = read_clip(folder / document["fan_3"]["on"]["tactile"])
    (folder / "sounds" / "quiet.wav").write_bytes(encoded(0.5 * quiet.samples, quiet.sample_rate_hz))
    document["fan_3"]["on"]["tactile"] = "sounds/quiet.wav"
    (folder / "loops.json").write_text(json.dumps(document))
    loaded = HapticBundle.load(folder)
    peaks = [float(np.abs(loaded.loops[f"fan_{i}"]["on"].tactile.samples).max()) for i in range(N)]
    assert peaks == pytest.approx([0.3, 0.3, 0.3, 0.15, 0.3], abs=1e-6)
    again = loaded.save(tmp_path / "again")
    assert {name for name in names(again) if "tactile" in name} == {"fan_0.on+3.tactile.wav", "fan_3.on.tactile.wav"}


def test_similar_file_names_are_not_confused(tmp_path: Path) -> None:
    bundle = fans(2)
    humming = haptics("plastic", (0.3, 0.3, 0.3), "on", "on+1")
    loops = {key: {**states, "on+1": tone_loop(90.0)} for key, states in bundle.loops.items()}
    loaded = HapticBundle.load(replace(bundle, objects=dict.fromkeys(loops, humming), loops=loops).save(tmp_path / "b"))
    assert [loaded.loops["fan_0"][state].frequency_raw_hz for state in ("on", "on+1")] == [120.0, 90.0]
    assert not np.array_equal(
        loaded.loops["fan_0"]["on"].tactile.samples, loaded.loops["fan_0"]["on+1"].tactile.samples
    )


@pytest.mark.parametrize("rate_hz", [700, 8_000, 44_100, 96_001, 192_000, 700_000])
def test_a_sound_of_any_rate_is_kept(tmp_path: Path, rate_hz: int) -> None:
    bundle = fans(1)
    source = AudioClip(np.linspace(-0.9, 0.9, 5000, dtype=np.float32), rate_hz)
    loop = replace(bundle.loops["fan_0"]["on"], source=source)
    loaded = HapticBundle.load(replace(bundle, loops={"fan_0": {"on": loop}}).save(tmp_path / "b"))
    kept = loaded.loops["fan_0"]["on"].source
    assert kept is not None
    assert kept.sample_rate_hz == rate_hz
    np.testing.assert_allclose(kept.samples, source.samples, atol=2**-23)


def test_invalid_file_name_in_loops_json_is_refused(tmp_path: Path) -> None:
    folder = fans(1).save(tmp_path / "b")
    document = rows(folder)
    document["fan_0"]["on"]["source"] = "sounds/\0.flac"
    (folder / "loops.json").write_text(json.dumps(document))
    with pytest.raises(BundleError, match="which cannot be"):
        HapticBundle.load(folder)


@pytest.mark.parametrize("fingerprint", [3, "abc", {"sound": 7}])
def test_invalid_fingerprint_is_refused(tmp_path: Path, fingerprint: object) -> None:
    folder = fans(1).save(tmp_path / "b")
    document = json.loads((folder / "loops.json").read_text())
    document["fan_0"]["on"]["fingerprint"] = fingerprint
    (folder / "loops.json").write_text(json.dumps(document))
    with pytest.raises(BundleError, match="fingerprint"):
        HapticBundle.load(folder)


def test_bundle_size_does_not_grow_with_copies(tmp_path: Path) -> None:
    def size(folder: Path) -> int:
        return sum(path.stat().st_size for path in (folder / "sounds").iterdir())

    assert size(fans(20).save(tmp_path / "many")) == size(fans(1).save(tmp_path / "one"))
    assert fans(1).loops["fan_0"]["on"].tactile.sample_rate_hz == RATE


def test_ids_that_differ_in_case_have_files_of_their_own_on_any_system(tmp_path: Path) -> None:
    """Windows and macOS take "Fan.wav" and "fan.wav" for one file, and Windows has no file "CON.wav"."""
    ids = ("Fan", "fan", "CON", "lamp")
    humming = haptics("plastic", (0.3, 0.3, 0.3), "on", "On")
    loops = {
        one: {state: tone_loop(80.0 + 20 * i + 5 * j) for j, state in enumerate(("on", "On"))}
        for i, one in enumerate(ids)
    }
    things = [box(one, (0.3, 0.3, 0.3), (float(i), 0.15, 0.0)) for i, one in enumerate(ids)]
    bundle = HapticBundle(scene(*things), "room", dict.fromkeys(ids, humming), loops)
    written = names(bundle.save(tmp_path / "b"))
    assert len({name.casefold() for name in written}) == len(written) == 16
    assert not [name for name in written if name.split(".")[0].casefold() == "con"]
    export_bundle(bundle, tmp_path / "out", "wav")
    exported = [path.name.casefold() for path in (tmp_path / "out" / "wav").iterdir()]
    assert len(set(exported)) == 8


def test_accented_letters_of_an_id_stay_readable_in_its_file_name() -> None:
    stems = file_stems(["Kühlschrank", "Außenlampe", "lampe_à_pied", "łóżko"])
    assert [stem.rpartition("-")[0] for stem in stems.values()] == [
        *("Kuhlschrank", "Aussenlampe", "lampe_a_pied", "lozko")
    ]
    assert len({*file_stems(["Kühlschrank", "Kuhlschrank"]).values()}) == 2


def test_only_ids_that_need_it_get_a_digest() -> None:
    stems = file_stems(["Fan", "fan", "lamp", "Lamp 2", "Radio"])
    assert (stems["lamp"], stems["Radio"]) == ("lamp", "Radio")
    assert [stem for stem in stems.values() if re.fullmatch("[Ff]an-[0-9a-f]{8}", stem)] == [stems["Fan"], stems["fan"]]


@pytest.mark.skipif(sys.platform != "linux", reason="names of files are bytes there")
def test_a_bundle_in_a_folder_whose_name_is_no_text_is_read(tmp_path: Path) -> None:
    """Archives from other systems have names in other encodings; with LC_ALL=C any name beyond ASCII is one."""
    folder = tmp_path / os.fsdecode(b"caf\xe9")
    fans(1).save(folder)
    assert list(HapticBundle.load(folder).loops) == ["fan_0"]
    sound = next((folder / "sounds").glob("*.audible.wav"))
    convert(sound, folder / "felt.wav")
    assert read_clip(folder / "felt.wav").samples.size
