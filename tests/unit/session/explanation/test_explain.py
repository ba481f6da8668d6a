"""`explain`: the sources, paths and losses of a hand's vibration, against the paper's law written out."""

import dataclasses
import json
import math
from typing import Any

import numpy as np
import pytest

from scene2hap import Contact, HapticBundle, HapticSession, Pose, SceneSnapshot, Touch, materials
from scene2hap.audio.sensation import Sensation
from scene2hap.contact.junction import Junction
from scene2hap.errors import SessionError
from scene2hap.propagation import MODELS
from scene2hap.propagation.paths.live_law import LivePaths
from scene2hap.session.explanation.report import PathStep
from scenes import RATE, box, haptics, scene, table_with_two_phones, tone_loop


def fall_db(material: str, thickness_m: float, frequency_hz: float, length_m: float) -> float:
    """The change in level along a length, 20 lg exp(-k d) [dB], from the material constants."""
    m = materials.lookup(material)
    D = m.youngs_modulus_pa * thickness_m**3 / (12 * (1 - m.poisson_ratio**2))
    k = (m.density_kg_m3 * thickness_m * (2 * math.pi * frequency_hz) ** 2 / D) ** 0.25
    return 20 * math.log10(math.exp(-k * length_m))


def shelf_on_table(weight: float = 1.0) -> tuple[SceneSnapshot, HapticBundle]:
    """A phone on a steel shelf, which has two contacts with an oak table, one nearer to the phone."""
    plain = scene(
        box("table", (1.6, 0.02, 0.8), (0.8, 0.71, 0.4)),
        box("shelf", (0.6, 0.02, 0.3), (0.5, 0.73, 0.4)),
        box("phone", (0.1, 0.01, 0.1), (0.3, 0.745, 0.4)),
    )
    contacts = (
        Contact("phone", "shelf", (0.3, 0.74, 0.4), weight=weight),
        Contact("shelf", "table", (0.7, 0.74, 0.7)),
        Contact("shelf", "table", (0.2, 0.74, 0.4)),
    )
    snapshot = SceneSnapshot("stack", "y", plain.objects, contacts)
    inferred = {
        "table": haptics("oak", (1.6, 0.8, 0.02)),
        "shelf": haptics("steel", (0.6, 0.3, 0.02)),
        "phone": haptics("glass", (0.1, 0.1, 0.01), "ringing"),
    }
    return snapshot, HapticBundle(snapshot, "room", inferred, {"phone": {"ringing": tone_loop(180)}})


ON_TABLE = Touch("left", "table", (0.2, 0.74, 0.7))


def test_explanation_lists_the_path_over_two_objects() -> None:
    s = HapticSession(*shelf_on_table(), {"sample_rate_hz": RATE})
    frame = s.update(touches=[ON_TABLE])
    (felt,) = s.explain("left").felt
    assert [(step.object_id, round(step.length_m, 6)) for step in felt.steps] == [
        ("phone", 0.0),
        ("shelf", 0.1),
        ("table", 0.3),
    ]
    expected = [0.0, fall_db("steel", 0.02, 180, 0.1), fall_db("oak", 0.02, 180, 0.3)]
    assert [step.change_db for step in felt.steps] == pytest.approx(expected, abs=1e-6)
    assert sum(expected) == pytest.approx(20 * math.log10(frame.gain("left", "phone")), abs=1e-4)
    assert felt.length_m == pytest.approx(0.4)
    assert (felt.source_id, felt.state, felt.on, felt.band) == ("phone", "ringing", "table", 0)


def test_explanation_is_available_as_text_and_data() -> None:
    s = HapticSession(*shelf_on_table(), {"sample_rate_hz": RATE})
    s.set_source("phone", gain_db=-3.0)
    s.update(touches=[ON_TABLE])
    told = s.explain("left")
    gain, shelf, table = (f"{x:+.1f}" for x in (told.felt[0].gain_db, *(y.change_db for y in told.felt[0].steps[1:])))
    assert str(told) == (
        "left touches table:\n"
        f"  phone (ringing) {gain} dB over 0.40 m, volume -3.0 dB: phone (0.00 m, +0.0 dB) -> "
        f"shelf (0.10 m, {shelf} dB) -> table (0.30 m, {table} dB)"
    )
    data = json.loads(json.dumps(told.to_data()))
    assert data["felt"][0]["steps"][1]["object_id"] == "shelf"
    assert data["text"] == told.text


