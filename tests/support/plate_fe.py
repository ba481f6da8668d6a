"""Finite-element reference for a Kirchhoff plate: Argyris triangles of scikit-fem, converging from above."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
import pytest
from numpy.typing import ArrayLike, NDArray

from scene2hap import Plate

# Degrees of freedom that an edge fixes at a vertex: deflection and its tangential derivatives; for a clamp also the
# slope across the edge and its tangential derivative. n and t are the coordinates across and along the edge.
HINGED = ("u", "u_{t}", "u_{t}{t}")
CLAMPED = (*HINGED, "u_{n}", "u_xy")


@cache
def finite_elements(plate: Plate, cells: tuple[int, int]) -> tuple[Any, Any, Any, NDArray[np.intp]]:
    """(basis, K, M, free degrees of freedom) for stiffness over D and mass over rho h; skips without scikit-fem."""
    skfem = pytest.importorskip("skfem", reason="scikit-fem is not installed; run: pip install scikit-fem")
    from skfem.helpers import dd, ddot, eye, trace

    nu = plate.material.poisson_ratio
    mesh = skfem.MeshTri.init_tensor(
        np.linspace(0, plate.length_m, cells[0] + 1), np.linspace(0, plate.width_m, cells[1] + 1)
    )
    basis = skfem.Basis(mesh, skfem.ElementTriArgyris(), intorder=10)

    def bending(u: Any, v: Any, _: Any) -> Any:
        moment = (1 - nu) * dd(u) + nu * eye(trace(dd(u)), 2)
        return ddot(moment, dd(v))

    def mass(u: Any, v: Any, _: Any) -> Any:
        return u * v

    fixed: set[int] = set()
    sides = (("x", "y", 0.0), ("x", "y", plate.length_m), ("y", "x", 0.0), ("y", "x", plate.width_m))
    for edge, (n, t, at) in zip(plate.edges, sides, strict=True):
        if edge == "F":
            continue
        axis = "xy".index(n)
        facets = mesh.facets_satisfying(lambda x, axis=axis, at=at: np.abs(x[axis] - at) < 1e-9, boundaries_only=True)
        dofs = basis.get_dofs(facets)
        names = [name.format(n=n, t=t) for name in (HINGED if edge == "S" else CLAMPED)]
        fixed |= set(dofs.all(names))
        if edge == "C":
            fixed |= set(dofs.all(["u_n"]))
    free = np.setdiff1d(np.arange(basis.N), sorted(fixed))
    return (
        basis,
        skfem.BilinearForm(bending).assemble(basis).tocsc(),
        skfem.BilinearForm(mass).assemble(basis).tocsc(),
        free,
    )


def fe_frequencies_hz(plate: Plate, cells: tuple[int, int], n_modes: int) -> NDArray[np.float64]:
    """The lowest natural frequencies (n_modes,) [Hz]."""
    from scipy.sparse.linalg import eigsh

    _, K, M, free = finite_elements(plate, cells)
    K, M = K[free][:, free], M[free][:, free]
    k4 = eigsh(K, n_modes, M, sigma=-1.0, v0=np.ones(len(free)), return_eigenvectors=False)
    omega = np.sqrt(np.maximum(np.sort(k4), 0.0)) / plate.wavenumber_per_root_omega**2
    return omega / (2 * np.pi)


def fe_receptance(
    plate: Plate, cells: tuple[int, int], drive_m: ArrayLike, points_m: ArrayLike, frequencies_hz: ArrayLike, eta: float
) -> NDArray[np.complex128]:
    """Deflection at points over a point force (n_points, n_frequencies) [m/N]; a direct solve at each frequency."""
    from scipy.sparse.linalg import splu

    basis, K, M, free = finite_elements(plate, cells)
    force = np.asarray(basis.probes(np.atleast_2d(drive_m).T).todense())[0, free]
    look = basis.probes(np.atleast_2d(points_m).T).tocsc()[:, free]
    D = plate.bending_stiffness_nm * (1 + 1j * eta)
    m = plate.material.density_kg_m3 * plate.thickness_m
    answers = []
    for f in np.atleast_1d(frequencies_hz):
        dynamic = (D * K - m * (2 * np.pi * f) ** 2 * M)[free][:, free].tocsc()
        answers.append(look @ splu(dynamic).solve(force.astype(complex)))
    return np.array(answers).T


_UNITS_PER_M = 60.0  # some degrees of freedom are second derivatives: small elements make them singular


def outline_mesh(
    lines_x: ArrayLike,
    lines_y: ArrayLike,
    is_cut: Callable[[NDArray[np.float64], NDArray[np.float64]], NDArray[np.bool_]],
) -> Any:
    """Triangles between lines [m], without those whose centroids `is_cut`(x, y)."""
    skfem = pytest.importorskip("skfem", reason="scikit-fem is not installed; run: pip install scikit-fem")
    mesh = skfem.MeshTri.init_tensor(*(np.unique(np.round(np.asarray(lines), 9)) for lines in (lines_x, lines_y)))
    return mesh.remove_elements(np.flatnonzero(is_cut(*mesh.p[:, mesh.t].mean(axis=1))))


def refined_at(mesh: Any, corners_m: ArrayLike, times: int) -> Any:
    """Refine a mesh around corners, where curvature grows without bound."""
    for k in range(times):
        middle = mesh.p[:, mesh.t].mean(axis=1)
        away = np.min([np.hypot(middle[0] - x, middle[1] - y) for x, y in np.asarray(corners_m)], axis=0)
        mesh = mesh.refined(np.flatnonzero(away < 0.12 * 0.5**k))
    return mesh


def fe_receptance_within(
    plate: Plate, mesh: Any, drive_m: ArrayLike, points_m: ArrayLike, frequencies_hz: ArrayLike, eta: float
) -> NDArray[np.complex128]:
    """`fe_receptance` of a free plate within the outline of a mesh [m]."""
    import skfem
    from scipy.sparse.linalg import splu
    from skfem.helpers import dd, ddot, eye, trace

    nu, scale = plate.material.poisson_ratio, _UNITS_PER_M
    basis = skfem.Basis(mesh.scaled(scale), skfem.ElementTriArgyris(), intorder=10)

    def bending(u: Any, v: Any, _: Any) -> Any:
        return ddot((1 - nu) * dd(u) + nu * eye(trace(dd(u)), 2), dd(v))

    def mass(u: Any, v: Any, _: Any) -> Any:
        return u * v

    K, M = (
        skfem.BilinearForm(bending).assemble(basis).tocsc() * scale**2,
        skfem.BilinearForm(mass).assemble(basis).tocsc() / scale**2,
    )
    force = np.asarray(basis.probes(scale * np.atleast_2d(drive_m).T).todense())[0].astype(complex)
    look = basis.probes(scale * np.atleast_2d(points_m).T)
    D = plate.bending_stiffness_nm * (1 + 1j * eta)
    m = plate.material.density_kg_m3 * plate.thickness_m
    answers = [
        look @ splu((D * K - m * (2 * np.pi * f) ** 2 * M).tocsc()).solve(force) for f in np.atleast_1d(frequencies_hz)
    ]
    return np.array(answers).T
