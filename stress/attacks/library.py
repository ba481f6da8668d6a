"""Hostile numbers and arrays for the public names of the library: each must raise an error of scene2hap or be harmless.

Objects of a wrong class are not part of this family: Python itself reports them.
"""

# ruff: noqa: E501  # tables of cases

from __future__ import annotations

import itertools
import random
import warnings
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from stress.attacks import bundles
from stress.attacks.attack import Attack
from stress.attacks.judging import is_harmless, printed
from stress.attacks.values import SCALARS, arrays

Entry = Callable[[Any, Path], object]


def _plate(**fields: Any) -> Any:
    from scene2hap import Material, Plate

    given = {
        "length_m": 1.0,
        "width_m": 0.5,
        "thickness_m": 0.02,
        "material": Material("oak", 700.0, 1e10, 0.3),
        **fields,
    }
    return Plate(**given)


def _material(**fields: Any) -> Any:
    from scene2hap import Material

    return Material(
        **{"name": "oak", "density_kg_m3": 700.0, "youngs_modulus_pa": 1e10, "poisson_ratio": 0.3, **fields}
    )


def _clip(**fields: Any) -> Any:
    from scene2hap import AudioClip

    return AudioClip(**{"samples": np.zeros((4800, 1), np.float32), "sample_rate_hz": 48_000, **fields})


def _scene_object(**fields: Any) -> Any:
    from scene2hap import Box, DominantSurface, Pose, SceneObject

    surface = DominantSurface(Pose(), 1.0, 1.0, 0.1)
    return SceneObject(
        **{"id": "a", "name": "a", "pose": Pose(), "geometry": Box((1, 1, 1)), "surface": surface, **fields}
    )


def _haptics(**fields: Any) -> Any:
    from scene2hap import ObjectHaptics

    given = {
        "object_category": "a",
        "material_category": "oak",
        "material": None,
        "estimated_size_m": (1.0, 1.0, 1.0),
        "usage": "",
        "vibrates": False,
    }
    return ObjectHaptics(**{**given, **fields})


def _state(**fields: Any) -> Any:
    from scene2hap import SourceState

    return SourceState(
        **{"name": "on", "intensity": 0.5, "sentence": "a fan hums", "keywords": "fan humming", **fields}
    )


def _description(**fields: Any) -> Any:
    from scene2hap import VibrationDescription

    given = {
        "object_category": "fan",
        "state": "on",
        "sentence": "",
        "keywords": "fan",
        "intensity": 0.5,
        "size_m": (0.1, 0.1, 0.1),
    }
    return VibrationDescription(**{**given, **fields})


def _synth(value: Any, name: str) -> Any:
    from scene2hap.audio.sources.synth.synthesizer import Synthesizer

    return Synthesizer().find(_description(**{name: value}))


def _context(**fields: Any) -> Any:
    from scene2hap import ConversionContext

    return ConversionContext(**fields)


def _actuator(**fields: Any) -> Any:
    from scene2hap import ActuatorProfile

    return ActuatorProfile(**fields)


def _session(room: Path, **config: Any) -> Any:
    from scene2hap import HapticBundle, HapticSession, MemorySink

    bundle = HapticBundle.load(room)
    sink = MemorySink()
    hands = config.pop("hands", ("left", "right"))
    return HapticSession(bundle.snapshot, bundle, {"prepare": "blocking", **config}, hands=hands, sink=sink)


def _played(room: Path, act: Callable[[Any], object], **config: Any) -> Any:
    """Result of an action in a session, and samples rendered after it, both to be checked."""
    from scene2hap import Touch

    with _session(room, **config) as session:
        session.update({}, [Touch("left", "fan", (0.0, 0.3, 0.0))])
        done = act(session)
        session.update({}, [Touch("left", "table", (0.1, 0.02, 0.1))])
        return done, session.render(480)


