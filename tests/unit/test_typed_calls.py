"""The forms of arguments in which a strictly typed program gives its data: mypy accepts each, and each works.

`.ci/run` checks this file with mypy too, so that a type that is too narrow is an error there.
"""

from __future__ import annotations

import ast
import enum
import inspect
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import scene2hap
from scene2hap import (
    ActuatorProfile,
    AudioClip,
    AutoFidelity,
    BakeConfig,
    Bands,
    Box,
    Contact,
    HapticSession,
    InfinitePlate,
    MassSpringDamper,
    ModalPlate,
    ObjectHaptics,
    Outline,
    Plate,
    Pose,
    PropagationField,
    PropagationModel,
    RigidBody,
    SceneObject,
    SceneSnapshot,
    SessionConfig,
    SourceState,
    Touch,
    TriMesh,
    UserProfile,
    bake,
)
from scene2hap.propagation.coupled.contact_stiffness import ContactLaw
from scene2hap.propagation.coupled.hand import PALM
from scene2hap.propagation.protocol import ContactNetwork, Excitation
from scene2hap.session.config import SkipConfig
from scene2hap.session.user_profile import LevelAndLimit

SINGLE: NDArray[np.float32] = np.array([0.5, 0.25, 0.125], dtype=np.float32)
EXACT = (0.5, 0.25, 0.125)


class Hand(enum.StrEnum):
    """An engine's own names."""

    LEFT = "left"


def test_vectors_are_arrays_lists_or_any_three_numbers() -> None:
    as_list: list[float] = SINGLE.tolist()
    for given in (Pose(SINGLE), Pose(as_list), Pose(iter(as_list)), Pose(np.float64(x) for x in as_list)):
        assert given == Pose(EXACT)
    assert Pose(SINGLE, [0.0, 0.0, 0.0, 1.0]) == Pose(EXACT, np.array([0, 0, 0, 1], dtype=np.int64))
    assert Pose.from_yaw(SINGLE, 0.0) == Pose.from_wxyz(as_list, np.array([1.0, 0.0, 0.0, 0.0])) == Pose(EXACT)
    assert Pose.from_euler(SINGLE, np.zeros(3)) == Pose(EXACT)
    assert Pose.look_at(np.zeros(3), [0.0, 0.0, 1.0]) == Pose()
    assert Box(SINGLE) == Box(as_list) == Box(EXACT)
    assert Touch("left", "table", SINGLE) == Touch(Hand.LEFT, "table", as_list) == Touch("left", "table", EXACT)
    up = [0, 1, 0]
    assert (
        Contact("a", "b", SINGLE, normal=up) == Contact("a", "b", as_list, np.array(up)) == Contact("a", "b", EXACT, up)
    )
    assert RigidBody(1.0, SINGLE) == RigidBody(1, as_list)
    assert ObjectHaptics("cup", "steel", None, SINGLE, "", False).estimated_size_m == EXACT


def test_hands_and_contact_laws_of_models_are_objects_settings_or_names() -> None:
    soft = {"tip_radius_m": 0.01}
    assert ModalPlate(hand="palm") == ModalPlate(hand=PALM) == ModalPlate(hand=vars(PALM))
    assert MassSpringDamper(hand="palm", contact=soft).contact == ContactLaw(**soft)
    assert InfinitePlate(hand="palm").hand == AutoFidelity(hand="palm").hand == PALM


def test_tables_are_arrays_of_any_type_or_lists() -> None:
    corners, faces = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], [[0, 1, 2]]
    mesh = TriMesh(np.array(corners, dtype=np.float32), np.array(faces, dtype=np.uint32))
    assert mesh == TriMesh(corners, faces)
    assert SceneObject("sheet", geometry=(corners, faces)).geometry == mesh
    for samples in ([0.5, 0.25, 0.125], SINGLE, SINGLE.astype(np.float64)):
        assert AudioClip(samples, 48_000).samples.tolist() == list(EXACT)
    square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
    assert Outline([square]) == Outline((np.array(square),))
    assert Bands(np.array([10.0, 20.0])) == Bands([10, 20]) == Bands((10.0, 20.0))
    response = [[10.0, -3.0], [100.0, 0.0]]
    assert ActuatorProfile(response_db=response) == ActuatorProfile(response_db=np.array(response))
    assert Plate(1.0, 0.5, 0.02, "oak") == Plate(1, 0.5, np.float64(0.02), scene2hap.materials.lookup("oak"))
    rings = SourceState("on", 0.5, "A phone buzzes.", "phone buzzing")
    assert ObjectHaptics("phone", "steel", None, EXACT, "", True, [rings]).states == (rings,)


