"""Find the files that a URDF file names: beside it or in ROS packages around it, and only inside the root."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from urllib.parse import unquote
from urllib.request import url2pathname
from xml.etree.ElementTree import Element

from scene2hap.common.files import is_there
from scene2hap.common.printable import quoted
from scene2hap.errors import SceneError
from scene2hap.scene.files import address, outside, usable_name

_PACKAGES = ("package", "model")


@dataclass(frozen=True, eq=False)
class UrdfFiles:
    """Search for files of the URDF file `path` inside `root`; `compiler` is MuJoCo's own element in it, if any."""

    path: Path
    root: Path
    compiler: Element | None

    def find(self, name: str, place: str) -> Path:
        """Return the path of a named file.

        Raises: SceneError: there is none, or it is outside the root.
        """
        root, beyond = self.root.resolve(), None
        with usable_name(name, place):
            for path in self._candidates(name, place):
                path = path.resolve()
                if not path.is_relative_to(root):
                    beyond = beyond or path
                elif is_there(path) and path.is_file():
                    return path
        if beyond is None:
            raise SceneError(
                f"{place} wants {quoted(name)}; there is no such file. Copy it beside the scene, or give the folder "
                "that holds the package as assets_root."
            )
        raise outside(place, name, root, beyond)

    def _candidates(self, name: str, place: str) -> Iterator[Path]:
        """Yield the paths that a name may refer to: beside the file, in MuJoCo's folder, or in a package around it."""
        folder = self.path.resolve().parent
        scheme, is_address, rest = name.partition("://")
        if not is_address:
            plain = name.replace("\\", "/")
            yield folder / plain
            if (compiler := self.compiler) is not None:
                # MuJoCo uses only the last part of a name, unless `strippath` is "false".
                is_whole = compiler.get("strippath") == "false"
                yield folder / (compiler.get("meshdir") or "") / (plain if is_whole else PurePosixPath(plain).name)
        elif scheme == "file":
            yield Path(url2pathname(rest))  # /C:/arm.stl on Windows
        elif scheme in _PACKAGES:
            package, _, inner = unquote(rest).partition("/")
            for above in (folder, *folder.parents):
                if above.name == package:
                    yield above / inner
                if above.is_relative_to(self.root.resolve()):
                    yield above / package / inner
        else:
            raise address(place, name)
