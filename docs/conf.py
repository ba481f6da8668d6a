"""The site of the documentation: `sphinx-build -W --keep-going -c docs . build/site` in the root of the repository.

The root is the source folder, so that README.md, CONTRIBUTING.md and CHANGELOG.md are pages, and relative links work in
the site as they do between files. Nothing is fetched: neither other projects' inventories, nor fonts, nor scripts.
"""

from __future__ import annotations

import sys
from pathlib import Path

from pygments.lexers.special import TextLexer
from sphinx.application import Sphinx

DOCS = Path(__file__).parent
sys.path.insert(0, str(DOCS))  # for the modules beside this one

from reference_pages import public_modules, write_reference_pages  # noqa: E402

project = "scene2hap"
author = "The scene2hap authors"
html_title = "scene2hap"

extensions = ["myst_parser", "autodoc2"]
include_patterns = [
    *("README.md", "CONTRIBUTING.md", "CHANGELOG.md", "SECURITY.md"),
    *("docs/*.md", "docs/**/*.md", "clients/*/README.md"),
]
# Folders without pages are named, since Sphinx walks through whatever is not excluded.
exclude_patterns = [
    ".*",
    "*.egg-info",
    "benchmarks",
    "build",
    "dist",
    "examples",
    "firmware",
    "scene2hap",
    "stress",
    "tests",
]
root_doc = "docs/index"

html_theme = "furo"
html_copy_source = False
html_show_copyright = False
templates_path: list[str] = []
smartquotes = False  # quotes in prose are often code

myst_heading_anchors = 4  # links to headings by the slugs of GitHub
myst_links_external_new_tab = False

# Only modules with public names: analysing the others takes most of a build and shows nothing.
autodoc2_packages = [{"path": path, "module": name, "auto_mode": False} for name, path in public_modules().items()]
autodoc2_output_dir = "docs/api"
autodoc2_index_template = None
autodoc2_render_plugin = "reference_pages.ReferenceRenderer"
autodoc2_hidden_objects = {"private", "dunder", "inherited"}
autodoc2_class_docstring = "both"  # "merge" adds a heading above each __init__ without a docstring
python_use_unqualified_type_names = True
autodoc2_docstring_parser_regexes = [(r".*", "plain_docstrings")]


def write_entrance(app: Sphinx, error: Exception | None) -> None:
    """Write the index.html that browsers look for: the site begins in the folder docs."""
    if error is None and app.builder.format == "html":
        page = '<!doctype html><meta http-equiv="refresh" content="0; url=docs/index.html"><title>scene2hap</title>\n'
        (Path(app.outdir) / "index.html").write_text(page, encoding="utf-8")


def setup(app: Sphinx) -> None:
    """Join the parts that Sphinx and its extensions lack."""
    app.connect("builder-inited", lambda app: write_reference_pages(DOCS / "api"), priority=400)
    app.connect("build-finished", write_entrance)
    for language in ("csv", "mermaid"):  # shown as text: Pygments knows neither, and a diagram takes a script to draw
        app.add_lexer(language, TextLexer)
