"""Invalid arguments give an error that lists the accepted ones; errors from inside a function are unchanged."""

import inspect

import pytest

from scene2hap.common import checks
from scene2hap.common.calls import clear_call, clear_calls, misfit
from scene2hap.errors import CallError


@clear_call
def played(clip: str, *, gain_db: float = 0.0) -> str:
    """Docs."""
    return clip + str(len(gain_db))  # a TypeError from inside


@clear_calls
class Player:
    def play(self, clip: str) -> str:
        return clip

    def _secret(self, clip: str) -> str:
        return clip


def test_error_names_the_nearest_argument() -> None:
    with pytest.raises(CallError, match=r"no argument 'gain'. Did you mean 'gain_db'\? Call played\(clip"):
        played("a", gain=3)
    with pytest.raises(TypeError, match="3 is one argument too many; give it by name: gain_db="):
        played("a", 3)
    with pytest.raises(CallError, match="missing a required argument: 'clip'"):
        played()


def test_type_error_from_inside_is_passed_unchanged() -> None:
    with pytest.raises(TypeError, match=r"has no len\(\)") as caught:
        played("a")
    assert not isinstance(caught.value, CallError)


def test_a_function_keeps_its_name_signature_and_docs() -> None:
    assert (played.__name__, played.__doc__) == ("played", "Docs.")
    assert list(inspect.signature(played).parameters) == ["clip", "gain_db"]


def test_public_methods_of_a_class_are_covered() -> None:
    assert Player().play("a") == "a"
    with pytest.raises(CallError, match=r"Call Player.play\(clip\)"):
        Player().play(clips="a")
    with pytest.raises(TypeError) as caught:
        Player()._secret()
    assert not isinstance(caught.value, CallError)


def test_error_sends_a_setting_to_the_configuration() -> None:
    def bake(scene: object, config: object = None) -> None: ...

    assert "config={'llm': ...}" in misfit(bake, (1,), {"llm": "lexicon"})
    assert "Did you mean 'scene'? If it is a setting, write config={'scne': ...}." in misfit(bake, (1,), {"scne": 1})
    assert misfit(bake, (1,), {"config": 2}) == ""
    assert misfit(int, (1, 2, 3), {}) == "", "of C, which tells no signature"


@pytest.mark.parametrize(
    ("wanted", "known", "sentence"),
    [
        ("ModalPlate", ["modal_plate", "infinite_plate"], "Did you mean 'modal_plate'?"),
        ("gain", ["mute", "gain_db"], "Did you mean 'gain_db'?"),
        ("fan", ["mute", "handheld_fan"], "Did you mean 'handheld_fan'?"),
        ("xyz", ["mute"], ""),
        (3, ["3"], ""),
        ("", ["a"], ""),
        ("a" * 10**6, ["b"], ""),
        ("mute", [], ""),
    ],
)
def test_nearest_name_is_found(wanted: object, known: list[str], sentence: str) -> None:
    assert checks.did_you_mean(wanted, known) == sentence


def test_numbers_of_one_argument_are_put_into_parentheses() -> None:
    def touch(hand: str, point_m: object) -> None: ...

    assert "give 3 numbers as one argument, (1, 2, 3)" in misfit(touch, ("left", 1, 2, 3), {})
    assert "leave it out" in misfit(touch, ("left", 1, "a"), {})
    assert "leave it out" in misfit(touch, ("left", (1, 2, 3), 4), {})


def test_long_values_are_left_out_of_the_message() -> None:
    def play(clip: str, settings: object = ("a" * 100,)) -> None: ...

    message = misfit(play, ("a", {}, ["long" * 100]), {})
    assert "a list is one argument too many" in message
    assert message.endswith("Call test_long_values_are_left_out_of_the_message.<locals>.play(clip, settings=...).")
