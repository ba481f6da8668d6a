"""Usual mistakes of users work if their meaning is clear, and otherwise raise a helpful error of the library.

The tables `usual_mistakes` and `more_mistakes` were written before any message was improved.
"""

import re
from pathlib import Path

import pytest

from mistakes_room import ALL_TOPICS, Room, is_answered, page_table, with_table
from usual_mistakes import Mistake

MISTAKES = [pytest.param(one, id=f"{topic}: {one.code}") for topic, ones in ALL_TOPICS.items() for one in ones]
PAGE = Path(__file__).parents[2] / "docs" / "errors.md"


@pytest.fixture(scope="module")
def room(tmp_path_factory: pytest.TempPathFactory) -> Room:
    return Room(tmp_path_factory.mktemp("room"))


@pytest.mark.parametrize("mistake", MISTAKES)
def test_usual_mistakes_raise_helpful_errors_or_work(room: Room, mistake: Mistake) -> None:
    answer = room.answer(mistake.code)
    assert is_answered(mistake, answer), answer
    if answer.is_ours or answer.is_warning:
        assert "\n" not in answer.sentence
        assert len(answer.sentence) < 600
        assert answer.sentence.endswith((".", "?"))
        assert " at 0x" not in answer.sentence, "an address says nothing"


@pytest.mark.parametrize("block", re.findall(r"```python\n(.*?)```", PAGE.read_text("utf-8"), re.DOTALL))
def test_the_code_of_the_page_runs(room: Room, block: str) -> None:
    assert room.answer(block).kind is None, room.answer(block)


def test_page_quotes_the_current_error_messages(tmp_path: Path) -> None:
    """Uses a new room, since files left by other mistakes would change the suggested names."""
    page = PAGE.read_text("utf-8")
    assert page == with_table(page, page_table(Room(tmp_path))), "run: python tests/support/mistakes_room.py"
