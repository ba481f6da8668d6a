"""The built-in kitchen: a scene with the seven sources of the paper's third study, and a tour of it.

`examples/build_demo_kitchen.py` builds the scene. Distances in the tour are measured from the microwave's feet.
"""

from __future__ import annotations

from importlib.resources import as_file, files
from pathlib import Path


def kitchen_path() -> Path:
    """Return the path of the demo kitchen, a GLB file."""
    return _file("kitchen.glb")


def tour_path() -> Path:
    """Return the path of a tour of the kitchen with both hands, a file of touches."""
    return _file("tour.json")


def _file(name: str) -> Path:
    # The package never runs from a zip file, so the path stays valid after the context manager ends.
    with as_file(files(__package__).joinpath(name)) as path:
        return path
