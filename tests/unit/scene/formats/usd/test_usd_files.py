"""USD files: layers, archives, broken files and the process that reads them; skipped without usd-core."""

from __future__ import annotations

import sys
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from looks import UPRIGHT, image_file, refused, shown
from scene2hap.errors import MissingExtra, SceneError, SceneFormatError
from scene2hap.scene import limits
from scene2hap.scene.formats.usd import process
from scene2hap.scene.load import load_scene
from systems import needs_long_names
from usd_writing import (
    CUBE_POINTS,
    CUBE_QUADS,
    HEADER,
    bind,
    ids,
    instancer,
    mesh,
    new_stage,
    painted_square,
    preview,
    scene_of,
    text_file,
    usd,
)

# -- layers ----------------------------------------------------------------------------------------------------------

CUBE = '(\n defaultPrim = "cube"\n)\ndef Xform "cube" {\n def Cube "shape" { double size = 1\n }\n}\n'


@pytest.mark.parametrize("arc", ["references", "prepend references", "payload", "append payload"])
@pytest.mark.parametrize("name", ["./props/cube.usda", "props/cube.usda", "props/a%20b.usda"])
def test_layers_beside_the_scene_are_read(tmp_path: Path, arc: str, name: str) -> None:
    text_file(tmp_path, CUBE, name)
    path = text_file(tmp_path, f'def Xform "box" ({arc} = @{name}@)\n{{\n}}\n')
    assert ids(load_scene(path, unit_m=1.0)) == ["box"]


def test_sublayers_and_their_own_layers_are_read_from_their_own_folders(tmp_path: Path) -> None:
    text_file(tmp_path, CUBE, "sets/props/cube.usda")
    text_file(tmp_path, 'def Xform "box" (references = @props/cube.usda@)\n{\n}\n', "sets/set.usda")
    path = text_file(
        tmp_path,
        '(\n subLayers = [@sets/set.usda@]\n)\nover "box" {\n double3 xformOp:translate = (4, 0, 0)\n'
        ' uniform token[] xformOpOrder = ["xformOp:translate"]\n}\n',
    )
    (box,) = load_scene(path, unit_m=1.0).objects
    np.testing.assert_allclose(box.bounds_m[:, 0], [3.5, 4.5])


def test_textures_lie_beside_the_layer_that_names_them(tmp_path: Path) -> None:
    (tmp_path / "props").mkdir()
    (tmp_path / "props" / "floor.png").write_bytes(image_file())
    stage = new_stage(tmp_path / "props" / "square.usdc")
    painted_square(stage)
    stage.Save()
    path = text_file(tmp_path, "(\n subLayers = [@props/square.usdc@]\n)\n")
    assert shown(load_scene(path, unit_m=1.0).objects[0]) == UPRIGHT


@pytest.mark.parametrize("arc", ["references", "payload"])
def test_a_layer_outside_needs_another_root(tmp_path: Path, arc: str) -> None:
    text_file(tmp_path, CUBE, "props/cube.usda")
    path = text_file(tmp_path, f'def Xform "box" ({arc} = @../props/cube.usda@)\n{{\n}}\n', "scenes/a.usda")
    with pytest.raises(SceneError, match="prim /box wants '../props/cube.usda', which lies outside .*assets_root="):
        load_scene(path)
    assert ids(load_scene(path, assets_root=tmp_path, unit_m=1.0)) == ["box"]


@pytest.mark.parametrize(
    ("name", "sentence"),
    [
        ("https://example.org/a.usda", "never fetched"),
        ("omniverse://server/a.usd", "never fetched"),
        ("/etc/a.usda", "lies outside"),
        ("gone.usda", "needs the layer 'gone.usda', and there is no file"),
        pytest.param(f"{'x' * 5000}.usda", "which is no usable file name", marks=needs_long_names),
        ("chair.obj", "layers that are read end in .usd"),
        ('`"${ROOM}.usda"`', "by the expression"),
    ],
)
@pytest.mark.parametrize("arc", ["references", "payload", "subLayers"])
def test_error_names_unread_layers(tmp_path: Path, name: str, sentence: str, arc: str) -> None:
    text = f"(\n subLayers = [@{name}@]\n)\n" if arc == "subLayers" else f'def Xform "box" ({arc} = @{name}@)\n{{\n}}\n'
    with pytest.raises(SceneError, match=sentence):
        load_scene(text_file(tmp_path, text + 'def Cube "cube" {\n}\n'), unit_m=1.0)


