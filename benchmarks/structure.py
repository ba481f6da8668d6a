"""Structure of scene2hap at two commits: size, import cycles and fan-in of each package, and files used for a gain.

python benchmarks/structure.py [--before 01b76f5] [--after HEAD] [--part table|way|tree]

A package here is a module or package directly below `scene2hap`. Imports are read from the source; those below
`TYPE_CHECKING` and inside functions count too. A cycle is a set of modules that import each other, directly or through
others. Fan-in is the number of modules outside the package that import it.

The way from a `SceneSnapshot` to a gain is traced with `sys.setprofile` in a new process, which counts the files whose
functions run. A session over the demo bundle is made, and updated with a touch and a moved object. Kernels run as their
Python twins, so that a compiled module counts as the file that a reader opens.
"""

from __future__ import annotations

import argparse
import ast
import io
import os
import subprocess
import sys
import tarfile
from collections import Counter, defaultdict
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

import networkx as nx

ROOT = Path(__file__).parents[1]
PACKAGE = "scene2hap"
TRACE = """
import inspect, sys, threading
from collections import Counter
from pathlib import Path
from scene2hap import HapticSession, SessionConfig, Touch, bake, load_scene
from scene2hap.demo import kitchen_path
from scene2hap.scene.pose import Pose
import scene2hap

root = Path(scene2hap.__file__).parent
bundle = bake(load_scene(kitchen_path()))
phase, entered, importing = "", {}, Counter()

def watch(frame, event, _):
    # Code of modules and class bodies runs during imports; its calls are not part of the way.
    is_import = not frame.f_code.co_flags & inspect.CO_OPTIMIZED
    if event == "call":
        importing[threading.get_ident()] += is_import
        if not importing[threading.get_ident()]:
            entered.setdefault(phase, set()).add(frame.f_code.co_filename)
    elif event == "return":
        importing[threading.get_ident()] -= is_import

touch = Touch("left", "dining_table", (2.2, 0.74, 2.2))
# Gains do not depend on impacts, which the first versions lacked.
config = {"impacts": False} if "impacts" in SessionConfig.model_fields else {}
here = bundle.snapshot.object("smartphone").pose
threading.setprofile(watch)
sys.setprofile(watch)
phase = "made"
session = HapticSession(bundle.snapshot, bundle, config)
phase = "first"
session.update(touches=[touch])
phase = "moved"
for step in range(1, 6):
    x, y, z = here.position_m
    frame = session.update({"smartphone": Pose((x, y, z + 0.01 * step), here.rotation_xyzw)}, [touch])
sys.setprofile(None)
threading.setprofile(None)
assert frame.gain("left", "smartphone") > 0
for name, files in entered.items():
    for file in sorted(files):
        if Path(file).is_relative_to(root):
            print(name, Path(file).relative_to(root).as_posix())
"""


class Source:
    """Source of scene2hap at one commit: its modules, their lines and imports."""

    def __init__(self, root: Path) -> None:
        self.files = {self._name(path, root): path for path in sorted(root.rglob("*.py"))}
        self.compiled = sorted([*root.rglob("*.pyx"), *root.rglob("*.pxd")])
        self.root = root
        self.imports: nx.DiGraph[str] = nx.DiGraph()
        self.imports.add_nodes_from(self.files)
        for name, path in self.files.items():
            self.imports.add_edges_from((name, found) for found in self._imported(name, path) if found != name)

    @property
    def packages(self) -> list[str]:
        return sorted({package_of(name) for name in self.files if name != PACKAGE})

    def _name(self, path: Path, root: Path) -> str:
        parts = path.relative_to(root.parent).with_suffix("").parts
        return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)

    def _imported(self, name: str, path: Path) -> Iterator[str]:
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Import):
                yield from (alias.name for alias in node.names if alias.name in self.files)
            elif isinstance(node, ast.ImportFrom):
                module = str(node.module)  # the package has no relative imports
                for alias in node.names:
                    inner = f"{module}.{alias.name}"
                    if inner in self.files:
                        yield inner
                    elif module in self.files:
                        yield module

    def cycles(self, package: str) -> list[list[str]]:
        """Sets of modules of a package that import each other, in alphabetical order."""
        inside = self.imports.subgraph(name for name in self.files if package_of(name) == package)
        return sorted(sorted(each) for each in nx.strongly_connected_components(inside) if len(each) > 1)

    def fan_in(self, package: str) -> int:
        return len({a for a, b in self.imports.edges if package_of(b) == package != package_of(a) and a != PACKAGE})

    def lines(self, package: str) -> tuple[int, int]:
        """Numbers of lines of Python and of Cython."""
        python = sum(count(path) for name, path in self.files.items() if package_of(name) == package)
        cython = sum(count(path) for path in self.compiled if path.relative_to(self.root).parts[0] == package)
        return python, cython

    def package_graph(self) -> nx.DiGraph[str]:
        graph: nx.DiGraph[str] = nx.DiGraph()
        graph.add_nodes_from(self.packages)
        for a, b in self.imports.edges:
            if PACKAGE not in (a, b) and package_of(a) != package_of(b):
                graph.add_edge(package_of(a), package_of(b))
        return graph

    def levels(self, package: str) -> list[list[str]]:
        """Modules of a package by level, first those without imports from the package; braces enclose a cycle."""
        inside = self.imports.subgraph(name for name in self.files if package_of(name) == package)
        merged = nx.condensation(inside)
        level: dict[int, int] = {}
        for each in reversed(list(nx.topological_sort(merged))):
            level[each] = 1 + max((level[below] for below in merged.successors(each)), default=-1)
        rows: dict[int, list[str]] = defaultdict(list)
        for each, at in level.items():
            members = merged.nodes[each]["members"]
            names = sorted(name.partition(f"{PACKAGE}.{package}.")[2] or "__init__" for name in members)
            rows[at].append(names[0] if len(names) == 1 else "{" + " ".join(names) + "}")
        return [sorted(rows[at]) for at in sorted(rows)]