def test_searches_do_not_grow_with_the_length_of_paths(monkeypatch: pytest.MonkeyPatch) -> None:
    """A row of blocks with a source at each end: the path's own costs give the gain at every contact on it."""
    n = 12
    snapshot = scene(*(box(f"b{i}", (0.1, 0.05, 0.1), (0.1 * i, 0.0, 0.0)) for i in range(n)))
    inferred = {f"b{i}": haptics("steel", (0.1, 0.1, 0.05), *["humming"] * (i % (n - 1) == 0)) for i in range(n)}
    loops = {x: {"humming": tone_loop(60)} for x, one in inferred.items() if one.states}
    s = HapticSession(snapshot, HapticBundle(snapshot, "row", inferred, loops), {"sample_rate_hz": RATE})
    assert (s.update(touches=[Touch("left", "b5", (0.5, 0.025, 0.0))]).gains[0] > 0).all()
    searches = []
    least_costs = LivePaths.least_costs

    def counted(paths: LivePaths, *given: Any) -> list[float]:
        searches.append(given)
        return least_costs(paths, *given)

    monkeypatch.setattr(LivePaths, "least_costs", counted)
    near, far = s.explain("left").felt
    assert len(searches) == 1
    assert [len(one.steps) for one in (near, far)] == [6, 7]
    for one in (near, far):
        each = [fall_db("steel", 0.05, 60, step.length_m) for step in one.steps]
        assert [step.change_db for step in one.steps] == pytest.approx(each, abs=1e-6)


def test_loss_of_a_weak_contact_is_added_to_the_path_behind_it() -> None:
    whole, weak = (
        HapticSession(*shelf_on_table(weight), {"sample_rate_hz": RATE, "skip": False}) for weight in (1.0, 0.5)
    )
    for s in (whole, weak):
        s.update(touches=[ON_TABLE])
    changes = [[step.change_db for step in s.explain("left").felt[0].steps] for s in (whole, weak)]
    # A weight is the gain at 250 Hz; the law scales it to other frequencies.
    lost = 20 * math.log10(0.5 ** math.sqrt(180 / 250))
    assert changes[1] == pytest.approx([changes[0][0], changes[0][1] + lost, changes[0][2]], abs=1e-6)


def test_explanation_lists_only_sources_felt_now() -> None:
    s = HapticSession(*table_with_two_phones(), {"sample_rate_hz": RATE})
    assert s.explain("left").text == "left touches nothing and feels nothing."
    s.update(touches=[Touch("left", "table", (0.3, 0.72, 0.4))])
    assert [item.source_id for item in s.explain("left").felt] == ["phone", "alarm"]
    assert s.explain("right").felt == ()
    s.set_source("phone", on=False)
    s.update(touches=[Touch("left", "table", (0.3, 0.72, 0.4))])
    assert [item.source_id for item in s.explain("left").felt] == ["alarm"]
    s.remove("alarm")
    assert s.explain("left").felt == ()
    s.update(touches=[Touch("left", "cup", (5.0, 0.1, 5.0))])
    assert s.explain("left").text.startswith("left touches cup and feels nothing.")
    with pytest.raises(SessionError, match="no hand 'foot'"):
        s.explain("foot")


def test_touched_source_has_a_path_of_itself() -> None:
    s = HapticSession(*table_with_two_phones(), {"sample_rate_hz": RATE})
    s.update(touches=[Touch("left", "phone", (0.1, 0.73, 0.4))])
    phone = s.explain("left").felt[0]
    assert phone.gain_db == 0.0
    assert [(step.object_id, step.length_m, step.change_db) for step in phone.steps] == [("phone", 0.0, 0.0)]


def test_explanation_counts_hops_like_the_law() -> None:
    law = {"kind": "exponential_plate", "max_hops": 1}
    s = HapticSession(*shelf_on_table(), {"sample_rate_hz": RATE, "propagation": law})
    s.update(touches=[Touch("left", "shelf", (0.5, 0.74, 0.4)), Touch("right", "table", (0.2, 0.74, 0.7))])
    assert [step.object_id for step in s.explain("left").felt[0].steps] == ["phone", "shelf"]
    assert s.explain("right").felt == ()


