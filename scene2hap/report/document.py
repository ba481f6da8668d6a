"""The contents of a report as plain data: the scene, inferred properties, sounds, contacts, and the felt map.

Large arrays are base64 of little-endian numbers. All texts come from scenes, models and users, so the page shows them
as plain text, never as HTML.
"""

from __future__ import annotations

import base64
import hashlib
import os
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from typing import Any

import numpy as np
from numpy.typing import NDArray

from scene2hap import __version__
from scene2hap.audio.haptic_loop import HapticLoop
from scene2hap.bundle import HapticBundle, Override
from scene2hap.bundle.account import read_account
from scene2hap.bundle.arguments import given_bundle
from scene2hap.common import checks
from scene2hap.common.calls import clear_call
from scene2hap.common.counted import counted, first_of
from scene2hap.common.warning import warn_of
from scene2hap.errors import ConfigError, UnknownMaterial
from scene2hap.haptics import ObjectHaptics, SourceState, is_unknown
from scene2hap.materials import Material, lookup
from scene2hap.propagation.exponential_plate import ExponentialPlate
from scene2hap.report.account import account_table
from scene2hap.report.felt_map import MODELS, FeltMap, felt_map, prepared_session
from scene2hap.report.felt_paths import ScenePaths
from scene2hap.report.omitted_objects import left_out
from scene2hap.report.sounds import LoopPairs
from scene2hap.report.surface_points import MOST_POINTS
from scene2hap.report.walls import Direction, shells, walls
from scene2hap.scene.objects import SceneObject
from scene2hap.scene.snapshot import SceneSnapshot
from scene2hap.session import Touch

FORMAT, VERSION = "scene2hap/report", 1

_LOW_DB, _HIGH_DB = -20.0, 50.0
"""Range of levels on the page. Levels below it are far from felt; no actuator reaches levels above it."""
_MOST_PATHS = 65_535
_CONSTANTS = (
    ("density", "kg/m³", "density_kg_m3", 1.0),
    ("Young's modulus", "GPa", "youngs_modulus_pa", 1e-9),
    ("Poisson's ratio", "-", "poisson_ratio", 1.0),
    ("loss factor", "-", "loss_factor", 1.0),
)


@clear_call
def report_document(
    bundle: HapticBundle | str | os.PathLike[str],
    *,
    models: Sequence[Any] = MODELS,
    pictures: SceneSnapshot | None = None,
    most_points: int = MOST_POINTS,
    account: Mapping[str, Any] | None = None,
) -> dict[str, Any]:
    """Return all visible and audible content of a bundle as JSON values; docs/report.md has the fields.

    Parameters:
    bundle : a HapticBundle, or the path of its folder.
    models : kinds or settings of the propagation models of the felt map. Models that resonate take milliseconds for
        each point.
    pictures : the baked scene with `capture_images`, for pictures and colours, which a bundle does not store.
    most_points : most surface points of the felt map.
    account : calls, tokens, cost and skipped questions of the bake, as `InferenceReport.as_json` returns them. The
        default is the file that `scene2hap bake` wrote beside the bundle, if `bundle` is the path of its folder.
    Raises: ConfigError: no such model, or a malformed account; ModelDomainError: a model does not hold in this scene.
    BundleError: the bundle or its account cannot be read.
    """
    most_points = checks.whole("most_points", most_points, "-", at_least=1, at_most=200_000, error=ConfigError)
    if account is None and isinstance(bundle, str | os.PathLike):
        account = read_account(bundle)
    bundle = given_bundle(bundle)
    scene = bundle.snapshot
    meshes: dict[str, int] = {}
    whole = shells(scene)
    hides: dict[str, Direction | None] = {**walls(scene, bundle.loops), **dict.fromkeys(whole)}
    # A hand is laid on a source, even if the source encloses the scene, as a machine does that is a scene of its own.
    off_map = whole - bundle.loops.keys()
    scene_paths = ScenePaths(bundle)
    felt = felt_map(bundle, models, scene_paths=scene_paths, shells=off_map, most_points=most_points)
    looks = {} if pictures is None else _looks(pictures, scene)
    loops = LoopPairs()
    objects = [_object(bundle, item, looks.get(item.id), meshes, loops, hides) for item in scene.objects]
    made = bundle.made_with
    return {
        "format": FORMAT,
        "version": VERSION,
        "scene": scene.name,
        "category": bundle.scene_category,
        "up_axis": scene.up_axis,
        "made": {
            "scene2hap": __version__,
            "actuator": "" if made is None else made.actuator.name,
            "seed": None if made is None else made.seed,
        },
        "counters": _counters(bundle),
        "left_out": left_out(bundle, felt, off_map),
        "warnings": [str(found) for found in scene.check()],
        "account": None if account is None else account_table(account),
        "meshes": _meshes(scene, meshes),
        "loops": loops.shown,
        "objects": objects,
        "contacts": _contacts(bundle, scene_paths),
        "felt": _felt(felt),
        "credits": _credits(bundle),
    }


