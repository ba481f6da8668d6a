"""Which objects are assembled of parts, whose joints lose more than the material does."""

from __future__ import annotations

from scene2hap.bundle.override import USER
from scene2hap.haptics import ObjectHaptics

ASSEMBLED_LOSS = 0.04
"""Loss factor of assembled furniture, 0.03 to 0.06; assumed."""

HEAD_NOUNS = frozenset(
    {
        "armchair",
        "bed",
        "bench",
        "bookcase",
        "bookshelf",
        "cabinet",
        "chair",
        "closet",
        "commode",
        "cot",
        "counter",
        "couch",
        "crib",
        "cupboard",
        "desk",
        "door",
        "drawer",
        "dresser",
        "island",
        "locker",
        "nightstand",
        "rack",
        "recliner",
        "shelf",
        "shelves",
        "sideboard",
        "sofa",
        "stand",
        "stool",
        "table",
        "vanity",
        "wardrobe",
        "workbench",
    }
)
"""The last words of categories that are furniture."""


def is_assembled(haptics: ObjectHaptics) -> bool:
    """Whether an object is furniture, and nobody chose its material, whose loss would then be meant."""
    head = haptics.object_category.lower().rpartition(" ")[2]
    return head in HEAD_NOUNS and haptics.provenance.get("material") != USER