@pytest.mark.parametrize("kind", ["exponential_plate", "full_propagation"])
def test_path_steps_multiply_to_the_gain(kind: str) -> None:
    s = HapticSession(*shelf_on_table(), {"sample_rate_hz": RATE, "propagation": kind, "bands": "third-octaves"})
    assert s.wait_prepared(60.0)
    frame = s.update(touches=[ON_TABLE])
    (felt,) = s.explain("left").felt
    told = sum(step.change_db for step in felt.steps)
    assert told == pytest.approx(20 * math.log10(frame.gains[0, 0, felt.band]), abs=1e-4)


@pytest.mark.parametrize("kind", ["exponential_plate", "modal_plate"])
@pytest.mark.filterwarnings("ignore::scene2hap.propagation.domain.ThinPlateWarning")
def test_level_is_that_of_the_mix_in_third_octaves(kind: str) -> None:
    """In an earlier version the highest gain of all bands counted, also where the source has no vibration."""
    snapshot, bundle = shelf_on_table()
    loop = dataclasses.replace(tone_loop(200), felt=Sensation(31.0, 31.0))
    config = {"sample_rate_hz": RATE, "propagation": kind, "prepare": "blocking", "bands": "third-octaves"}
    s = HapticSession(snapshot, dataclasses.replace(bundle, loops={"phone": {"ringing": loop}}), config)
    frame = s.update(touches=[ON_TABLE, Touch("right", "phone", (0.3, 0.745, 0.4))])
    s.render_s(0.5)
    left, right = np.std(s.render_s(0.5), axis=0)
    (felt,) = s.explain("left").felt
    in_mix_db = 31.0 + 20 * math.log10(left / right)
    assert felt.over_threshold_db == pytest.approx(in_mix_db, abs=1.0)
    assert felt.is_too_weak == (in_mix_db < 0.0)
    assert s.over_threshold_db(frame)[:, 0] == pytest.approx([in_mix_db, 31.0], abs=1.0)
    assert s.over_threshold_db(s.would_feel([ON_TABLE]))[0, 0] == pytest.approx(felt.over_threshold_db, abs=1e-3)
    assert s.over_threshold_db(0 * frame.gains).tolist() == [[-math.inf], [-math.inf]]
    with pytest.raises(SessionError, match=r"1 sources and 20 bands"):
        s.over_threshold_db(frame.gains.max(axis=2))
    s.add(box("bell", (0.1, 0.01, 0.1), (0.0, 0.725, 0.4)), bundle.objects["phone"], {"ringing": loop})
    s.remove("phone")
    with pytest.raises(SessionError, match=r"other sources \(phone\) than the session now \(bell\)"):
        s.over_threshold_db(frame)


@pytest.mark.parametrize("bands", ["dominant", "third-octaves"])
@pytest.mark.parametrize("kind", ["infinite_plate", "modal_plate", "auto", "mass_spring_damper"])
@pytest.mark.filterwarnings("ignore::scene2hap.propagation.domain.ThinPlateWarning")
def test_physical_models_report_total_gain_and_share_of_each_contact(kind: str, bands: str) -> None:
    config = {"sample_rate_hz": RATE, "propagation": kind, "bands": bands, "prepare": "blocking"}
    s = HapticSession(*shelf_on_table(), config)
    frame = s.update(touches=[ON_TABLE])
    (felt,) = s.explain("left").felt
    assert felt.steps == ()
    assert felt.gain_db == pytest.approx(20 * math.log10(frame.gains[0, 0, felt.band]), abs=1e-4)
    assert {carrier.by for carrier in felt.carriers} == {"shelf"}
    assert {(round(c.point_m[0], 9), round(c.point_m[2], 9)) for c in felt.carriers} <= {(0.7, 0.7), (0.2, 0.4)}
    assert sum(carrier.share for carrier in felt.carriers) == pytest.approx(1.0)
    assert [carrier.share for carrier in felt.carriers] == sorted((c.share for c in felt.carriers), reverse=True)
    assert f"dB: 100 % from shelf over {len(felt.carriers)} contact" in str(felt)
    s.update(touches=[Touch("left", "shelf", (0.5, 0.74, 0.4))])
    assert s.explain("left").felt[0].carriers[0].by == "phone"
    s.update(touches=[Touch("left", "phone", (0.3, 0.745, 0.4))])
    on_itself = s.explain("left").felt[0]
    assert (on_itself.carriers, [step.object_id for step in on_itself.steps]) == ((), ["phone"])


