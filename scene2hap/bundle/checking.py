"""What a bundle says of its objects, held against its scene: a person may have edited the file."""

from __future__ import annotations

import warnings
from collections.abc import Mapping

from scene2hap.errors import BundleError
from scene2hap.haptics import ObjectHaptics, unmet_needs
from scene2hap.scene import sizes
from scene2hap.scene.snapshot import SceneSnapshot


class BundleWarning(UserWarning):
    """Something in a bundle that can be read, and hardly means what it says."""


def require_plausible(objects: Mapping[str, ObjectHaptics], scene: SceneSnapshot) -> None:
    """Hold sizes against the measured ones, and needed contacts against what there is.

    Raises: BundleError: a size that no plate of that object has. UnknownObject.
    Warns: BundleWarning: a state that waits for a contact which nothing in the scene can give.
    """
    categories = {item.id: "" for item in scene.objects} | {key: said.object_category for key, said in objects.items()}
    for object_id, haptics in objects.items():
        measured = scene.object(object_id).size_m
        # Without a material it is no plate, and earlier versions wrote such sizes as they were measured.
        wrong = sizes.faults(haptics.estimated_size_m, measured) if haptics.material is not None else {}
        if wrong:
            told = "; ".join(f"{edge} is {why}" for edge, why in wrong.items())
            raise BundleError(f"{object_id}.estimated_size_m: {told}.")
        for doubt in unmet_needs(object_id, haptics.states, categories):
            warnings.warn(f"{object_id!r}: {doubt}.", BundleWarning, stacklevel=5)
