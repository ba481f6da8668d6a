"""Inference of a whole scene by a real llama.cpp server, with a model of random weights that writes noise.

    python stress/llama_server.py [--server llama-server] [--weights FOLDER] [--no-images]

Builds the server once from the source in the package llama-cpp-python, which takes 5 minutes on two cores and needs a
C++ compiler and a package index. Writes the weights, and runs the chain on 44 objects with their pictures through the
standard stack. The text is noise, but each answer must be valid, repaired, or recorded as the error of its object.
`--weights` is a folder with tiny.gguf and mmproj.gguf, or with the script tiny_llm_gguf.py that writes them.
"""

from __future__ import annotations

import argparse
import asyncio
import math
import subprocess
import sys
import tarfile
import time
import warnings
from collections import Counter
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

import httpx

from scene2hap import LocalBackend, SceneSnapshot, capture_images, standard_stack
from scene2hap.llm.chain import Inference, infer_scene
from scene2hap.llm.wrappers import reports

sys.path.insert(0, str(Path(__file__).parents[1] / "benchmarks"))

from loopback import kitchen

ROOT = Path(__file__).parents[1]
BUILD = ROOT / "build" / "llama"
WEIGHTS = ROOT.parent / "shared" / "tools"
OFF = ("BUILD_SHARED_LIBS", "LLAMA_CURL", "LLAMA_OPENSSL", "LLAMA_BUILD_TESTS", "LLAMA_BUILD_EXAMPLES")
OFF_UI = ("LLAMA_BUILD_UI", "LLAMA_USE_PREBUILT_UI")
CONCURRENCY, CONTEXT = 4, 8192
# Token numbers: byte + 3 for all bytes, and again byte + 227 for printable bytes. Bytes above 127 are banned, because
# most random sequences of them are not UTF-8, for which the server returns status 500. Ends of texts and numbers, and
# zeros, are made likelier. With uniform noise nearly every answer would have a text or number beyond its bound, and no
# object would get past its first request.
BIAS = (
    *(f"{3 + byte}-1000" for byte in range(128, 256)),
    *(
        f"{first + ord(mark)}+{more}"
        for mark, more in {'"': 2.5, ",": 2.5, "0": 2.5, ".": 1.5}.items()
        for first in (3, 227)
    ),
)
TEMPERATURE = 1.0