def _object(
    bundle: HapticBundle,
    item: SceneObject,
    looks: SceneObject | None,
    meshes: dict[str, int],
    loops: LoopPairs,
    hides: Mapping[str, Direction | None],
) -> dict[str, Any]:
    haptics = bundle.objects.get(item.id)
    wish = bundle.overrides.get(item.id)
    return {
        "id": item.id,
        "name": item.name,
        "mesh": meshes.setdefault(item.geometry.mesh.digest, len(meshes)),
        "position_m": list(item.pose.position_m),
        "rotation_xyzw": list(item.pose.rotation_xyzw),
        "color": _color(item if looks is None else looks),
        "is_shell": item.id in hides,
        "outward": hides.get(item.id),
        "is_source": bool(bundle.loops.get(item.id)),
        "override": None if wish is None else _said(wish),
        "pictures": [] if looks is None or looks.images is None else _pictures(looks),
        **(_NOTHING_INFERRED if haptics is None else _inferred(bundle, item, haptics, loops)),
    }


_NOTHING_INFERRED: Mapping[str, Any] = {
    "vibrates": False,
    "category": "unknown",
    "material": "unknown",
    "confidence": 0.0,
    "facts": [],
    "reasons": [],
    "constants": [],
    "editable": None,
    "states": [],
}


def _inferred(bundle: HapticBundle, item: SceneObject, haptics: ObjectHaptics, loops: LoopPairs) -> dict[str, Any]:
    return {
        "vibrates": haptics.vibrates,
        "category": haptics.object_category,
        "material": haptics.material_category,
        "confidence": haptics.confidence,
        "facts": _facts(item, haptics, bundle),
        "reasons": [list(reason) for reason in haptics.reasons.items()],
        "constants": [] if haptics.material is None else _constants(haptics.material),
        "editable": _editable(bundle, item, haptics),
        "states": [_state(bundle, item.id, state, loops) for state in haptics.states],
    }


def _facts(item: SceneObject, haptics: ObjectHaptics, bundle: HapticBundle) -> list[list[str]]:
    by = haptics.provenance
    whole = " × ".join(f"{edge:.2f}" for edge in item.whole_size_m(bundle.snapshot.up_axis))
    surface = " × ".join(f"{1e3 * edge:.0f}" for edge in haptics.estimated_size_m)
    mass = "unknown" if haptics.mass_kg is None else f"{haptics.mass_kg:.3g} kg"
    feet = "" if haptics.feet is None else haptics.feet.name
    rows = [
        ("category", haptics.object_category, by.get("object_category", "")),
        ("material", haptics.material_category, by.get("material", by.get("material_category", ""))),
        ("whole size", f"{whole} m", "geometry"),
        ("main surface", f"{surface} mm", by.get("estimated_size_m", "geometry")),
        ("mass", mass, by.get("mass_kg", "")),
        ("feet", feet, by.get("feet", "")),
        ("usage", haptics.usage, by.get("usage", "")),
    ]
    return [list(row) for row in rows if row[1]]


def _constants(material: Material) -> list[list[Any]]:
    try:
        row: Material | None = lookup(material.name)
    except UnknownMaterial:
        row = None
    return [
        [
            label,
            unit,
            float(f"{getattr(material, name) * factor:.4g}"),
            None if row is None else float(f"{getattr(row, name) * factor:.4g}"),
        ]
        for label, unit, name, factor in _CONSTANTS
    ]


