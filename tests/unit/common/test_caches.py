"""Results that are referred to stay cached, however many they are; of the others only the newest bytes."""

import weakref
from dataclasses import dataclass, replace

import pytest

from garbage import no_garbage_collection
from scene2hap import materials
from scene2hap.common.caches import cached_while_used
from scene2hap.propagation.bodies.lattice_body import lattice_body
from scene2hap.propagation.bodies.modal_body import modal_body
from scene2hap.propagation.modal.in_plane import in_plane_modes
from scene2hap.propagation.plate import Plate

PLATE = Plate(0.3, 0.2, 0.012, materials.lookup("oak"))


@dataclass(eq=False)
class Large:
    """A value of 1000 bytes."""

    number: int
    nbytes: int = 1000


def test_used_results_are_computed_once_and_the_newest_others_are_kept() -> None:
    asked: list[int] = []

    @cached_while_used
    def large(number: int) -> Large:
        asked.append(number)
        return Large(number)

    large.cache.most_bytes = 3000
    used = [large(number) for number in range(10)]
    assert [large(number) for number in range(10)] == used
    assert asked == [*range(10)]
    freed = [weakref.ref(one) for one in used]
    with no_garbage_collection():
        del used
        assert [ref() is None for ref in freed] == [True] * 7 + [False] * 3
    large(8)
    large(0)  # replaces 7, the least recently used
    assert [large(number).number for number in (0, 8, 9, 7)] == [0, 8, 9, 7]
    assert asked == [*range(10), 0, 7]
    large.cache_clear()
    large(7)
    assert asked[-1] == 7
    assert len(asked) == 13


@pytest.mark.parametrize("kind", ["modal", "lattice", "in plane"])
def test_a_scene_of_any_number_of_plates_solves_each_once(kind: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """A room has more plates than any fixed number; each change of a contact asks for all of them again."""
    for function in (modal_body, lattice_body, in_plane_modes):
        monkeypatch.setattr(function.cache, "most_bytes", 1)
    body_of = {
        "modal": lambda plate: modal_body(plate, 200.0, 0.01),
        "lattice": lambda plate: lattice_body(plate, 8, 200.0, 0.01),
        "in plane": lambda plate: in_plane_modes(plate, 1.0),
    }[kind]
    plates = [replace(PLATE, length_m=0.3 + 0.001 * n) for n in range(40 if kind == "lattice" else 140)]
    bodies = [body_of(plate) for plate in plates]
    assert all(body_of(plate) is body for plate, body in zip(plates, bodies, strict=True))
    freed = [weakref.ref(body) for body in bodies]
    with no_garbage_collection():
        del bodies
        assert sum(ref() is not None for ref in freed) <= 1
