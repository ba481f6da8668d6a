"""Table of a bundle for notebooks: first the states of the sources, then the other objects."""

from __future__ import annotations

from collections.abc import Iterator

from scene2hap.bundle.contents import BundleContents
from scene2hap.common.counted import counted
from scene2hap.common.html_tables import html_table, number

_COLUMNS = (
    "object", "object type", "material", "state", "intensity [-]", "sound [Hz]", "vibration [Hz]",
    "level over threshold [dB]", "volume [dB]",
)  # fmt: skip


def bundle_table(bundle: BundleContents) -> str:
    """Return HTML with a row for each state of each source, and for each other object."""
    carriers = [key for key in bundle.objects if not bundle.loops.get(key)]
    n_states = sum(map(len, bundle.loops.values()))
    n_sources = sum(map(bool, bundle.loops.values()))
    actuator = f", made for the actuator {bundle.actuator.name}" if bundle.actuator is not None else ""
    title = (
        f"Bundle of scene {bundle.snapshot.name} ({bundle.scene_category}): "
        f"{counted(len(bundle.objects), 'object')}, {counted(n_sources, 'source')}{actuator}"
    )
    return html_table(title, _COLUMNS, _rows(bundle, carriers), n_states + len(carriers))


def _rows(bundle: BundleContents, carriers: list[str]) -> Iterator[tuple[str, ...]]:
    for object_id, states in bundle.loops.items():
        haptics = bundle.objects.get(object_id)
        intensities = {} if haptics is None else {state.name: state.intensity for state in haptics.states}
        volume = "muted" if bundle.is_muted(object_id) else f"{bundle.gain_db(object_id):+.1f}"
        for name, loop in states.items():
            yield (
                *_object(bundle, object_id),
                name,
                number(intensities.get(name)),
                f"{loop.frequency_raw_hz:.0f}",
                f"{loop.frequency_tactile_hz:.0f}",
                "-" if loop.felt is None else f"{loop.felt.level_db:.1f}",
                volume,
            )
    for object_id in carriers:
        yield (*_object(bundle, object_id), *["-"] * 6)


def _object(bundle: BundleContents, object_id: str) -> tuple[str, str, str]:
    haptics = bundle.objects.get(object_id)
    if haptics is None:
        return object_id, "-", "-"
    material = haptics.material.name if haptics.material is not None else "unknown"
    return object_id, haptics.object_category, material
