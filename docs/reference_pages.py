"""Write the reference: a page for each part of the library, with its public names, from `scene2hap.__all__`.

A name that is added there is on its page at the next build.
"""

from __future__ import annotations

import inspect
from collections import defaultdict
from collections.abc import Iterable
from pathlib import Path

from autodoc2.render.myst_ import MystRenderer
from autodoc2.utils import ItemData

import scene2hap
import scene2hap.errors
import scene2hap.testing

TITLES = {
    "scene": "Scenes",
    "materials": "Materials",
    "haptics": "Haptic data",
    "contact": "Contacts",
    "propagation": "Propagation models",
    "audio": "Sounds and conversion",
    "clips": "Haptic clips",
    "llm": "Language models",
    "bundle": "Bundles",
    "baking": "Baking",
    "session": "Sessions",
    "engines": "Engines",
    "export": "Exports",
    "devices": "Actuators",
    "testing": "Contracts for plug-ins",
    "common": "Warnings",
    "errors": "Errors",
}
ROOT = Path(__file__).parents[1]


def public_names() -> dict[str, list[str]]:
    """Return the full names of all public objects by part, each where it is defined."""
    names = defaultdict(list)
    shown = [getattr(scene2hap, name) for name in scene2hap.__all__ if name != "__version__"]
    for module in (scene2hap.testing, scene2hap.errors):
        shown += [value for name, value in vars(module).items() if of_module(value, module.__name__, name)]
    for value in shown:
        names[value.__module__.split(".")[1]].append(f"{value.__module__}.{value.__qualname__}")
    return names


def public_modules() -> dict[str, str]:
    """Return the modules that define public objects, with their files from the root of the repository."""
    names = {full.rsplit(".", 1)[0] for part in public_names().values() for full in part}
    found = {}
    for name in sorted(names):
        path = Path(*name.split("."))
        found[name] = (path / "__init__.py" if (ROOT / path).is_dir() else path.with_suffix(".py")).as_posix()
    return found


def of_module(value: object, module: str, name: str) -> bool:
    """Return whether a public class or function belongs to a module or package."""
    is_code = inspect.isclass(value) or inspect.isfunction(value)
    return is_code and not name.startswith("_") and value.__module__.startswith(module)


def write_reference_pages(folder: Path) -> None:
    """Write all pages, those that changed alone, so that a second build reads few."""
    names = public_names()
    if missing := names.keys() - TITLES.keys():
        raise ValueError(f"docs/reference_pages.py has no title for the parts {sorted(missing)}. Add one each.")
    pages = {part: page(title, sorted(set(names[part]), key=str.casefold)) for part, title in TITLES.items()}
    rows = [f"- [{title}]({part}.md)" for part, title in TITLES.items()]
    toctree = ["```{toctree}", ":hidden:", "", *TITLES, "```"]
    intro = "All public names, each with the module that defines it. Import them by `from scene2hap import NAME`, those"
    intro += " of the last two pages from `scene2hap.testing` and `scene2hap.errors`."
    pages["index"] = "\n".join(["# API", "", intro, "", *rows, "", *toctree, ""])
    folder.mkdir(exist_ok=True)
    for name, text in pages.items():
        path = folder / f"{name}.md"
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")
    for path in folder.glob("*.md"):
        if path.stem not in pages:
            path.unlink()


def page(title: str, names: list[str]) -> str:
    """Return a page that documents these names."""
    lines = [f"# {title}", ""]
    for name in names:
        lines += [f"## {name.rsplit('.', 1)[1]}", "", f"```{{autodoc2-object}} {name}", "```", ""]
    return "\n".join(lines)


class ReferenceRenderer(MystRenderer):
    """Renderer that leaves out values that say nothing: None for a field without a default, and calls."""

    def render_data(self, item: ItemData) -> Iterable[str]:
        """Yield an attribute, with its value where that is one."""
        lines = list(super().render_data(item))
        value = str(item.get("value"))
        if value == "None" or "(" in value:
            start = next((n for n, line in enumerate(lines) if line.startswith(":value:")), None)
            if start is not None:
                del lines[start : start + (2 if lines[start].endswith(">") and "<" not in lines[start] else 1)]
        yield from lines