def _field(kind: str, **how: Any) -> Callable[[Any, Path], object]:
    """Function that queries a propagation model with a hostile number in the argument named by `how`."""

    def query(value: Any, room: Path) -> object:
        import scene2hap as s

        model = getattr(s, kind)()
        place = next(iter(how))
        given = {"drive": (0.1, 0.1), "points": [(0.2, 0.2)], "frequencies": [100.0]}
        given[place] = [(value, 0.1)] if place == "points" else (value, 0.1) if place == "drive" else [value]
        return model.plate_transfer(_plate(), given["drive"], given["points"], given["frequencies"])

    return query


def _network(value: Any, room: Path, place: str) -> object:
    from scene2hap import Bands, Contact, ContactNetwork, Excitation, ExponentialPlate, ModalPlate, Pose, RigidBody

    given: dict[str, Any] = {
        "point": (0.1, 0.1, 0.0),
        "weight": 1.0,
        "hz": 100.0,
        "mass": 1.0,
        "query": [(0.1, 0.1, 0.0)],
    }
    given[place] = (value, 0.1, 0.0) if place == "point" else [(value, 0.1, 0.0)] if place == "query" else value
    bodies = {"a": _plate(), "b": RigidBody(1.0)}
    network = ContactNetwork(
        bodies, [Contact("a", "b", given["point"], weight=given["weight"])], {"a": Pose(), "b": Pose()}
    )
    excitations = [Excitation("b", given["hz"], given["hz"], given["mass"])]
    return [
        model().prepare(network, excitations, Bands.dominant()).attenuation("a", given["query"])
        for model in (ExponentialPlate, ModalPlate)
    ]


def _s(name: str) -> Any:
    import scene2hap

    return getattr(scene2hap, name)


