"""Modules that imports load, in a new process."""

import ast
import os
import subprocess
import sys
from pathlib import Path

import pytest

from scene2hap.compiled import are_in_use
from scene2hap.errors import UnknownImport

HELP = """
from contextlib import suppress
from scene2hap.cli import main
with suppress(SystemExit):
    main(["--help"])
"""
EVERY_COMMAND = """
from importlib import import_module
from scene2hap.cli import COMMANDS
for name in COMMANDS:
    import_module("scene2hap.cli." + name.replace("-", "_"))
"""
HEAVY = {"numpy", "pydantic", "trimesh", "scipy", "httpx", "networkx"}


def modules_after(statement: str) -> set[str]:
    code = f"import sys\n{statement}\nprint(*sys.modules)"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return set(run.stdout.split())


def test_import_scene2hap_is_lazy() -> None:
    assert not modules_after("import scene2hap") & HEAVY


def test_the_playing_side_loads_no_scene_reader_and_no_network() -> None:
    loaded = modules_after("from scene2hap import HapticSession; import scene2hap.session")
    assert not loaded & {"trimesh", "httpx"}
    behind_the_wall = ("scene2hap.llm", "scene2hap.baking", "scene2hap.audio.sources")
    assert not {name for name in loaded if name.startswith(behind_the_wall)}


def test_the_list_of_commands_loads_none_of_their_modules() -> None:
    loaded = modules_after(HELP)
    assert "scene2hap.cli.console" in loaded
    assert not loaded & (HEAVY | {"scene2hap.cli.bake", "scene2hap.cli.play"})


def test_the_command_line_starts_without_the_packages_of_scipy() -> None:
    """They take as long as all other imports together. `import scipy` loads each where a command first uses it."""
    loaded = modules_after(EVERY_COMMAND)
    assert not loaded & {f"scipy.{name}" for name in ("fft", "linalg", "optimize", "signal", "sparse", "stats")}


CONVERT = """
import numpy, soundfile, tempfile
from pathlib import Path
from scene2hap.cli import main
with tempfile.TemporaryDirectory() as folder:
    sound, felt = Path(folder) / "hum.wav", Path(folder) / "felt.wav"
    soundfile.write(sound, 0.2 * numpy.sin(2 * numpy.pi * 97.0 / 8000 * numpy.arange(8000)), 8000)
    code = main(["convert", str(sound), "-o", str(felt), "--actuator", "ACTUATOR", "--quiet"])
    assert code == 0 and felt.is_file(), code
"""


def test_a_conversion_loads_no_other_side_of_the_library() -> None:
    """Bundles and sessions take 0.25 s to load, and a short sound is converted in 0.05 s."""
    loaded = modules_after(CONVERT.replace("ACTUATOR", "lra"))
    assert "pydantic" not in loaded
    assert not {name for name in loaded if name.startswith(("scene2hap.bundle", "scene2hap.session", "scene2hap.llm"))}


@pytest.mark.skipif(not are_in_use(), reason="plain kernels filter by scipy.signal")
def test_a_conversion_without_a_shift_loads_no_filter_design() -> None:
    """`scipy.signal` takes as long to load as all the rest of a conversion."""
    assert "scipy.signal" not in modules_after(CONVERT.replace("ACTUATOR", "flat"))


WITHOUT_FORK = """
import os, threading
from importlib import import_module
from pkgutil import walk_packages
for name in ("fork", "register_at_fork"):
    delattr(os, name)
class Lock:
    def __init__(self): self._lock = allocate()
    def acquire(self, *how, **named): return self._lock.acquire(*how, **named)
    def release(self): self._lock.release()
    def locked(self): return self._lock.locked()
    __enter__ = acquire
    def __exit__(self, *_): self.release()
allocate, threading.Lock = threading.Lock, Lock
import scene2hap
for one in walk_packages(scene2hap.__path__, "scene2hap."):
    if "__pyinstaller" not in one.name and "__main__" not in one.name:
        import_module(one.name)
"""


@pytest.mark.skipif(not hasattr(os, "fork"), reason="each test of this suite shows it here")
def test_modules_import_without_fork() -> None:
    """Windows has no fork, and its locks have no method for one."""
    assert "scene2hap.bridge.server" in modules_after(WITHOUT_FORK)


def test_every_public_name_is_there() -> None:
    import scene2hap

    for name in scene2hap.__all__:
        assert getattr(scene2hap, name) is not None


