"""The errors of an export, by file."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from scene2hap.export.fidelity import Fidelity


@dataclass(frozen=True)
class FileReport:
    """One channel of one track in one format: its files, and their error, None if unknown."""

    kind: str
    track: str
    channel: str
    files: tuple[str, ...]
    duration_s: float
    fidelity: Fidelity | None

    @property
    def points_per_s(self) -> tuple[float, float]:
        """Points of amplitude and of frequency a second."""
        found = self.fidelity or Fidelity(0.0, 0.0)
        return found.amplitude_points / self.duration_s, found.frequency_points / self.duration_s

    def __str__(self) -> str:
        name = f"{self.track}.{self.channel}" if self.channel else self.track
        fidelity = str(self.fidelity) if self.fidelity is not None else "its error is unknown"
        points = ""
        if self.fidelity is not None and self.fidelity.amplitude_points:
            amplitude, frequency = self.points_per_s
            points = f"; {amplitude:.1f} amplitude and {frequency:.1f} frequency points a second"
            points += f", {self.fidelity.transients} transients"
        return f"{self.kind} {name}: {fidelity}{points}"


@dataclass(frozen=True)
class ExportReport:
    """All files of an export. `removed` are those of an earlier one whose sources no longer exist."""

    folder: str
    rows: Sequence[FileReport] = field(default_factory=tuple)
    removed: tuple[str, ...] = ()

    @property
    def files(self) -> tuple[str, ...]:
        """Names of the files, relative to the folder."""
        return tuple(dict.fromkeys(name for row in self.rows for name in row.files))

    def to_data(self) -> dict[str, Any]:
        """Return the report as plain data, for JSON. Its paths have slashes on each system."""
        return {"folder": Path(self.folder).as_posix(), "files": [asdict(row) for row in self.rows]}

    def __str__(self) -> str:
        return "\n".join(map(str, self.rows))