NUMBERS: dict[str, Entry] = {
    "Pose position": lambda v, _: _s("Pose")((v, 0, 0)),
    "Pose position whole": lambda v, _: _s("Pose")(v),
    "Pose rotation": lambda v, _: _s("Pose")((0, 0, 0), (0, 0, 0, v)),
    "Pose.to_world": lambda v, _: _s("Pose")().to_world([v, 0, 0]),
    "Pose.to_own": lambda v, _: _s("Pose")((1e300, 0, 0)).to_own([v, 0, 0]),
    "Pose.from_matrix": lambda v, _: _s("Pose").from_matrix([[v, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]),
    "Pose.from_matrix whole": lambda v, _: _s("Pose").from_matrix(v),
    "Box": lambda v, _: _s("Box")((v, 1, 1)),
    "Box whole": lambda v, _: _s("Box")(v),
    "TriMesh vertex": lambda v, _: _s("TriMesh")([[v, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]),
    "TriMesh face": lambda v, _: _s("TriMesh")([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, v]]),
    "DominantSurface": lambda v, _: _s("DominantSurface")(_s("Pose")(), v, 1.0, 0.1),
    "Contact point": lambda v, _: _s("Contact")("a", "b", (v, 0, 0)),
    "Contact normal": lambda v, _: _s("Contact")("a", "b", (0, 0, 0), (v, 0, 0)),
    "Contact area": lambda v, _: _s("Contact")("a", "b", (0, 0, 0), area_m2=v),
    "Contact weight": lambda v, _: _s("Contact")("a", "b", (0, 0, 0), weight=v),
    "Contact id": lambda v, _: _s("Contact")(v, "b", (0, 0, 0)),
    "SceneObject id": lambda v, _: _scene_object(id=v),
    "SceneObject name": lambda v, _: _scene_object(name=v),
    "SceneObject height": lambda v, _: _scene_object(relative_height_m=v),
    "SceneSnapshot axis": lambda v, _: _s("SceneSnapshot")("a", v, (_scene_object(),)),
    "SceneSnapshot.object": lambda v, _: _s("SceneSnapshot")("a", "y", (_scene_object(),)).object(v),
    "Material density": lambda v, _: _material(density_kg_m3=v),
    "Material modulus": lambda v, _: _material(youngs_modulus_pa=v),
    "Material ratio": lambda v, _: _material(poisson_ratio=v),
    "Material loss": lambda v, _: _material(loss_factor=v),
    "Material name": lambda v, _: _material(name=v),
    "Plate length": lambda v, _: _plate(length_m=v),
    "Plate thickness": lambda v, _: _plate(thickness_m=v).wavenumber_rad_m(100.0),
    "Plate boundary": lambda v, _: _plate(boundary=v),
    "Plate.wavenumber": lambda v, _: _plate().wavenumber_rad_m(v),
    "RigidBody": lambda v, _: _s("RigidBody")(v),
    "RigidBody size": lambda v, _: _s("RigidBody")(1.0, (v, 1.0, 1.0)),
    "plate_modes n": lambda v, _: _s("plate_modes")(_plate(), v),
    "plate_modes hz": lambda v, _: _s("plate_modes")(_plate(), max_frequency_hz=v),
    "plate_modes of a long strip": lambda v, _: _s("plate_modes")(_plate(length_m=v), max_frequency_hz=1000.0),
    "MassSpringDamper": lambda v, _: _s("MassSpringDamper")(resolution=v),
    "MassSpringDamper n": lambda v, _: _s("MassSpringDamper")(resolution=8).natural_frequencies_hz(_plate(), v),
    "plate_motion force": lambda v, _: _s("MassSpringDamper")(resolution=8).plate_motion(_plate(), (0.1, 0.1), [(0.2, 0.1)], [v] * 9, 8000.0),
    "plate_motion rate": lambda v, _: _s("MassSpringDamper")(resolution=8).plate_motion(_plate(), (0.1, 0.1), [(0.2, 0.1)], [1.0] * 9, v),
    "plate_motion most": lambda v, _: _s("MassSpringDamper")(resolution=8).plate_motion(_plate(), (0.1, 0.1), [(0.2, 0.1)], [1.0] * 9, 8000.0, max_frequency_hz=v),
    "ModalPlate loss": lambda v, _: _s("ModalPlate")(loss_floor=v),
    "ModalPlate drive": _field("ModalPlate", drive=1),
    "ModalPlate points": _field("ModalPlate", points=1),
    "ModalPlate frequencies": _field("ModalPlate", frequencies=1),
    "InfinitePlate points": _field("InfinitePlate", points=1),
    "InfinitePlate frequencies": _field("InfinitePlate", frequencies=1),
    "ExponentialPlate frequencies": _field("ExponentialPlate", frequencies=1),
    "ExponentialPlate points": _field("ExponentialPlate", points=1),
    "MassSpringDamper frequencies": _field("MassSpringDamper", frequencies=1),
    "AutoFidelity frequencies": _field("AutoFidelity", frequencies=1),
    "AutoFidelity tolerance": lambda v, _: _s("AutoFidelity")(tolerance_db=v),
    "ExponentialPlate hops": lambda v, _: _s("ExponentialPlate")(max_hops=v),
    "ExponentialPlate loss": lambda v, _: _s("ExponentialPlate")(interface_loss_db=v),
    "ExponentialPlate floor": lambda v, _: _s("ExponentialPlate")(floor_db=v),
    "FullPropagation hops": lambda v, _: _s("FullPropagation")(max_hops=v),
    **{f"network {place}": partial(_network, place=place) for place in ("point", "weight", "hz", "mass", "query")},
    "Bands": lambda v, _: _s("Bands")((v, 100.0)).widths_hz,
    "Bands.third_octaves low": lambda v, _: _s("Bands").third_octaves(v, 1000.0),
    "Bands.third_octaves high": lambda v, _: _s("Bands").third_octaves(10.0, v),
    "AudioClip sample": lambda v, _: _clip(samples=[[v]] * 100),
    "AudioClip rate": lambda v, _: _clip(sample_rate_hz=v),
    "select_clip of rate": lambda v, _: _s("select_clip")([_clip(sample_rate_hz=v), _clip()]),
    "SourceState intensity": lambda v, _: _state(intensity=v),
    "SourceState name": lambda v, _: _state(name=v),
    "SourceState needs": lambda v, _: _state(needs_contact=v),
    **{f"synth {name}": partial(lambda v, _, name: _synth(v, name), name=name) for name in ("intensity", "size_m", "seed", "keywords", "state")},
    "synth size of one": lambda v, _: _synth((v, 1.0, 1.0), "size_m"),
    "ObjectHaptics size": lambda v, _: _haptics(estimated_size_m=(v, 1.0, 1.0)),
    "ObjectHaptics confidence": lambda v, _: _haptics(confidence=v),
    "HapticLoop hz": lambda v, _: _s("HapticLoop")(_clip(), _clip(), v, v),
    **{f"ActuatorProfile {name}": partial(lambda v, _, name: _actuator(**{name: v}), name=name) for name in ("min_frequency_hz", "max_frequency_hz", "resonance_hz", "q", "max_amplitude", "max_rms", "rms_window_s", "name")},
    "ActuatorProfile response": lambda v, _: _actuator(response_db=((v, 0.0), (100.0, v))),
    "ActuatorProfile response whole": lambda v, _: _actuator(response_db=v),
    **{f"ConversionContext {name}": partial(lambda v, _, name: _context(**{name: v}), name=name) for name in ("intensity", "own_hz", "target_hz", "actuator", "neighbours_hz")},
    "Override gain": lambda v, _: _s("Override")(gain_db=v),
    "bundle.override gain": lambda v, room: _s("HapticBundle").load(room).override("phone", gain_db=v),
    "bundle.override id": lambda v, room: _s("HapticBundle").load(room).override(v, gain_db=1.0),
    "bundle.override material": lambda v, room: _s("HapticBundle").load(room).override("phone", material=v),
    "bundle.gain_db": lambda v, room: _s("HapticBundle").load(room).gain_db(v),
    "ContactGraph tolerance": lambda v, room: _s("ContactGraph")(_s("HapticBundle").load(room).snapshot, tolerance_m=v),
    "ContactGraph pose": lambda v, room: _s("ContactGraph")(_s("HapticBundle").load(room).snapshot).pose(v),
    "ContactGraph moved": lambda v, room: _s("ContactGraph")(_s("HapticBundle").load(room).snapshot).update({"fan": v}),
    "ContactGraph moved far": lambda v, room: _s("ContactGraph")(_s("HapticBundle").load(room).snapshot).update({"fan": _s("Pose")((v, 0, 0))}),
    "PoseTable positions": lambda v, room: _s("PoseTable")(["a"], [[v, 0, 0]], [[0, 0, 0, 1]]),
    "PoseTable rotations": lambda v, room: _s("PoseTable")(["a"], [[0, 0, 0]], [[0, 0, 0, v]]),
    "PoseTable ids": lambda v, room: _s("PoseTable")([v], [[0, 0, 0]], [[0, 0, 0, 1]]),
    "Touch point": lambda v, room: _played(room, lambda s: s.update({}, [_s("Touch")("left", "table", (v, 0, 0))])),
    "Touch point whole": lambda v, room: _played(room, lambda s: s.update({}, [_s("Touch")("left", "table", v)])),
    "Touch object": lambda v, room: _played(room, lambda s: s.update({}, [_s("Touch")("left", v, (0, 0, 0))])),
    "Touch hand": lambda v, room: _played(room, lambda s: s.update({}, [_s("Touch")(v, "table", (0, 0, 0))])),
    "session touches": lambda v, room: _played(room, lambda s: s.update({}, v)),
    "session touch": lambda v, room: _played(room, lambda s: s.update({}, [v])),
    "session moved one": lambda v, room: _played(room, lambda s: s.update({"fan": v}, [])),
    "session moved far": lambda v, room: _played(room, lambda s: s.update({"fan": _s("Pose")((v, 0, 0))}, [])),
    "session contact weight": lambda v, room: _played(room, lambda s: s.update({}, [], contacts=[_s("Contact")("fan", "table", (0, 0, 0), weight=v)])),
    "session contact point": lambda v, room: _played(room, lambda s: s.update({}, [], contacts=[_s("Contact")("fan", "table", (v, 0, 0))])),
    "session at_sample": lambda v, room: _played(room, lambda s: s.update({}, [], at_sample=v)),
    "session set_source gain": lambda v, room: _played(room, lambda s: s.set_source("fan", gain_db=v)),
    "session set_source id": lambda v, room: _played(room, lambda s: s.set_source(v, on=True)),
    "session set_source state": lambda v, room: _played(room, lambda s: s.set_source("fan", state=v)),
    "session set_source on": lambda v, room: _played(room, lambda s: s.set_source("fan", on=v)),
    "session set_user": lambda v, room: _played(room, lambda s: s.set_user(gain_db=v)),
    "session set_user mute": lambda v, room: _played(room, lambda s: s.set_user(mute=v)),
    "session add far": lambda v, room: _played(room, lambda s: s.add(_scene_object(pose=_s("Pose")((v, 0, 0))))),
    "session add sized": lambda v, room: _played(room, lambda s: s.add(_scene_object(geometry=_s("Box")((v, 1, 1))))),
    "session remove": lambda v, room: _played(room, lambda s: s.remove(v)),
    "session add_hand": lambda v, room: _played(room, lambda s: s.add_hand(v)),
    "session remove_hand": lambda v, room: _played(room, lambda s: s.remove_hand(v)),
    "session explain": lambda v, room: _played(room, lambda s: s.explain(v)),
    "session position_s": lambda v, room: _played(room, lambda s: s.position_s(v)),
    "session wait_prepared": lambda v, room: isinstance(v, int | float) or _played(room, lambda s: s.wait_prepared(v)),
    "session render": lambda v, room: _played(room, lambda s: s.render(v)),
    "session hand": lambda v, room: _played(room, lambda s: None, hands=("left", v)),
    "session bands": lambda v, room: _played(room, lambda s: None, bands=v),
    "session bands edges": lambda v, room: _played(room, lambda s: None, bands=(10.0, v)),
    "session actuator": lambda v, room: _played(room, lambda s: None, actuator=v),
    "session tolerance": lambda v, room: _played(room, lambda s: None, contact_tolerance_m=v),
    "session period": lambda v, room: _played(room, lambda s: None, control_period_s=v),
    "session config": lambda v, room: _s("HapticSession")(_s("HapticBundle").load(room).snapshot, _s("HapticBundle").load(room), v),
    "TouchTrack.parse": lambda v, room: _s("TouchTrack").parse(v),
    "play_track rate": lambda v, room: _s("play_track")(_session(room), _s("TouchTrack")(duration_s=0.1, steps=()), _s("MemorySink")(), update_rate_hz=v),
    "SerialAmplifierSink baud": lambda v, _: _s("SerialAmplifierSink")("/dev/no", baud_rate=v),
    "SerialAmplifierSink rate": lambda v, _: _s("SerialAmplifierSink")("/dev/no", sample_rate_hz=v),
    "SerialAmplifierSink buffer": lambda v, _: _s("SerialAmplifierSink")("/dev/no", buffer_s=v),
    "SerialAmplifierSink block": lambda v, _: _s("SerialAmplifierSink")("/dev/no", block_frames=v),
    "SoundCardSink latency": lambda v, _: _s("SoundCardSink")(latency=v),
    "SoundCardSink channels": lambda v, _: _s("SoundCardSink")(channels=[v]),
    "SoundCardSink block": lambda v, _: _s("SoundCardSink")(block_frames=v),
    "UdpSink port": lambda v, _: _s("UdpSink")(port=v),
    "UdpSink rate": lambda v, _: _s("UdpSink")(sample_rate_hz=v),
    "UdpSink block": lambda v, _: _s("UdpSink")(block_frames=v),
    "VhpSink board": lambda v, _: _s("VhpSink")("/dev/no", board=v),
    "MemorySink.pull": lambda v, room: _pull(v, room),
    "OpenAIBackend timeout": lambda v, _: _s("OpenAIBackend")(timeout_s=v),
    "OpenAIBackend key": lambda v, _: _s("OpenAIBackend")(api_key=v),
    "LocalBackend ctx": lambda v, _: _s("LocalBackend")("m", base_url="http://127.0.0.1:9", num_ctx=v),
    "LocalBackend seed": lambda v, _: _s("LocalBackend")("m", base_url="http://127.0.0.1:9", seed=v),
    "LocalBackend timeout": lambda v, _: _s("LocalBackend")("m", base_url="http://127.0.0.1:9", timeout_s=v),
    "LocalBackend top_p": lambda v, _: _s("LocalBackend")("m", base_url="http://127.0.0.1:9", top_p=v),
    "LocalBackend extra": lambda v, _: _s("LocalBackend")("m", base_url="http://127.0.0.1:9", extra={"x": v}),
    "BudgetBackend calls": lambda v, _: _s("BudgetBackend")("lexicon", max_calls=v),
    "BudgetBackend cost": lambda v, _: _s("BudgetBackend")("lexicon", max_cost=v),
    "BudgetBackend prices": lambda v, _: _s("BudgetBackend")("lexicon", prices={"m": v}),
    "Price": lambda v, _: _s("Price")(v, 1.0),
    "RepairBackend": lambda v, _: _s("RepairBackend")("lexicon", v),
    "RetryBackend": lambda v, _: _s("RetryBackend")("lexicon", v),
    "standard_stack": lambda v, _: _s("standard_stack")("lexicon", retries=v),
    "bake config": lambda v, room: _s("bake")(_scene(room), v),
    "bake temperature": lambda v, room: _s("bake")(_scene(room), {"temperature": v}),
    "bake actuator": lambda v, room: _s("bake")(_scene(room), {"actuator": v}),
    "bake spread": lambda v, room: _s("bake")(_scene(room), {"spread": {"octaves": v, "level_db": v}}),
    "bake concurrency": lambda v, room: _s("bake")(_scene(room), {"concurrency": v}),
    "rebake config": lambda v, room: _s("rebake")(_s("HapticBundle").load(room), v),
    "capture size": lambda v, room: _s("capture_images")(_scene(room), size_px=v),
    "capture config": lambda v, room: _s("capture_images")(_scene(room), config=v),
    "load_scene unit": lambda v, room: _s("load_scene")(room.parent.parent / "scene.json", unit_m=v),
    "load_scene group": lambda v, room: _s("load_scene")(room.parent.parent / "scene.json", group=v),
    "load_scene axis": lambda v, room: _s("load_scene")(room.parent.parent / "scene.json", up_axis=v),
    "infer config": lambda v, room: _s("infer_haptics")(_scene(room), _s("LexiconBackend")(), config=v),
}  # fmt: skip

ARRAYS: dict[str, tuple[int, int, Entry]] = {
    "Pose.to_world": (4, 3, lambda a, _: _s("Pose")((1, 2, 3)).to_world(a)),
    "Pose.to_own": (4, 3, lambda a, _: _s("Pose")((1, 2, 3)).to_own(a)),
    "Pose.from_matrix": (4, 4, lambda a, _: _s("Pose").from_matrix(a)),
    "TriMesh vertices": (4, 3, lambda a, _: _s("TriMesh")(a, [[0, 1, 2]])),
    "TriMesh faces": (4, 3, lambda a, _: _s("TriMesh")(np.eye(3), a)),
    "AudioClip": (400, 2, lambda a, _: _clip(samples=a)),
    "PoseTable positions": (4, 3, lambda a, _: _s("PoseTable")(list("abcd"), a, [[0, 0, 0, 1]] * 4)),
    "PoseTable rotations": (4, 4, lambda a, _: _s("PoseTable")(list("abcd"), [[0, 0, 0]] * 4, a)),
    "plate points": (4, 2, lambda a, _: _s("ModalPlate")().plate_transfer(_plate(), (0.1, 0.1), a, [100.0])),
    "plate frequencies": (4, 1, lambda a, _: _s("ModalPlate")().plate_transfer(_plate(), (0.1, 0.1), [(0.2, 0.2)], a)),
    "infinite points": (4, 2, lambda a, _: _s("InfinitePlate")().plate_transfer(_plate(), (0.1, 0.1), a, [100.0])),
    "exponential points": (4, 2, lambda a, _: _s("ExponentialPlate")().plate_transfer(_plate(), (0.1, 0.1), a, [100.0])),
    "wavenumber": (4, 1, lambda a, _: _plate().wavenumber_rad_m(a)),
    "network query": (4, 3, lambda a, room: _query(a)),
    "on_body": (4, 3, lambda a, room: _net().on_body("a", a)),
    "session touches": (3, 3, lambda a, room: _played(room, lambda s: s.update({}, a))),
    "plate_motion": (9, 1, lambda a, _: _s("MassSpringDamper")(resolution=8).plate_motion(_plate(), (0.1, 0.1), [(0.2, 0.1)], a, 8000.0)),
}  # fmt: skip


def _scene(room: Path) -> Any:
    return _s("load_scene")(room.parent.parent / "scene.json")


def _net() -> Any:
    bodies = {"a": _plate(), "b": _s("RigidBody")(1.0)}
    contact = _s("Contact")("a", "b", (0.1, 0.1, 0.0))
    return _s("ContactNetwork")(bodies, [contact], {"a": _s("Pose")(), "b": _s("Pose")()})


def _query(points: Any) -> Any:
    excitations = [_s("Excitation")("b", 100.0, 100.0)]
    return _s("ExponentialPlate")().prepare(_net(), excitations, _s("Bands").dominant()).attenuation("a", points)


def _pull(frames: Any, room: Path) -> Any:
    sink = _s("MemorySink")()
    bundle = _s("HapticBundle").load(room)
    with _s("HapticSession")(bundle.snapshot, bundle, {"prepare": "blocking"}, sink=sink):
        return sink.pull(frames)


def _of_array(entry: Callable[[Any, Path], object], value: str, rows: int, columns: int, room: Path) -> object:
    return entry(arrays(rows, columns)[value], room)


def every() -> Iterator[tuple[str, Callable[[Path], object]]]:
    """Yield a name and a function of the bundle's folder for every entry with every value."""
    for (name, entry), value in itertools.product(NUMBERS.items(), SCALARS):
        yield f"{name} = {value}", partial(entry, SCALARS[value])
    for name, (rows, columns, entry) in ARRAYS.items():
        for value in arrays(rows, columns):
            yield (
                f"{name} of array: {value}",
                partial(_of_array, entry, value, rows, columns),
            )


def attacks(seed: int, work: Path) -> Iterator[Attack]:
    """Attacks by eight pairs of entry and value each, drawn from the seed. Without end."""
    room = bundles.sound(work)
    cases = list(every())
    for number in itertools.count():
        rng = random.Random(f"library/{seed}/{number}")
        drawn = rng.sample(cases, 8)
        name = f"{number} {', '.join(name for name, _ in drawn[:1])} and others"
        yield Attack("library", name, (), call=partial(_tried, drawn, room), untouched=(room,))


def _tried(drawn: list[tuple[str, Callable[[Path], object]]], room: Path) -> int:
    return max([_one(name, entry, room) for name, entry in drawn])


def _one(name: str, entry: Callable[[Path], object], room: Path) -> int:
    from scene2hap.errors import Scene2HapError

    print(name.encode("ascii", "backslashreplace").decode())
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            made = entry(room)
    except Scene2HapError as error:
        return printed(error)
    if not is_harmless(made) and not name.startswith("Pose.to_"):  # a change of coordinates returns any number
        raise AssertionError(f"{name} gave a number that is none, or one outside of [-1, 1]")
    return 0