def package_of(name: str) -> str:
    return name.split(".")[1] if "." in name else name


def count(path: Path) -> int:
    return len(path.read_text(encoding="utf-8").splitlines())


def extracted(commit: str, into: Path) -> Path:
    """Unpack the package's folder of a commit, which is below src/ in early ones. Returns its path."""
    packed = subprocess.run(["git", "archive", commit], cwd=ROOT, capture_output=True, check=True).stdout
    with tarfile.open(fileobj=io.BytesIO(packed)) as archive:
        archive.extractall(into, filter="data")
    return next(path for path in (into / PACKAGE, into / "src" / PACKAGE) if path.is_dir())


def way(package: Path) -> dict[str, set[str]]:
    """Files whose functions run while a session is made, in its first update, and in updates with a moved object."""
    environment = {**os.environ, "PYTHONPATH": str(package.parent)}
    run = subprocess.run(
        [sys.executable, "-c", TRACE], env=environment, cwd=package.parent, capture_output=True, text=True, check=True
    )
    found: dict[str, set[str]] = defaultdict(set)
    for line in run.stdout.splitlines():
        phase, _, name = line.partition(" ")
        found[phase].add(name)
    return found


def table(before: Source, after: Source) -> None:
    print("| package | modules | lines of Python | of Cython | modules in cycles | fan-in |\n|---|---|---|---|---|---|")
    totals = [Counter[int](), Counter[int]()]
    for package in sorted({*before.packages, *after.packages}):
        cells = []
        for source, total in zip((before, after), totals, strict=True):
            n = sum(package_of(name) == package for name in source.files if name != PACKAGE)
            found = [n, *source.lines(package), sum(map(len, source.cycles(package))), source.fan_in(package)]
            cells.append(found if n else None)
            total.update(dict(enumerate(found)))
        print(f"| `{package}` | " + " | ".join(pairs(*cells)) + " |")
    both = [[total[i] for i in range(4)] for total in totals]
    print("| all | " + " | ".join(pairs(*both)) + " | |")
    for title, source in (("before", before), ("after", after)):
        rings = [each for each in nx.strongly_connected_components(source.package_graph()) if len(each) > 1]
        print(f"\nCycles of whole packages {title}: {'; '.join(', '.join(sorted(each)) for each in rings) or 'none'}.")
        inside = [
            ", ".join(name.partition(".")[2] for name in ring)
            for package in source.packages
            for ring in source.cycles(package)
        ]
        print(f"Cycles inside packages {title}: {'; '.join(inside) or 'none'}.")


def pairs(before: list[int] | None, after: list[int] | None) -> list[str]:
    """Cells "before → after": one figure if nothing changed, a dash if the package does not exist."""
    if before is None or after is None:
        return [f"- → {b:,}" if before is None else f"{b:,} → -" for b in before or after or []]
    return [f"{a:,}" if a == b else f"{a:,} → {b:,}" for a, b in zip(before, after, strict=True)]


def print_way(before: Path, after: Path) -> None:
    ways = [way(before), way(after)]
    print("| part of the way | files before | files after |\n|---|---|---|")
    for phase, part in (
        ("made", "`HapticSession(scene, bundle)`"),
        ("first", "first `update`, one touch"),
        ("moved", "`update` with a moved object, the next five frames"),
    ):
        print(f"| {part} | {len(ways[0][phase])} | {len(ways[1][phase])} |")
    everything = [set().union(*each.values()) for each in ways]
    print(f"| all together | {len(everything[0])} | {len(everything[1])} |\n")
    packages = [Counter(name.partition("/")[0].removesuffix(".py") for name in each) for each in everything]
    print("| package | files before | files after |\n|---|---|---|")
    for package in sorted({*packages[0], *packages[1]}):
        print(f"| `{package}` | {packages[0][package]} | {packages[1][package]} |")


def print_tree(before: Source, after: Source) -> None:
    for title, source in (("before", before), ("after", after)):
        graph = source.package_graph()
        print(f"Packages {title}; an arrow means imports, implied arrows are left out.\n\n```mermaid")
        print("flowchart TD")
        drawn = nx.transitive_reduction(graph) if nx.is_directed_acyclic_graph(graph) else graph
        for a, b in sorted(drawn.edges):
            print(f"    {a} --> {b}")
        print("```\n")
    for package in ("contact", "session"):
        for title, source in (("before", before), ("after", after)):
            print(f"Modules of `{package}` {title}; each row imports rows below it, and braces enclose a cycle.\n\n```")
            for row in reversed(source.levels(package)):
                print("  ".join(row))
            print("```\n")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--before", default="01b76f5", metavar="COMMIT")
    parser.add_argument("--after", default="HEAD", metavar="COMMIT")
    parser.add_argument("--part", choices=("table", "way", "tree"), help="default all")
    arguments = parser.parse_args()
    with TemporaryDirectory() as folder:
        before, after = (extracted(c, Path(folder, c)) for c in (arguments.before, arguments.after))
        if arguments.part in (None, "table"):
            table(Source(before), Source(after))
        if arguments.part in (None, "way"):
            print_way(before, after)
        if arguments.part in (None, "tree"):
            print_tree(Source(before), Source(after))


if __name__ == "__main__":
    main()
