"""Keys of a Windows console, which sends arrow keys as two characters."""

from collections import deque

import pytest

from scene2hap.cli.keys import DOWN, LEFT, RIGHT, UP, console_key


def keys_of(characters: str) -> list[str]:
    waiting = deque(characters)
    found = []
    while waiting:
        found.append(console_key(lambda: bool(waiting), waiting.popleft))
    return found


@pytest.mark.parametrize("prefix", ["\x00", "\xe0"])  # of the keypad, and of the other arrow keys
def test_arrow_keys_are_those_of_other_terminals(prefix: str) -> None:
    assert keys_of("".join(prefix + code for code in "HPMK")) == [UP, DOWN, RIGHT, LEFT]


def test_other_keys_are_their_character_and_unknown_ones_nothing() -> None:
    assert keys_of("q +\xe0Gä") == ["q", " ", "+", "", "ä"]


def test_no_key_is_no_wait() -> None:
    def read() -> str:
        raise AssertionError("it would wait")

    assert console_key(lambda: False, read) == ""


def test_ctrl_c_interrupts() -> None:
    with pytest.raises(KeyboardInterrupt):
        keys_of("\x03")