def main() -> int:
    """Run the campaign. Returns 1 if an object has neither an answer nor its own error."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--server", type=Path, help="a llama-server that is there already")
    parser.add_argument("--weights", type=Path, default=WEIGHTS)
    parser.add_argument("--no-images", action="store_true")
    arguments = parser.parse_args()
    BUILD.mkdir(parents=True, exist_ok=True)
    server = arguments.server or built_server()
    scene = kitchen() if arguments.no_images else capture_images(kitchen())
    started = time.monotonic()
    with serving(server, weights(arguments.weights)) as url:
        backend = standard_stack(LocalBackend(base_url=url, max_tokens=4000, timeout_s=120.0), retries=2)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # a model of noise does not follow its prompt
            found = asyncio.run(
                infer_scene(scene, backend, config={"concurrency": CONCURRENCY, "temperature": TEMPERATURE})
            )
        # No request may have crashed the server.
        healthy = httpx.get(url.removesuffix("/v1") + "/health").status_code == 200
    return show(scene, found, reports(backend), time.monotonic() - started, healthy=healthy)


def show(scene: SceneSnapshot, found: Inference, layers: Mapping[str, object], wall_s: float, *, healthy: bool) -> int:
    """Print the outcomes. Returns the exit status."""
    outcomes: Counter[str] = Counter()
    for item in scene.objects:
        haptics = found.objects[item.id]
        numbers = [*haptics.estimated_size_m, haptics.confidence, *(state.intensity for state in haptics.states)]
        if haptics.material is not None:
            numbers += [haptics.material.density_kg_m3, haptics.material.youngs_modulus_pa]
        if not all(map(math.isfinite, numbers)):
            outcomes["not finite"] += 1
        elif item.id in found.report.errors:
            outcomes["own error"] += 1
        else:
            outcomes["answered"] += 1
    print(f"{len(scene.objects)} objects in {wall_s:.0f} s: {dict(outcomes)}; server alive: {healthy}")
    print(f"calls {dict(found.report.calls)}, errors of all kinds {len(found.report.errors)}")
    for name, report in layers.items():
        print(f"  {name}: {report}")
    kinds = Counter(problem.split(": ", 2)[-1][:70] for problem in found.report.errors.values())
    for problem, number in kinds.most_common(8):
        print(f"  {number:>3} x {problem}")
    return 0 if healthy and outcomes["answered"] + outcomes["own error"] == len(scene.objects) else 1


@contextmanager
def serving(server: Path, folder: Path) -> Iterator[str]:
    """Run the server. Yields its address once it is ready."""
    bias = [word for change in BIAS for word in ("--logit-bias", change)]
    command = [server, "-m", folder / "tiny.gguf", "--mmproj", folder / "mmproj.gguf", "--jinja", "--offline"]
    command += [
        "--host",
        "127.0.0.1",
        "--port",
        "8091",
        "-t",
        "1",
        "-np",
        CONCURRENCY,
        "-c",
        CONCURRENCY * CONTEXT,
        *bias,
    ]
    with (BUILD / "server.log").open("wb") as log:
        process = subprocess.Popen([str(word) for word in command], stdout=log, stderr=log)
        try:
            wait_until_ready("http://127.0.0.1:8091/health", process)
            yield "http://127.0.0.1:8091/v1"
        finally:
            process.terminate()
            process.wait()


def wait_until_ready(address: str, process: subprocess.Popen[bytes]) -> None:
    """Poll until the server answers."""
    for _ in range(600):
        if process.poll() is not None:
            raise SystemExit(f"the server ended with status {process.returncode}; see {BUILD / 'server.log'}")
        try:
            if httpx.get(address).status_code == 200:
                return
        except httpx.HTTPError:
            pass
        time.sleep(0.1)
    raise SystemExit("the server is not ready after a minute")


def built_server() -> Path:
    """Build llama-server if it is not built yet. Returns its path."""
    server = BUILD / "bld" / "bin" / "llama-server"
    if server.is_file():
        return server
    pip = [sys.executable, "-m", "pip"]
    run([*pip, "install", "-q", "--target", BUILD / "tools", "cmake"])
    run([*pip, "download", "-q", "--no-deps", "--no-binary", "llama-cpp-python", "-d", BUILD, "llama-cpp-python"])
    archive = max(BUILD.glob("llama_cpp_python-*.tar.gz"))
    with tarfile.open(archive) as file:
        file.extractall(BUILD, filter="data")
    source = BUILD / archive.name.removesuffix(".tar.gz") / "vendor" / "llama.cpp"
    cmake = BUILD / "tools" / "cmake" / "data" / "bin" / "cmake"
    switches = [f"-D{name}=OFF" for name in (*OFF, *OFF_UI)]
    run([cmake, "-S", source, "-B", BUILD / "bld", "-DCMAKE_BUILD_TYPE=Release", *switches])
    run([cmake, "--build", BUILD / "bld", "--target", "llama-server", "-j2"])
    return server


def weights(folder: Path) -> Path:
    """Make the weights if they are missing. Returns the folder with the weights."""
    if (folder / "tiny.gguf").is_file():
        return folder
    script = folder / "tiny_llm_gguf.py"
    if not script.is_file():
        raise SystemExit(f"{folder} has neither tiny.gguf nor tiny_llm_gguf.py; name a folder with --weights")
    run([sys.executable, "-m", "pip", "install", "-q", "--target", BUILD / "tools", "--no-deps", "gguf"])
    subprocess.run([sys.executable, str(script), str(BUILD)], check=True, env={"PYTHONPATH": str(BUILD / "tools")})
    return BUILD


def run(command: list[object]) -> None:
    """Run a command that must succeed."""
    print("+", *command, flush=True)
    subprocess.run([str(word) for word in command], check=True)


if __name__ == "__main__":
    sys.exit(main())