@pytest.mark.parametrize("weak", [1, 2])
def test_contact_of_low_weight_has_a_low_share(weak: int) -> None:
    snapshot, bundle = shelf_on_table()
    contacts = list(snapshot.contacts or ())
    contacts[weak] = dataclasses.replace(contacts[weak], weight=1e-9)
    config = {"sample_rate_hz": RATE, "propagation": "infinite_plate", "prepare": "blocking"}
    s = HapticSession(dataclasses.replace(snapshot, contacts=tuple(contacts)), bundle, config)
    s.update(touches=[ON_TABLE])
    strongest = s.explain("left").felt[0].carriers[0]
    assert strongest.share > 0.99
    assert strongest.point_m == pytest.approx((contacts[3 - weak].point_m[0], 0.71, contacts[3 - weak].point_m[2]))


def bar_on_a_rug() -> tuple[SceneSnapshot, HapticBundle]:
    """A phone on a long rubber mat; a steel bar on the mat is a path of less loss."""
    plain = scene(
        box("mat", (2.0, 0.01, 0.8), (1.0, 0.005, 0.4)),
        box("bar", (1.8, 0.02, 0.1), (1.0, 0.02, 0.4)),
        box("phone", (0.1, 0.01, 0.1), (0.1, 0.015, 0.4)),
    )
    contacts = (
        Contact("phone", "mat", (0.1, 0.01, 0.4)),
        Contact("bar", "mat", (0.15, 0.01, 0.4)),
        Contact("bar", "mat", (1.85, 0.01, 0.4)),
    )
    inferred = {
        "mat": haptics("rubber", (2.0, 0.8, 0.01)),
        "bar": haptics("steel", (1.8, 0.1, 0.02)),
        "phone": haptics("glass", (0.1, 0.1, 0.01), "ringing"),
    }
    snapshot = SceneSnapshot("bar", "y", plain.objects, contacts)
    return snapshot, HapticBundle(snapshot, "room", inferred, {"phone": {"ringing": tone_loop(40)}})


def test_shortcut_over_another_object_is_one_step() -> None:
    s = HapticSession(*bar_on_a_rug(), {"sample_rate_hz": RATE})
    frame = s.update(touches=[Touch("left", "mat", (1.9, 0.01, 0.4))])
    (felt,) = s.explain("left").felt
    assert [step.object_id for step in felt.steps] == ["phone", "mat"]
    mat = felt.steps[1]
    assert mat.by_way_of == ("bar",)
    assert mat.length_m == pytest.approx(0.05 + 1.7 + 0.05)
    assert mat.change_db == pytest.approx(20 * math.log10(frame.gain("left", "phone")), abs=1e-4)
    assert "mat (1.80 m by way of bar, " in str(felt)


@pytest.mark.parametrize("kind", MODELS.kinds())
@pytest.mark.filterwarnings("ignore::scene2hap.propagation.domain.ThinPlateWarning")
def test_gains_below_140_db_are_zero_for_every_model(kind: str) -> None:
    config = {"sample_rate_hz": RATE, "propagation": kind, "prepare": "blocking", "bands": "third-octaves"}
    snapshot, bundle = shelf_on_table()
    for gain_db in (-139.0, -141.0, -220.0):
        s = HapticSession(snapshot, bundle, config)
        s.set_source("phone", gain_db=gain_db)
        frame = s.update(touches=[Touch("left", "phone", (0.3, 0.745, 0.4)), ON_TABLE])
        assert (frame.gain("left", "phone") > 0.0) == (gain_db > -140.0)
        assert not ((frame.gains > 0.0) & (frame.gains < 1e-7)).any()
        assert bool(s.explain("left").felt) == (gain_db > -140.0)


