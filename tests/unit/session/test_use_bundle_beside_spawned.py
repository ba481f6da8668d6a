"""A corrected bundle does not replace what the game has put in the place of one of its objects."""

from dataclasses import replace

from scene2hap import Box, HapticBundle, HapticSession, Pose, SceneObject, bake_object
from scenes import table_with_two_phones


def corrected(bundle: HapticBundle, source_id: str) -> HapticBundle:
    """A bundle in which a designer has changed the material and the level of a source."""
    return bundle.override(source_id, material="steel", gain_db=-9.0)


def test_a_spawned_copy_under_a_baked_id_keeps_its_own_data() -> None:
    _, bundle = table_with_two_phones()
    taken, other = bundle.loops
    session = HapticSession(bundle, config={"prepare": "blocking"})
    session.remove(taken)
    fan = bake_object(SceneObject("electric fan", geometry=Box((0.3, 0.4, 0.3))))
    session.spawn(fan, taken, Pose((0.5, 0.92, 0.4)))
    before = session.source(taken)
    session.use_bundle(corrected(corrected(bundle, taken), other))
    assert session.source(taken) == before
    assert session.source(other).gain_db == -9.0


def test_a_second_correction_reaches_what_the_first_left_unchanged() -> None:
    _, bundle = table_with_two_phones()
    first, second = bundle.loops
    session = HapticSession(bundle, config={"prepare": "blocking"})
    # As from the disk: equal data, but other objects.
    once = replace(corrected(bundle, first), objects={x: replace(one) for x, one in bundle.objects.items()})
    session.use_bundle(once)
    session.use_bundle(corrected(once, second))
    assert session.source(second).gain_db == -9.0
