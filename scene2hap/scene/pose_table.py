"""Poses of many objects as arrays, as engines store them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike

from scene2hap.common import checks
from scene2hap.common.arrays import Floats, Indices, floats
from scene2hap.common.calls import clear_construction
from scene2hap.common.counted import counted
from scene2hap.errors import SceneError
from scene2hap.scene.pose import LEAST_LENGTH, UNIT_TOLERANCE, Pose

_MOST = 10_000_000  # only an endless generator exceeds this


@clear_construction
class PoseTable(Mapping[str, Pose]):
    """A mapping from id to `Pose` over an engine's arrays, which builds each pose at its access.

    Parameters: ids : n ids, each once; positions_m : (n, 3) [m]; rotations_xyzw : (n, 4), quaternions in glTF order,
        normalised if they are not. The arrays are copied. Reading is fastest if tables share one tuple of ids.
    Raises: SceneError: wrong shapes, a duplicate id, a number that is not finite, a rotation of length 0.
    """

    __slots__ = ("_row", "ids", "positions_m", "rotations_xyzw")

    def __init__(self, ids: Sequence[str], positions_m: ArrayLike, rotations_xyzw: ArrayLike) -> None:
        self.ids: tuple[str, ...] = checks.items("ids", ids, at_most=_MOST, error=SceneError)
        n = len(self.ids)
        self.positions_m: Floats = self._rows("positions_m", positions_m, (n, 3))
        rotations = self._rows("rotations_xyzw", rotations_xyzw, (n, 4))
        x, y, z, w = rotations.T
        lengths = np.sqrt(x * x + y * y + z * z + w * w)
        off = np.abs(lengths - 1.0) > UNIT_TOLERANCE
        if off.any():
            if (lengths < LEAST_LENGTH).any():
                thing = self.ids[int(np.argmin(lengths))]
                raise SceneError(f"rotations_xyzw of {thing!r} has length 0. Use (0, 0, 0, 1) for no rotation.")
            rotations /= np.where(off, lengths, 1.0)[:, None]
        self.rotations_xyzw: Floats = rotations
        self._row: dict[str, int] | None = None

    def __repr__(self) -> str:
        return f"PoseTable({counted(len(self.ids), 'pose')})"

    @property
    def row(self) -> Mapping[str, int]:
        """The row of each id."""
        if self._row is None:
            self._row = {object_id: row for row, object_id in enumerate(self.ids)}
            if len(self._row) < len(self.ids):
                twice = next(x for k, x in enumerate(self.ids) if self._row[x] != k)
                raise SceneError(f"id {twice!r} is twice in a PoseTable; give each thing one pose.")
        return self._row

    def __getitem__(self, object_id: str) -> Pose:
        row = self.row[object_id]
        x, y, z = self.positions_m[row].tolist()
        return Pose.of_checked((x, y, z), tuple(self.rotations_xyzw[row].tolist()))

    def poses(self, rows: Indices) -> dict[str, Pose]:
        """Return the poses in some rows, by id; faster than one by one."""
        x, y, z = self.positions_m[rows].T.tolist()
        qx, qy, qz, qw = self.rotations_xyzw[rows].T.tolist()
        ids, of_checked = self.ids, Pose.of_checked
        found = zip(rows.tolist(), zip(x, y, z, strict=True), zip(qx, qy, qz, qw, strict=True), strict=True)
        return {ids[row]: of_checked(position, rotation) for row, position, rotation in found}

    def __contains__(self, object_id: object) -> bool:
        return object_id in self.row

    def __iter__(self) -> Iterator[str]:
        return iter(self.row)

    def __len__(self) -> int:
        return len(self.ids)

    def _rows(self, name: str, values: ArrayLike, shape: tuple[int, int]) -> Floats:
        rows = np.array(floats(name, values, "m" if shape[1] == 3 else "-", error=SceneError), order="C")
        if rows.shape != shape:
            raise SceneError(f"{name} has shape {rows.shape}; it must be {shape}, one row for each id.")
        if not np.isfinite(rows).all():
            row = int(np.argwhere(~np.isfinite(rows))[0, 0])
            raise SceneError(f"{name} of {self.ids[row]!r} is {rows[row].tolist()}; it must be finite.")
        return rows