def test_explanation_says_why_nothing_is_felt() -> None:
    s = HapticSession(*shelf_on_table(), {"sample_rate_hz": RATE})

    def reasons() -> str:
        s.update(touches=[ON_TABLE])
        s.render_s(0.1)
        s.update(touches=[ON_TABLE])
        return "\n".join(s.explain("left").reasons)

    assert reasons() == "", "it feels the phone"
    s.set_source("phone", on=False)
    assert "off: 'phone'; call `set_source` with on true" in reasons()
    s.set_source("phone", on=True, mute=True)
    assert "muted: 'phone'; call `set_source` with mute false" in reasons()
    s.set_source("phone", mute=False)
    s._sources["phone"].is_resting = True  # as a thermostat does
    s._hand_frames.levels_changed()
    assert "in its off-time: 'phone'; call `set_source` with on true" in reasons()
    s.set_source("phone", on=True)
    assert reasons() == "", "who switches it on ends its off-time"
    s.set_user(mute=True)
    assert "call `set_user` with mute false" in reasons()
    s.set_user(mute=False)
    s.pause()
    assert "`resume` ends the pause" in reasons()
    s.resume()
    s.remove("shelf")
    assert reasons() == "No source touches it, directly or over other objects."
    assert reasons() in s.explain("left").text


def test_explanation_names_sources_that_are_connected_but_too_far() -> None:
    """In an earlier version a hand at the far end of a floor felt nothing, and no reason was given."""
    plain = scene(box("floor", (40.0, 0.02, 4.0), (0.0, 0.0, 0.0)), box("phone", (0.1, 0.01, 0.1), (-19.0, 0.015, 0.0)))
    snapshot = dataclasses.replace(plain, contacts=(Contact("phone", "floor", (-19.0, 0.01, 0.0)),))
    inferred = {"floor": haptics("oak", (40.0, 4.0, 0.02)), "phone": haptics("glass", (0.1, 0.1, 0.01), "ringing")}
    bundle = HapticBundle(snapshot, "hall", inferred, {"phone": {"ringing": tone_loop(200)}})
    s = HapticSession(snapshot, bundle, {"sample_rate_hz": RATE})
    assert 38.0 * fall_db("oak", 0.02, 200, 1.0) < -140.0
    s.update(touches=[Touch("left", "floor", (19.0, 0.01, 0.0))])
    assert s.explain("left").felt == ()
    (why,) = s.explain("left").reasons
    assert "below -140 dB here: 'phone'; touch nearer" in why
    s.set_source("phone", on=False)
    s.update(touches=[Touch("left", "floor", (19.0, 0.01, 0.0))])
    (why,) = s.explain("left").reasons
    assert "off: 'phone'" in why


def test_explanation_says_that_the_sink_was_not_started() -> None:
    s = HapticSession(*shelf_on_table(), {"sample_rate_hz": RATE}, sink="memory")
    s.update(touches=[ON_TABLE])
    (why,) = s.explain("left").reasons
    assert "call start()" in why
    assert why in s.explain("left").text
    with s:
        s.update(touches=[ON_TABLE])
        assert s.explain("left").reasons == ()
    assert s.explain("left").reasons == (why,)


def test_explanation_marks_sources_too_weak_to_be_felt() -> None:
    snapshot, bundle = shelf_on_table()
    loop = dataclasses.replace(bundle.loops["phone"]["ringing"], felt=Sensation(40.0, 40.0))
    s = HapticSession(
        snapshot, dataclasses.replace(bundle, loops={"phone": {"ringing": loop}}), {"sample_rate_hz": RATE}
    )
    s.update(touches=[ON_TABLE])
    (felt,) = s.explain("left").felt
    assert felt.over_threshold_db == pytest.approx(40.0 + felt.gain_db)
    assert "too weak" not in str(felt)
    s.set_source("phone", gain_db=-felt.over_threshold_db - 1.0)
    s.update(touches=[ON_TABLE])
    (felt,) = s.explain("left").felt
    assert felt.over_threshold_db == pytest.approx(-1.0, abs=0.05)
    assert "too weak to be felt: phone" in str(felt)