def test_settings_are_names_fields_or_instances(tmp_path: Path) -> None:
    lra = ActuatorProfile("lra", 130.0, 230.0, 175.0, 12.0)
    measured = tmp_path / "own.csv"
    measured.write_text("100,-3\n175,0\n", encoding="utf-8")
    octaves: list[int] = [10, 20, 40]
    for bands in (octaves, (10, 20.0, 40), np.array([10.0, 20.0, 40.0]).tolist(), range(10, 41, 10)):
        assert SessionConfig(bands=bands).bands == Bands(bands)
    assert SessionConfig(bands="around").bands == Bands.dominant(octaves=0.5)
    assert SessionConfig(bands=Bands(octaves), actuator=lra, skip=False).skip == SkipConfig(
        **dict.fromkeys(SkipConfig.model_fields, False)
    )
    for actuator in ("lra", {"name": "lra"} | fields_of(lra), lra):
        assert SessionConfig(actuator=actuator, skip={"idle_hands": False}).actuator == lra
        assert BakeConfig(actuator=actuator, cache_dir=str(tmp_path), spread={"octaves": 0.0}).actuator == lra
    by_text, by_path = SessionConfig(actuator=str(measured)), BakeConfig(actuator=measured, prompts=tmp_path)
    assert by_text.actuator == by_path.actuator
    points = [(60, 4.0), (150, -6)]
    profile = UserProfile(curve_db=points, hands={"left": {"gain_db": 2.0}, "right": LevelAndLimit(max_amplitude=0.4)})
    assert profile.curve_db == ((60.0, 4.0), (150.0, -6.0))
    assert profile.hands["left"] == LevelAndLimit(gain_db=2.0)
    kept: Path | None = BakeConfig(cache_dir="kept", prices={"small": (0.1, 0.4)}).cache_dir
    assert kept == Path("kept")


def fields_of(actuator: ActuatorProfile) -> dict[str, Any]:
    names = ("min_frequency_hz", "max_frequency_hz", "resonance_hz", "q")
    return {name: getattr(actuator, name) for name in names}


class EngineMesh:
    """A mesh as engines and mesh packages have it."""

    vertices = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], dtype=np.float32)
    faces = np.array([[0, 1, 2]], dtype=np.uint16)


def test_mesh_of_another_package_is_a_geometry() -> None:
    mesh = EngineMesh()
    assert SceneObject("sheet", geometry=mesh).geometry == TriMesh(mesh.vertices, mesh.faces)


def test_a_number_gives_a_number_and_an_array_an_array() -> None:
    plate = Plate(1.0, 0.5, 0.02, "oak")
    one: float = plate.wavenumber_rad_m(100.0)
    several: NDArray[np.float64] = plate.wavenumber_rad_m([100.0, 400.0])
    assert isinstance(one, float)
    assert several == pytest.approx([one, 2 * one])


class OwnField:
    """A field of a user, who reads its points as the array that the protocol promises, and has own names for them."""

    def __init__(self, source_ids: tuple[str, ...]) -> None:
        self.source_ids = source_ids

    def attenuation(self, touched: str, at: NDArray[np.float64]) -> NDArray[np.float64]:
        gains = np.zeros((at.shape[0], len(self.source_ids), 1))
        gains[:, [one == touched for one in self.source_ids]] = 1.0
        return gains


class OwnModel:
    """A model of a user."""

    usual_bands = Bands.dominant()

    def prepare(self, network: ContactNetwork, excitations: Any, bands: Bands) -> OwnField:
        return OwnField(tuple(one.source_id for one in excitations))


def test_own_field_and_model_fit_their_protocols() -> None:
    model: PropagationModel = OwnModel()
    field: PropagationField = model.prepare(ContactNetwork({}), [Excitation("fan", 50.0, 50.0)], Bands.dominant())
    assert field.attenuation("fan", np.zeros((1, 3))).tolist() == [[[1.0]]]


def test_session_accepts_the_documented_forms_of_touches() -> None:
    table = SceneObject("wooden table", pose=Pose((0.0, 0.36, 0.0)), geometry=Box((1.2, 0.72, 0.7)))
    phone = SceneObject("smartphone", pose=Pose((0.3, 0.724, 0.1)), geometry=Box((0.07, 0.008, 0.15)))
    session = HapticSession(bake(SceneSnapshot.build(one for one in (table, phone))))
    at = np.array([0.25, 0.72, 0.1])
    touch = Touch(Hand.LEFT, "wooden table", at)
    expected = session.update(touches=[touch]).gain("left", "smartphone")
    assert expected > 0
    for frame in (
        session.update(touches=touch),
        session.update([touch]),
        session.update(touch),
        session.update({}, (touch,)),
        session.update(touches=[("left", "wooden table", at)]),
        session.update(touches=[(Hand.LEFT, "wooden table", at.tolist())]),
        session.update(touches=(one for one in [touch])),
    ):
        assert frame.gain(Hand.LEFT, "smartphone") == expected
    assert session.would_feel([("left", "wooden table", at)]).shape == (1, 1, 1)
    session.strike("wooden table", at)


