"""Links of robots that their own names do not tell, read from their chain."""

from collections.abc import Sequence

import pytest

from scene2hap import LexiconBackend, SceneSnapshot, infer_haptics
from scene2hap.llm.answers import ObjectAnswer
from scene2hap.llm.lexicon.categories import ObjectFacts, judge
from scripted_backend import Scripted, box, scene


def in_chain(names: Sequence[str], n_in_series: int = 2) -> dict[str, ObjectAnswer]:
    return {
        name: judge(ObjectFacts(name, (0.3, 0.1, 0.1), chain_names=names, n_in_series=n_in_series)) for name in names
    }


# Names of models of metaworld, gymnasium-robotics and robosuite.
ROBOTS = {
    "Sawyer": ["right_arm_base_link", "right_l0", "head", "screen", "right_l1", "right_l2", "right_hand"],
    "Adroit": ["forearm", "wrist", "palm", "ffknuckle", "ffproximal", "thbase"],
    "Shadow": ["robot0:hand mount", "robot0:wrist", "robot0:palm"],
    "Baxter": ["torso", "right_upper_shoulder", "right_lower_elbow", "right_hand", "right_hand_accelerometer"],
    "GR1": ["whole_body", "torso_waist_yaw", "head_yaw", "head_roll", "r_upper_arm_roll", "l_foot_roll"],
    "Kinova": ["fixed_base_link", "shoulder_link", "HalfArm1_Link", "Bracelet_Link"],
    "Spot": ["body", "fr_hip", "fr_uleg", "fr_lleg"],
    "Inspire": ["l_palm", "l_thumb_proximal_1", "l_index_distal"],
    "ant": ["torso", "front_left_leg", "aux_1"],
}


@pytest.mark.parametrize("names", ROBOTS.values(), ids=ROBOTS)
def test_all_links_of_a_robot_are_known(names: list[str]) -> None:
    for name, answer in in_chain(names).items():
        assert (answer.object_category, answer.material_category) == ("robot part", "aluminum"), name
        assert not answer.vibrates


def test_a_link_that_its_chain_tells_has_a_lower_confidence_and_a_reason() -> None:
    answers = in_chain(ROBOTS["Sawyer"])
    assert (
        answers["right_arm_base_link"].confidence
        > answers["right_l0"].confidence
        > judge(ObjectFacts("right_l0", (0.3, 0.1, 0.1))).confidence
    )
    assert answers["screen"].category_reason == (
        "the name 'screen' alone does not tell. Hinges join it with 'right_arm_base_link', so it is taken for a "
        "robot's link."
    )


def test_a_long_series_that_names_nothing_else_is_an_arm() -> None:
    names = [f"link{i}" for i in range(1, 8)]
    arm = in_chain(names, n_in_series=7)
    assert {answer.object_category for answer in arm.values()} == {"robot part"}
    assert "a series of 7 objects" in arm["link3"].category_reason
    assert arm["link3"].confidence < in_chain(ROBOTS["Sawyer"])["right_l0"].confidence
    # A cabinet of which each part is called a link has many doors, but none hangs on another.
    assert {answer.object_category for answer in in_chain(names, n_in_series=2).values()} == {"unknown"}
    arms = [n for n in range(4, 15) if in_chain(names, n)["link3"].object_category == "robot part"]
    assert arms == [6, 7, 8, 9, 10, 11, 12]
    rope = [f"seg_{i}" for i in range(40)]
    assert {answer.object_category for answer in in_chain(rope, n_in_series=40).values()} == {"unknown"}
    cable = in_chain([*names, "cable"], n_in_series=8)
    assert {answer.object_category for name, answer in cable.items() if name != "cable"} == {"unknown"}


@pytest.mark.parametrize(
    ("names", "unknown"),
    [
        (["oven", "oven_door", "knob_1", "xyz"], "xyz"),
        (["cabinet", "left_door", "handle", "part_02"], "part_02"),
        (["desk_lamp", "lower_arm", "upper_arm", "shade"], "shade"),
        (["lamp", "arm", "arm_2", "shade"], "shade"),
        (["table", "leg", "leg_2", "leg_3"], None),
        (["laptop_base", "screen"], None),
        (["microroot", "microwave", "microdoorroot"], "microdoorroot"),
        (["toy_robot", "xyz"], "xyz"),
        (["replica_robot", "xyz"], "xyz"),
        (["palm", "xyz"], "xyz"),
    ],
)
def test_other_chains_are_no_robots(names: list[str], unknown: str | None) -> None:
    for name, answer in in_chain(names, n_in_series=3).items():
        if name == unknown:
            assert answer.object_category == "unknown"
        else:
            assert answer == judge(ObjectFacts(name, (0.3, 0.1, 0.1))), name


def test_other_things_on_a_robot_stay_what_they_are() -> None:
    answers = in_chain(["robot_base_link", "shoulder_link", "elbow_link", "wrist_link", "wheel", "camera", "plate_x"])
    assert answers["wheel"].object_category == "wheel"
    assert answers["camera"].object_category == "camera"
    assert answers["robot_base_link"].object_category == "robot"
    assert answers["plate_x"].object_category == judge(ObjectFacts("plate_x", (0.3, 0.1, 0.1))).object_category


def arm(*names: str) -> SceneSnapshot:
    """Boxes of which each is held on the one before."""
    links = [box(name, (0.1, 0.1, 0.1), (0.1 * i, 1.0, 0.0)) for i, name in enumerate(names)]
    for i in range(1, len(links)):
        links[i] = links[i].hinged_on(links[i - 1], (0.1 * i - 0.05, 1.0, 0.0))
    return scene(*links, box("mug", (0.1, 0.1, 0.1), (3.0, 0.05, 0.0)))


def test_vibration_passes_through_links_that_the_chain_tells() -> None:
    found = infer_haptics(arm("right_wrist", "right_l5", "right_l6"), LexiconBackend())
    assert all(found[name].material is not None for name in ("right_wrist", "right_l5", "right_l6"))
    assert found["right_l6"].confidence == 0.5


def test_only_objects_of_a_chain_have_a_line_about_it_in_their_prompt() -> None:
    backend = Scripted()
    infer_haptics(arm("right_wrist", "right_l5"), backend, user_prompt="all phones are off")
    asked = {request.subject: request for request in backend.asked if request.component == "object_analyzer"}
    line = (
        '\n\nIt is one of these objects, which hinges join, directly or by others, by authored name: ["right_wrist", '
        '"right_l5"]\nAbove all, follow'
    )
    assert line in asked["right_l5"].prompt
    assert asked["right_l5"].facts["n_in_series"] == 2
    assert "hinges" not in asked["mug"].prompt
    assert not {"chain_names", "n_in_series"} & asked["mug"].facts.keys()


def test_equal_links_of_different_chains_share_no_answer() -> None:
    one = arm("right_wrist", "right_l5", "tip_1")
    other = [box(name, (0.1, 0.1, 0.1), (0.1 * i, 2.0, 0.0)) for i, name in enumerate(("door", "right_l6", "tip_2"))]
    other[1] = other[1].hinged_on(other[0], (0.05, 2.0, 0.0))
    other[2] = other[2].hinged_on(other[1], (0.15, 2.0, 0.0))
    found = infer_haptics(scene(*one.objects, *other), LexiconBackend())
    assert found["tip_1"].object_category == "robot part"
    assert found["tip_2"].object_category == "unknown"
