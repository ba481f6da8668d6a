"""The built-in kitchen: a scene with the seven sources of the paper's third study, and a tour of it.

`examples/build_demo_kitchen.py` builds the scene; the tour's distances are measured from the microwave's feet.
"""

from __future__ import annotations

from importlib.resources import as_file, files
from pathlib import Path


def kitchen_path() -> Path:
    """The demo kitchen as a GLB file."""
    return _file("kitchen.glb")


def tour_path() -> Path:
    """A tour of the kitchen with both hands as a file of touches."""
    return _file("tour.json")


def _file(name: str) -> Path:
    # The package is never run from inside a zip, so that the file outlives the context manager.
    with as_file(files(__package__).joinpath(name)) as path:
        return path
