"""A matplotlib figure that notebooks show without pyplot."""
# mypy: disable-error-code="misc"
# Where matplotlib is not installed, its classes have no type that one could inherit.

from __future__ import annotations

from io import BytesIO

from matplotlib.figure import Figure


class ShownFigure(Figure):
    """A Figure with a picture for notebooks. Without it they show only figures of pyplot."""

    def _repr_png_(self) -> bytes:
        written = BytesIO()
        self.savefig(written, format="png")
        return written.getvalue()
