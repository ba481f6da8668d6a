"""The tree of exceptions."""

import inspect
import re

from scene2hap import errors


def test_the_docstring_shows_the_whole_tree() -> None:
    lines = re.findall(r"^    (.*?)(\w+)(?: \((\w+)\))?(?:  .*)?$", errors.__doc__ or "", re.MULTILINE)
    above: list[str] = []
    shown = {}
    for indent, name, other_base in lines:
        depth = len(indent) // 4
        above = [*above[:depth], name]
        shown[name] = (above[depth - 1] if depth else "Exception", other_base)
    classes = {
        name: kind for name, kind in inspect.getmembers(errors, inspect.isclass) if kind.__module__ == errors.__name__
    }
    assert shown.keys() == classes.keys()
    for name, (parent, other_base) in shown.items():
        kind = classes[name]
        assert kind.__bases__[0].__name__ == parent
        assert not other_base or other_base in [base.__name__ for base in kind.__mro__[1:]]
        assert bool(other_base) == (len(kind.__bases__) > 1)
