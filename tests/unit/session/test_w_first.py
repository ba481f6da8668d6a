"""First poses whose quaternions have w first cause one warning; other first poses cause none."""

import math
import warnings

import pytest

from scene2hap import Box, HapticBundle, HapticSession, Pose, SceneObject, SceneSnapshot, SceneWarning, bake

TABLE = SceneObject("table", pose=Pose((0.0, 0.7, 0.0)), geometry=Box((1.6, 0.04, 0.8)))
TURNED = Pose.from_yaw((0.5, 0.725, 0.2), 0.4)
PHONE = SceneObject("phone", pose=TURNED, geometry=Box((0.08, 0.01, 0.15)))


@pytest.fixture(scope="module")
def bundle() -> HapticBundle:
    return bake(SceneSnapshot.build([TABLE, PHONE]))


def with_w_first(pose: Pose) -> Pose:
    x, y, z, w = pose.rotation_xyzw
    return Pose(pose.position_m, (w, x, y, z))


def test_poses_with_w_first_warn_once(bundle: HapticBundle) -> None:
    session = HapticSession(bundle)
    poses = {
        "table": with_w_first(TABLE.pose),
        "phone": with_w_first(Pose.from_yaw((0.5, 0.725, 0.2), 0.5)),
    }
    with pytest.warns(SceneWarning, match=r"all 2 moved objects over.*'table' is \(1, 0, 0, 0\).*from_wxyz") as caught:
        session.update(poses)
    assert caught[0].filename == __file__
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        session.update(poses)


@pytest.mark.filterwarnings("error::scene2hap.SceneWarning")
@pytest.mark.parametrize(
    "pose",
    [
        Pose((0.5, 0.725, 0.2)),
        Pose.from_yaw((0.5, 0.725, 0.2), math.pi),
        Pose.from_euler((0.5, 0.725, 0.2), (math.pi / 2, 0.4, 0.0)),
    ],
)
def test_other_first_moves_do_not_warn(bundle: HapticBundle, pose: Pose) -> None:
    HapticSession(bundle).update({"phone": pose})


@pytest.mark.filterwarnings("error::scene2hap.SceneWarning")
def test_one_falling_object_does_not_warn(bundle: HapticBundle) -> None:
    HapticSession(bundle).update({"table": TABLE.pose, "phone": with_w_first(PHONE.pose)})
