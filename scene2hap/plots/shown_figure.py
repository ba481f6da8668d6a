"""A matplotlib figure that notebooks show by itself."""
# mypy: disable-error-code="misc"
# Where matplotlib is not installed, its classes have no type that one could inherit.

from __future__ import annotations

from io import BytesIO

from matplotlib.figure import Figure


class ShownFigure(Figure):
    """A Figure with a picture for notebooks, which show figures of pyplot alone otherwise."""

    def _repr_png_(self) -> bytes:
        written = BytesIO()
        self.savefig(written, format="png")
        return written.getvalue()