def test_layers_that_the_stage_does_not_need_may_be_missing(tmp_path: Path) -> None:
    variants = """def Xform "box" (
        variants = { string size = "%s" }
        prepend variantSets = "size"
    ) {
        variantSet "size" = {
            "small" {
                def Cube "cube" {
                }
            }
            "large" (references = @gone.usda@) {
            }
        }
    }
    def Xform "off" (
        active = false
        references = @away.usda@
    ) {
    }
    """
    assert ids(load_scene(text_file(tmp_path, variants % "small"), unit_m=1.0)) == ["box"]
    with pytest.raises(SceneError, match="needs the layer 'gone.usda'"):
        load_scene(text_file(tmp_path, variants % "large"), unit_m=1.0)


def test_files_of_materials_alone_may_be_missing(tmp_path: Path) -> None:
    path = text_file(tmp_path, 'def Cube "cube" {\n}\ndef Material "m" (references = @wood.mtlx@</MaterialX>) {\n}\n')
    scene, told = refused(path)
    assert ids(scene) == ["cube"]
    assert "'wood.mtlx', a file of materials" in told


def test_cyclic_references_are_resolved_once(tmp_path: Path) -> None:
    text_file(tmp_path, 'def Xform "b" (references = @scene.usda@</a>)\n{\n def Cube "cube" {\n }\n}\n', "b.usda")
    path = text_file(tmp_path, 'def Xform "a" (references = @b.usda@</b>)\n{\n}\n')
    assert len(load_scene(path, unit_m=1.0).objects) == 1


def test_value_clips_are_not_opened(tmp_path: Path) -> None:
    text_file(tmp_path, 'def Cube "box" {\n double size.timeSamples = { 0: 9 }\n}\n', "clip.usda")
    path = text_file(
        tmp_path,
        """def Cube "box" (
        clips = { dictionary default = {
            asset[] assetPaths = [@./clip.usda@]
            double2[] active = [(0, 0)]
            double2[] times = [(0, 0)]
            string primPath = "/box"
            asset manifestAssetPath = @./clip.usda@
        } }
        ) {
        }
        """,
    )
    (box,) = load_scene(path, unit_m=1.0).objects
    np.testing.assert_allclose(np.ptp(box.bounds_m, axis=0), 2.0)


# -- archives --------------------------------------------------------------------------------------------------------


def archive(folder: Path) -> Path:
    """A .usdz made by usd-core: a square with its texture."""
    (folder / "floor.png").write_bytes(image_file())
    stage = new_stage(folder / "square.usdc")
    painted_square(stage)
    stage.Save()
    assert usd("UsdUtils").CreateNewUsdzPackage(str(folder / "square.usdc"), str(folder / "a.usdz"))
    (folder / "floor.png").unlink()
    return folder / "a.usdz"


def zipped(path: Path, files: dict[str, str | bytes], how: int = zipfile.ZIP_STORED) -> Path:
    with zipfile.ZipFile(path, "w", how) as out:
        for name, content in files.items():
            out.writestr(name, content)
    return path


def test_archives_are_read_with_their_textures(tmp_path: Path) -> None:
    (square,) = load_scene(archive(tmp_path)).objects
    assert square.id == "square"
    assert shown(square) == UPRIGHT


def test_archives_are_read_as_layers(tmp_path: Path) -> None:
    archive(tmp_path)
    path = text_file(tmp_path, 'def "tile" (references = @a.usdz@</square>)\n{\n}\n')
    assert ids(load_scene(path, unit_m=1.0)) == ["tile"]


def test_layers_in_an_archive_come_from_the_archive(tmp_path: Path) -> None:
    text_file(tmp_path, CUBE, "cube.usda")
    outer = HEADER + 'def Xform "box" (references = @%s@)\n{\n}\n'
    inner = {"parts/cube.usda": HEADER + CUBE}
    path = zipped(tmp_path / "a.usdz", {"scene.usda": outer % "parts/cube.usda", **inner})
    assert ids(load_scene(path, unit_m=1.0)) == ["box"]
    for name in ("cube.usda", "../cube.usda", "/etc/cube.usda", "https://example.org/cube.usda"):
        with pytest.raises(SceneError, match="which the archive does not hold"):
            load_scene(zipped(tmp_path / "b.usdz", {"scene.usda": outer % name, **inner}))