def test_a_source_behind_an_unknown_material_is_not_connected() -> None:
    snapshot, bundle = shelf_on_table()
    known = {object_id: one for object_id, one in bundle.objects.items() if object_id != "shelf"}
    s = HapticSession(snapshot, dataclasses.replace(bundle, objects=known), {"sample_rate_hz": RATE})
    s.set_source("phone", on=False)
    s.update(touches=[ON_TABLE])
    assert s.explain("left").reasons == ("No source touches it, directly or over other objects.",)


def test_a_hand_on_an_unknown_object_learns_to_name_it() -> None:
    snapshot, bundle = shelf_on_table()
    known = {object_id: one for object_id, one in bundle.objects.items() if object_id != "table"}
    s = HapticSession(snapshot, dataclasses.replace(bundle, objects=known), {"sample_rate_hz": RATE})
    s.update(touches=[ON_TABLE])
    (unknown, _) = s.explain("left").reasons
    assert unknown.startswith("The material of 'table' is unknown. Correct its `name` or its `material` by `override`")


def test_no_level_is_minus_zero() -> None:
    assert str(PathStep("mat", 0.001, -0.01)) == "mat (0.00 m, +0.0 dB)"


def test_explanation_names_a_source_inside_the_touched_object() -> None:
    snapshot = scene(
        box("housing", (0.4, 0.4, 0.4), (0.0, 0.2, 0.0)), box("motor", (0.08, 0.08, 0.08), (0.0, 0.2, 0.0))
    )
    inferred = {
        "housing": haptics("steel", (0.4, 0.4, 0.4)),
        "motor": haptics("steel", (0.08, 0.08, 0.08), "running"),
    }
    bundle = HapticBundle(snapshot, "room", inferred, {"motor": {"running": tone_loop(180)}})
    s = HapticSession(snapshot, bundle, {"sample_rate_hz": RATE})
    touch = Touch("left", "housing", (0.0, 0.4, 0.0))
    s.update(touches=[touch])
    nothing, inside = s.explain("left").reasons
    assert nothing == "No source touches it, directly or over other objects."
    assert inside.startswith("Inside it, too far from its surface to touch: 'motor'; ")
    s.update({"motor": Pose((0.0, 0.2, 1.0))}, [touch])
    assert s.explain("left").reasons == (nothing,)


def test_paths_are_searched_to_the_felt_sources_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of 10,000 objects, `explain` took 11 s to search for sources that the hand does not feel."""
    s = HapticSession(*shelf_on_table(), {"sample_rate_hz": RATE})
    s.update(touches=[ON_TABLE])
    limits: list[object] = []
    search = LivePaths.least_costs

    def noted(self: LivePaths, touched: Any, limit: Any = None, among: Any = None) -> list[float]:
        limits.append(limit)
        return search(self, touched, limit, among)

    monkeypatch.setattr(LivePaths, "least_costs", noted)
    assert [one.source_id for one in s.explain("left").felt] == ["phone"]
    assert limits
    assert None not in limits


def test_only_the_contacts_that_changed_are_made_again(monkeypatch: pytest.MonkeyPatch) -> None:
    cups = [box(f"cup{i}", (0.05, 0.1, 0.05), (0.1 + 0.2 * i, 0.77, 0.2)) for i in range(7)]
    room = scene(
        box("table", (1.6, 0.02, 0.8), (0.8, 0.71, 0.4)), box("phone", (0.1, 0.01, 0.1), (0.3, 0.725, 0.6)), *cups
    )
    inferred = {"table": haptics("oak", (1.6, 0.8, 0.02)), "phone": haptics("glass", (0.1, 0.1, 0.01), "ringing")}
    made: list[tuple[str, str]] = []
    contacts = Junction.contacts

    def noted(self: Junction, pair: tuple[str, str]) -> tuple[Contact, ...]:
        made.append(pair)
        return contacts(self, pair)

    bundle = HapticBundle(room, "room", inferred, {"phone": {"ringing": tone_loop(180)}})
    with HapticSession(room, bundle, {"sample_rate_hz": RATE}) as s:
        s.update(touches=[ON_TABLE])
        s.explain("left")
        monkeypatch.setattr(Junction, "contacts", noted)
        s.update({"cup3": Pose((0.72, 0.77, 0.2))}, [ON_TABLE])
        (felt,) = s.explain("left").felt
    assert made == [("cup3", "table")]
    assert [step.object_id for step in felt.steps] == ["phone", "table"]