def test_a_plot_is_a_figure(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib", reason="needs the extra plots")
    from matplotlib.figure import Figure

    clip = AudioClip(np.sin(np.arange(4000) / 10), 8000)
    clip.plot().savefig(tmp_path / "clip.png")
    given = Figure()
    assert clip.plot(figure=given) is given


def _declared() -> list[tuple[str, str, ast.FunctionDef]]:
    """Module, class and declaration of each constructor that only type checkers see."""
    root = Path(scene2hap.__file__).parent
    found = []
    for path in sorted(root.rglob("*.py")):
        text = path.read_text("utf-8")
        if "    if TYPE_CHECKING:" not in text:
            continue  # without parsing, which takes a second for all files
        module = ".".join(("scene2hap", *path.relative_to(root).with_suffix("").parts)).removesuffix(".__init__")
        for cls in (node for node in ast.walk(ast.parse(text)) if isinstance(node, ast.ClassDef)):
            for block in (node for node in cls.body if isinstance(node, ast.If)):
                if isinstance(block.test, ast.Name) and block.test.id == "TYPE_CHECKING":
                    made = [one for one in block.body if isinstance(one, ast.FunctionDef) and one.name == "__init__"]
                    found += [(module, cls.name, one) for one in made]
    return found


@pytest.mark.parametrize(
    ("module", "name", "declared"), [pytest.param(*row, id=f"{row[0]}.{row[1]}") for row in _declared()]
)
def test_declared_constructors_have_the_parameters_of_the_class(
    module: str, name: str, declared: ast.FunctionDef
) -> None:
    arguments = declared.args.args[1:]
    required: list[ast.expr | None] = [None] * (len(arguments) - len(declared.args.defaults))
    defaults = zip(
        (*arguments, *declared.args.kwonlyargs),
        (*required, *declared.args.defaults, *declared.args.kw_defaults),
        strict=True,
    )
    of_class = inspect.signature(getattr(import_module(module), name)).parameters.values()
    parameters = [one for one in of_class if one.kind is not one.VAR_POSITIONAL]  # that of settings only refuses
    for (given, default), parameter in zip(defaults, parameters, strict=True):
        assert given.arg == parameter.name
        value = parameter.empty if default is None else eval(ast.unparse(default), vars(import_module(module)))
        if value is ...:  # a new object at each call
            assert parameter.default is not parameter.empty
        else:
            assert value == parameter.default


def _attributes_without_a_type(cls: ast.ClassDef) -> set[str]:
    """Public attributes that methods set, unless one statement annotates them, or sets them to a parameter."""
    typed = {ast.unparse(one.target).removeprefix("self.") for one in ast.walk(cls) if isinstance(one, ast.AnnAssign)}
    typed |= {one.name for one in cls.body if isinstance(one, ast.FunctionDef)}  # properties
    assigned = set()
    for method in (one for one in cls.body if isinstance(one, ast.FunctionDef | ast.AsyncFunctionDef)):
        arguments = method.args
        names = {one.arg for one in (*arguments.args, *arguments.kwonlyargs, arguments.vararg, arguments.kwarg) if one}
        for one in (one for one in ast.walk(method) if isinstance(one, ast.Assign)):
            if isinstance(one.value, ast.Name) and one.value.id in names:
                typed |= {target.attr for target in one.targets if isinstance(target, ast.Attribute)}
            for part in (part for target in one.targets for part in getattr(target, "elts", [target])):
                if isinstance(part, ast.Attribute) and ast.unparse(part.value) == "self":
                    assigned.add(part.attr)
    return {name for name in assigned - typed if not name.startswith("_")}


def test_public_attributes_state_their_types() -> None:
    """Pyright does not infer the attributes of an installed package: such a class is partly unknown to its users."""
    root = Path(scene2hap.__file__).parent
    for path in sorted(root.rglob("*.py")):
        for cls in (one for one in ast.walk(ast.parse(path.read_text("utf-8"))) if isinstance(one, ast.ClassDef)):
            if not cls.name.startswith("_"):
                assert not _attributes_without_a_type(cls), f"{path.relative_to(root)}: {cls.name}"