def test_broken_archives_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "a.usdz"
    with pytest.raises(SceneFormatError, match="packs or encrypts 'a.usda'"):
        load_scene(zipped(path, {"a.usda": HEADER + CUBE}, zipfile.ZIP_DEFLATED))
    with pytest.raises(SceneFormatError, match=r"'a\.usdz/read\.me' cannot be read as USD"):
        load_scene(zipped(path, {"read.me": "hello"}))
    with pytest.raises(SceneFormatError, match="promises 0 files"):
        load_scene(zipped(path, {}))
    path.write_bytes(b"PK\x03\x04 and so on")
    with pytest.raises(SceneFormatError, match=r"'a\.usdz' cannot be read as USDZ"):
        load_scene(path)
    zipped(path, {"a.usda": HEADER + CUBE + " " * 5000})
    data = path.read_bytes()
    # Both sizes, packed and unpacked, in the file's entry of the central directory.
    at = data.rindex(b"PK\x01\x02")
    path.write_bytes(data[: at + 20] + b"\xff\xff\xff\x0f" * 2 + data[at + 28 :])
    with pytest.raises(SceneFormatError, match="promises 1 files of 268,435,455 bytes"):
        load_scene(path)


# -- broken files ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("a shopping list", "'scene.usda' cannot be read as USD"),
        ('def Cube "a" {', "'scene.usda' cannot be read as USD"),
        ('def Xform "a" {\n}\n', "holds no triangles"),
        ('def Mesh "a" {\n int[] faceVertexCounts = [3]\n int[] faceVertexIndices = [0, 1, 2]\n}\n', "there are 0"),
        ('def Mesh "a" {\n int[] faceVertexCounts = [4]\n int[] faceVertexIndices = [0, 1, 2]\n}\n', "come to 4"),
        ('def Mesh "a" {\n int[] faceVertexCounts = [-3, 6]\n int[] faceVertexIndices = [0, 1, 2]\n}\n', "come to 3"),
        (
            'def Mesh "a" {\n point3f[] points = [(0, 0, 0), (1, 0, 0), (nan, 1, 0)]\n int[] faceVertexCounts = [3]\n'
            " int[] faceVertexIndices = [0, 1, 2]\n}\n",
            "every coordinate must be finite",
        ),
        ('def Cube "a" {\n double size = 1e300\n}\n', "1e\\+300|finite|coordinates of up to"),
        (
            'def Cube "a" {\n matrix4d xformOp:transform = ((1,0,0,1),(0,1,0,0),(0,0,1,0),(0,0,0,1))\n'
            ' uniform token[] xformOpOrder = ["xformOp:transform"]\n}\n',
            "whose last column is",
        ),
        ('def Mesh "a" {\n string points = "abc"\n}\n', "cannot be read as USD|holds no triangles"),
        ('def Mesh "a" {\n string[] faceVertexCounts = ["abc"]\n}\n', "cannot be read as USD|holds no triangles"),
        ('def Cube "a" {\n string size = "abc"\n}\n', "cannot be read as USD|holds no triangles"),
        ('def Cube "a" {\n double[] visibility = [1, 2]\n double3 size = (1, 2, 3)\n}\n', "cannot be read as USD"),
        (
            'def Cube "a" {\n string xformOp:translate = "abc"\n uniform token[] xformOpOrder = '
            '["xformOp:translate"]\n}\ndef PointInstancer "b" {\n string protoIndices = "abc"\n}\n',
            "cannot be read as USD",
        ),
        ('def Xform "a" {\n' * 300 + 'def Cube "b" {\n}\n' + "}\n" * 300, "the depth of the node tree is 201"),
    ],
)
def test_broken_text_is_refused(tmp_path: Path, text: str, sentence: str) -> None:
    with pytest.raises(SceneError, match=sentence):
        load_scene(text_file(tmp_path, text), unit_m=1.0)


@pytest.mark.usefixtures("child")
def test_a_crash_of_the_reader_is_an_error(tmp_path: Path) -> None:
    """Deeply nested text overflows usd-core's stack."""
    text = 'def "a" (\n customData = {' + "dictionary a = {" * 100_000 + "}" * 100_000 + "}\n) {\n}\n"
    with pytest.raises(SceneFormatError, match="usd-core ended with status"):
        load_scene(text_file(tmp_path, text))


@pytest.mark.parametrize("content", [b"", b"PXR-USDC", b"PXR-USDC" + bytes(100), b"\0" * 1000])
@pytest.mark.parametrize("suffix", [".usd", ".usdc", ".usdz"])
def test_broken_binaries_are_refused(tmp_path: Path, content: bytes, suffix: str) -> None:
    path = tmp_path / f"scene{suffix}"
    path.write_bytes(content)
    with pytest.raises(SceneFormatError, match=f"'scene{suffix}'"):
        load_scene(path)