def _said(wish: Override) -> dict[str, Any]:
    """Return a person's corrections as texts and numbers."""
    said = wish.corrections()
    for name in {"material", "feet"} & said.keys():
        said[name] = said[name].name
    if wish.clip is not None:
        said["clip"] = wish.clip.credit.title
    return said


def _editable(bundle: HapticBundle, item: SceneObject, haptics: ObjectHaptics) -> dict[str, Any]:
    object_id = item.id
    wish = bundle.overrides.get(object_id, Override())
    return {
        "name": item.name if wish.name is None else wish.name,
        "material": "" if haptics.material is None else haptics.material.name,
        "thickness_m": float(f"{haptics.estimated_size_m[2]:.4g}"),
        "mass_kg": haptics.mass_kg,
        "gain_db": bundle.gain_db(object_id),
        "vibrates": haptics.vibrates,
        "muted": bundle.is_muted(object_id),
        "locked": wish.locked,
        "states": [
            {"name": state.name, "intensity": state.intensity, "pitch_hz": wish.pitch_of(state.name)}
            for state in haptics.states
        ],
    }


def _state(bundle: HapticBundle, object_id: str, state: SourceState, loops: LoopPairs) -> dict[str, Any]:
    loop = bundle.loops.get(object_id, {}).get(state.name)
    felt = None
    if loop is not None and loop.felt is not None:
        felt = {**asdict(loop.felt), "raw_hz": loop.frequency_raw_hz}
    return {
        "name": state.name,
        "intensity": state.intensity,
        "sentence": state.sentence,
        "keywords": state.keywords,
        "needs_contact": state.needs_contact,
        "felt": felt,
        "credit": "" if loop is None else _credit(loop),
        "choices": bundle.choices.get(object_id, {}).get(state.name, ""),
        "loop": None if loop is None else loops.number(loop),
    }


def _contacts(bundle: HapticBundle, scene_paths: ScenePaths) -> list[dict[str, Any]]:
    """Return the contacts, and the gain of the strongest source at each [dB], by the session's default model."""
    contacts = scene_paths.contacts
    if not contacts:
        return []
    gains = np.zeros(len(contacts))
    if bundle.loops:
        session = prepared_session(bundle, ExponentialPlate(), scene_paths)
        touches = [Touch("hand", contact.b, contact.point_m) for contact in contacts]
        gains = session.would_feel(touches).max(axis=(1, 2), initial=0.0)
    return [
        {
            "a": contact.a,
            "b": contact.b,
            "point_m": list(contact.point_m),
            "passes_db": round(20.0 * float(np.log10(gain)), 1) if gain > 0.0 else None,
        }
        for contact, gain in zip(contacts, gains, strict=True)
    ]


def _felt(felt: FeltMap) -> dict[str, Any]:
    return {
        "models": list(felt.models),
        "bands": list(felt.bands),
        "sources": list(felt.sources),
        "patches": [
            {
                "object": patch.object_id,
                "points_m": _base64(patch.points_m, "<f4"),
                "faces": _base64(patch.faces, "<u4"),
                "n_points": len(patch.points_m),
                "n_faces": len(patch.faces),
            }
            for patch in felt.patches
        ],
        "levels": {
            model: {
                source: {band: base64.b64encode(level_bytes(levels)).decode() for band, levels in bands.items()}
                for source, bands in sources.items()
            }
            for model, sources in felt.levels_db.items()
        },
        "paths": {
            model: {
                source: {"objects": [list(way) for way in ways.objects], "of_points": path_bytes(ways.of_points)}
                for source, ways in sources.items()
            }
            for model, sources in felt.paths.items()
        },
        "low_db": _LOW_DB,
        "high_db": _HIGH_DB,
    }


