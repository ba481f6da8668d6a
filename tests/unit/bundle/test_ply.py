"""Meshes as PLY: exact round trips of the library's files, and other files as trimesh reads them."""

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings, strategies as st

from scene2hap import Box, TriMesh
from scene2hap.bundle.ply import decode_ply, encode_ply
from scene2hap.errors import SceneFormatError


@settings(max_examples=50)
@given(st.lists(st.tuples(*[st.floats(-1e6, 1e6)] * 3), min_size=3, max_size=20))
def test_round_trip_is_exact(vertices: list[tuple[float, float, float]]) -> None:
    mesh = TriMesh(np.array(vertices), np.array([[0, 1, 2], [2, 1, len(vertices) - 1]]))
    assert decode_ply(encode_ply(mesh)) == mesh


def test_trimesh_reads_the_same_mesh() -> None:
    box = Box((1.0, 2.0, 0.3)).mesh
    read = trimesh.load(trimesh.util.wrap_as_stream(encode_ply(box)), file_type="ply", process=False)
    np.testing.assert_array_equal(read.vertices, box.vertices_m)
    np.testing.assert_array_equal(read.faces, box.faces)
    assert read.volume == pytest.approx(0.6)


def test_single_precision_file_of_trimesh_is_read() -> None:
    written = trimesh.creation.icosphere(subdivisions=1).export(file_type="ply")
    mesh = decode_ply(written)
    np.testing.assert_allclose(mesh.vertices_m, trimesh.creation.icosphere(subdivisions=1).vertices, atol=1e-6)


@pytest.mark.parametrize("cut", [0, 10, 150, 300, 400])
def test_truncated_file_is_refused(cut: int) -> None:
    whole = encode_ply(Box((1, 1, 1)).mesh)
    assert cut < len(whole)
    with pytest.raises(SceneFormatError, match="binary PLY"):
        decode_ply(whole[:cut])


def test_ascii_is_refused() -> None:
    with pytest.raises(SceneFormatError, match="binary PLY"):
        decode_ply(b"ply\nformat ascii 1.0\nelement vertex 0\nend_header\n")