def test_missing_file_is_refused(tmp_path: Path) -> None:
    with pytest.raises(SceneError, match="there is no file"):
        load_scene(tmp_path / "scene.usdc")


def doubling(*, arc: str) -> str:
    """Thirty prims, each of which contains the next prim twice."""
    rows = [
        f'def Xform "a{i}" {{\n def "x" ({arc} = </a{i + 1}>) {{\n }}\n def "y" ({arc} = </a{i + 1}>) {{\n }}\n}}\n'
        for i in range(30)
    ]
    return "".join(rows) + 'def Cube "a30" {\n}\n'


@pytest.mark.parametrize("arc", ["references", "payload", "inherits", "specializes"])
def test_excessive_composition_is_refused_before_reading(tmp_path: Path, arc: str) -> None:
    with pytest.raises(SceneError, match="brings the opinions to compose to"):
        load_scene(text_file(tmp_path, doubling(arc=arc)))


@pytest.mark.usefixtures("child")
def test_reader_process_uses_the_limits_of_the_caller(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    stage = new_stage(tmp_path / "a.usda")
    instancer(stage, n=100)
    stage.Save()
    monkeypatch.setattr(limits, "MAX_NODES", 50)
    with pytest.raises(SceneError, match=r"the number of nodes is \d+; scene2hap reads at most 50"):
        load_scene(tmp_path / "a.usda")


@pytest.mark.usefixtures("child")
def test_a_reader_that_takes_too_long_is_ended(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "sitecustomize.py").write_text(
        # Some releases of usd-core read so small a file in some milliseconds.
        "import scene2hap.scene.formats.usd.process as p\n"
        "p.TIME_S, p.TIME_S_PER_BYTE, p.TIME_S_PER_PRIM = 1e-6, 0.0, 0.0\n",
        encoding="utf-8",
    )
    monkeypatch.syspath_prepend(str(tmp_path))
    with pytest.raises(SceneFormatError, match="it takes longer than"):
        load_scene(text_file(tmp_path, 'def Cube "a" {\n}\n'))


# -- the child process -----------------------------------------------------------------------------------------------


@pytest.mark.usefixtures("child")
def test_reader_prints_nothing(
    tmp_path: Path, capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    path = text_file(tmp_path, 'def Cube "a" (references = </gone>)\n{\n}\n')
    for can_start in (True, False):
        monkeypatch.setattr(process, "can_start_python", lambda can_start=can_start: can_start)
        load_scene(path, unit_m=1.0)
        with pytest.raises(SceneFormatError):
            load_scene(text_file(tmp_path, "no usd", "b.usda"))
    assert capfd.readouterr() == ("", "")


@pytest.mark.usefixtures("child")
def test_non_python_executable_reads_in_process(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = archive(tmp_path)
    expected = load_scene(path)
    monkeypatch.setattr(sys, "executable", str(tmp_path / "game.exe"))
    assert not process.can_start_python()
    found = load_scene(path)
    assert found == expected
    assert shown(found.objects[0]) == UPRIGHT
    monkeypatch.setattr(sys, "frozen", True, raising=False)
    assert not process.can_start_python()


@pytest.mark.usefixtures("child")
def test_reader_that_cannot_be_started_is_an_error(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "executable", str(tmp_path / "python-that-is-gone"))
    with pytest.raises(SceneError, match="'scene.usda' is not read, since no process can be started"):
        load_scene(text_file(tmp_path, 'def Cube "a" {\n}\n'))


@pytest.mark.usefixtures("child")
def test_every_load_is_the_same(tmp_path: Path) -> None:
    def fill(stage: Any) -> None:
        instancer(stage)
        bind(mesh(stage, "/box", CUBE_POINTS, CUBE_QUADS), preview(stage, "/Looks/wood", diffuseColor=(1.0, 0.0, 0.0)))

    first = scene_of(fill, tmp_path)
    assert all(load_scene(tmp_path / "scene.usda", unit_m=1.0) == first for _ in range(2))


def test_missing_usd_core_error_names_the_install_command(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pxr", None)
    with pytest.raises(MissingExtra, match=r"'scene.usdz' is USD.*pip install 'scene2hap\[usd\]'"):
        load_scene(tmp_path / "scene.usdz")