def level_bytes(levels_db: NDArray[np.float32]) -> bytes:
    """Encode levels [dB] as two bytes each: 0 for -inf, else 1 to 65,535 over the page's range, in steps of about
    1 mdB."""
    share = (np.clip(levels_db, _LOW_DB, _HIGH_DB) - _LOW_DB) / (_HIGH_DB - _LOW_DB)
    arrives = np.isfinite(levels_db)
    steps = np.where(arrives, np.round(np.where(arrives, share, 0.0) * 65_534.0) + 1.0, 0.0)
    return steps.astype("<u2").tobytes()


def path_bytes(of_points: NDArray[np.uint32]) -> str:
    """Encode numbers of paths as two bytes each. A number that needs more becomes 0."""
    return _base64(np.where(of_points <= _MOST_PATHS, of_points, 0), "<u2")


def _counters(bundle: HapticBundle) -> list[list[str]]:
    objects = bundle.objects.values()
    n_states = sum(map(len, bundle.loops.values()))
    unknown = sum(is_unknown(haptics.object_category) for haptics in objects)
    answered = {who for haptics in objects if (who := haptics.provenance.get("object_category", ""))}
    models = sorted({who.split(",")[0] for who in answered if not who.startswith("error")})
    rows = [
        ("objects", str(len(bundle.snapshot.objects))),
        ("unknown", str(unknown)),
        ("sources", str(len(bundle.loops))),
        ("states with a loop", str(n_states)),
        ("corrected by a person", str(len(bundle.overrides))),
        ("answered by", first_of(models, 3)),
    ]
    return [list(row) for row in rows if row[1]]


def _credits(bundle: HapticBundle) -> list[list[str]]:
    """Return each used sound once, with its credit."""
    rows = {
        (f"{object_id}, {state}", _credit(loop))
        for object_id, loops in bundle.loops.items()
        for state, loop in loops.items()
    }
    return [list(row) for row in sorted(rows)]


def _credit(loop: HapticLoop) -> str:
    credit = loop.audible.credit
    return ", ".join(part for part in (credit.title, credit.author, credit.licence, credit.address) if part)


def _meshes(scene: SceneSnapshot, numbers: Mapping[str, int]) -> list[dict[str, Any]]:
    by_digest = {item.geometry.mesh.digest: item.geometry.mesh for item in scene.objects}
    return [
        {
            "vertices": _base64(by_digest[digest].vertices_m, "<f4"),
            "faces": _base64(by_digest[digest].faces, "<u4"),
            "n_vertices": len(by_digest[digest].vertices_m),
            "n_faces": len(by_digest[digest].faces),
        }
        for digest in numbers
    ]


def _looks(pictures: SceneSnapshot, scene: SceneSnapshot) -> dict[str, SceneObject]:
    """Return the objects that have pictures, by id. Warns: SceneWarning: some of the scene's objects are not there."""
    looks = {item.id: item for item in pictures.objects}
    missing = [item.id for item in scene.objects if item.id not in looks]
    if missing:
        warn_of(
            f"{len(missing)} of {counted(len(scene.objects), 'object')} are not in the scene of the pictures, and are "
            f"shown without: {first_of([repr(one) for one in missing], 3)}. Read that scene as it was baked: the same "
            "file, --group and --names."
        )
    return looks


def _pictures(item: SceneObject) -> list[str]:
    assert item.images is not None
    shown = [*item.images.isolated[:1], *item.images.context[:1]]
    return [f"data:image/png;base64,{base64.b64encode(png).decode()}" for png in shown]


def _color(item: SceneObject) -> list[float]:
    """Return the mean colour of an object's materials; without materials, a pale colour derived from its name."""
    if item.appearance is not None and len(item.appearance.face_material):
        counts = np.bincount(item.appearance.face_material, minlength=len(item.appearance.materials))
        rgb = np.array([material.color_rgba[:3] for material in item.appearance.materials])
        return [round(float(value), 3) for value in counts @ rgb / counts.sum()]
    digest = hashlib.sha256(item.name.encode("utf-8", "replace")).digest()
    return [round(0.55 + 0.3 * byte / 255, 3) for byte in digest[:3]]


def _base64(values: NDArray[Any], dtype: str) -> str:
    return base64.b64encode(np.ascontiguousarray(values, dtype=dtype).tobytes()).decode()
