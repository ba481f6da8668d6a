"""Bundles as `bake` makes them, with a tone for each sound: for tests of what is felt where."""

from __future__ import annotations

from scene2hap import HapticBundle, SceneSnapshot
from scene2hap.llm.chain import infer_haptics
from scenes import tone_loop


def with_tones(scene: SceneSnapshot) -> HapticBundle:
    """Infer a scene by the lexicon, and give each state of a source a tone; to make its sound takes half a second."""
    objects = infer_haptics(scene, "lexicon")
    sources = {key: haptics.states for key, haptics in objects.items() if haptics.vibrates}
    frequencies_hz = dict(zip(sources, range(100, 100 + 20 * len(sources), 20), strict=True))
    loops = {key: {state.name: tone_loop(frequencies_hz[key]) for state in states} for key, states in sources.items()}
    return HapticBundle(scene, "room", objects, loops)