STABLE = """
load_scene SceneSnapshot SceneObject DominantSurface Pose Box TriMesh Contact ImageSet capture_images Material
UnknownMaterial Plate ExponentialPlate InfinitePlate ModalPlate MassSpringDamper AutoFidelity NoPropagation
FullPropagation ContactNetwork RigidBody Excitation PropagationField plate_modes PlateModes Bands ContactGraph
ContactChange bake abake infer_haptics ObjectHaptics SourceState LLMBackend LLMRequest LLMReply OpenAIBackend
LocalBackend ReplayBackend LexiconBackend AudioSource VibrationDescription AudioClip select_clip TactileConverter
ConversionContext HapticBundle HapticSession Touch HapticFrame ActuatorSink ActuatorProfile SoundCardSink
SerialAmplifierSink UdpSink WavSink MemorySink SessionConfig BakeConfig
"""
"""The names that game code and independent checks were promised."""


def test_promised_names_are_public() -> None:
    import scene2hap

    assert not set(STABLE.split()) - {*scene2hap.__all__}


def test_type_checkers_know_every_public_name() -> None:
    """Those that `__getattr__` imports stand in a block that only type checkers read."""
    import scene2hap

    tree = ast.parse(Path(scene2hap.__file__).read_text(encoding="utf-8"))
    (block,) = (one for one in tree.body if isinstance(one, ast.If) and ast.unparse(one.test) == "TYPE_CHECKING")
    imports = [one for one in block.body if isinstance(one, ast.ImportFrom)]
    known = {name.asname: f"{one.module}.{name.name}" for one in imports for name in one.names}
    assert known.keys() == {*scene2hap.__all__, *scene2hap._PACKAGES} - {"__version__"}
    assert all(place.endswith(f".{name}") for name, place in known.items())


def test_type_checkers_report_names_that_the_package_lacks() -> None:
    """A `__getattr__` that they saw would give any name the type Any, and they cannot compute `__all__`."""
    import scene2hap

    tree = ast.parse(Path(scene2hap.__file__).read_text(encoding="utf-8"))
    (hidden,) = (one for one in tree.body if isinstance(one, ast.If) and ast.unparse(one.test) == "not TYPE_CHECKING")
    shown = [ast.unparse(one) for one in tree.body if one is not hidden]
    assert not [one for one in shown if "__getattr__" in one or "__all__" in one]


def test_packages_are_reachable_as_attributes() -> None:
    loaded = modules_after("import scene2hap; scene2hap.materials.lookup('oak')")
    assert "scene2hap.materials" in loaded


def test_completion_offers_public_names_and_packages_alone() -> None:
    shown = """import scene2hap, scene2hap.common.checks, scene2hap.session.touch_track
private = {name for name in dir(scene2hap) if name[:1] == "_" and name[:2] != "__"}
assert not private, private
others = {name for name in dir(scene2hap) if name[:1] != "_"} - {*scene2hap.__all__}
assert {"checks", "sys", "Any", "annotations", "touch_track"}.isdisjoint(others), others
assert {"materials", "errors", "report", "demo", "baking"} <= others
assert all(getattr(scene2hap, name).__name__ == f"scene2hap.{name}" for name in others)"""
    modules_after(shown)


@pytest.mark.parametrize("module", ["bridge", "bridge.server", "bridge.messages"])
def test_bridge_without_its_extra_names_the_extra(module: str) -> None:
    modules_after(f"""
sys.modules["websockets"] = None
from scene2hap.errors import MissingExtra
try:
    import scene2hap.{module}
except MissingExtra as error:
    assert "pip install 'scene2hap[bridge]'" in str(error), error
else:
    raise SystemExit("imported")""")


def test_unknown_name_is_an_attribute_error() -> None:
    import scene2hap

    with pytest.raises(AttributeError, match="no attribute 'Haptic'"):
        _ = scene2hap.Haptic


@pytest.mark.parametrize("name", ["Scene2HapError", "AudioError", "ReplayMiss"])
def test_an_error_is_found_in_its_module(name: str) -> None:
    import scene2hap

    with pytest.raises(AttributeError, match=f"Did you mean 'errors.{name}'"):
        getattr(scene2hap, name)
    with pytest.raises(ImportError, match=f"Did you mean 'errors.{name}'"):
        exec(f"from scene2hap import {name}")


def test_misspelt_import_suggests_a_name() -> None:
    with pytest.raises(ImportError, match=r"scene2hap has no 'HapticSesion' to import. Did you mean 'HapticSession'"):
        from scene2hap import HapticSesion  # noqa: F401
    with pytest.raises(UnknownImport, match="lists its names"):
        from scene2hap import Qqqqqq  # noqa: F401
    assert not hasattr(__import__("scene2hap"), "HapticSesion")


def test_submodules_are_imported_by_name() -> None:
    assert "scene2hap.contact_needs" in modules_after("from scene2hap import contact_needs, haptics")
