"""The JSON and the scenes of the client for C."""

import json
import shutil
import struct
import subprocess
from pathlib import Path

import numpy as np
import pytest

from c_client import HERE, Build, Driver, needs_c
from scene2hap import Box, SceneSnapshot, TriMesh

pytestmark = needs_c

TEXTS = [
    *("0", "-0", "1", "-1.5", "0.1", "1e3", "1E+3", "1.5e-3", "123456789012345678901234567890", "0.724", "3.5e300"),
    *(
        "1e-310",
        "4.9e-324",
        "2.2250738585072014e-308",
        "0.000000000000000000000000000000001",
        "1e22",
        "1e23",
        "9" * 400,
    ),
    *("[]", "{}", "[1,2, 3]", ' { "a" : 1 , "b\\u00e9" : [ { } ] } ', '"x"', '"\\"\\\\\\/\\b\\f\\n\\r\\t\\u20ac"'),
    *('"\\ud83d\\ude00"', '"é€\U0001f600"', "true", "false", "null", "[[[[[[1]]]]]]", '{"": 2}', "[1e400]", "1e400"),
    *("", " ", "01", "+1", ".5", "1.", "1e", "1e+", "-", "0x1", "NaN", "Infinity", "[1,]", "[,1]", "[1 2]", "{1:2}"),
    *('{"a"}', '{"a":}', '{"a":1,}', '{"a" 1}', "[", "]", "}", "[}", '"', '"\\', '"\\x"', '"\\u12"', '"\t"', "'a'"),
    *("tru", "nulll", "1 1", "\ufeff1", "{", '{"a"', '{"a":1', '"\\u', "[1", "--1", "1-", "1e5.5", "[true false]"),
]


@pytest.mark.parametrize("text", TEXTS)
def test_json_is_read_as_python_reads_it(driver: Driver, text: str) -> None:
    found = driver.one(f"parse {text.encode().hex()}")
    try:
        expected = json.loads(text, parse_constant=lambda name: name[10**9], parse_int=float)  # NaN is not JSON
    except (ValueError, IndexError):
        assert not found["is_json"]
        return
    assert found["is_json"]
    if isinstance(expected, str):
        assert found["string"] == expected
    elif isinstance(expected, float):
        assert_is(found["number"], expected)
    elif isinstance(expected, list):
        assert len(found["items"]) == len(expected)
    elif isinstance(expected, dict):
        assert found["items"][::2] == [*expected]


def assert_is(found: float, expected: float) -> None:
    if np.isinf(expected):
        assert found == -4.5  # the value for "not a number"
    else:
        assert found == pytest.approx(expected, rel=1e-14, abs=5e-324)


def test_json_with_invalid_utf_8_is_refused(driver: Driver) -> None:
    wrong = [b"\xff", b"\xc0\x80", b"\xed\xa0\x80", b"\xf4\x90\x80\x80", b"\xe2\x82", b"\xf0\x8f\xbf\xbf", b"\x80"]
    for text in (b'"' + one + b'"' for one in wrong):
        assert not driver.one(f"parse {text.hex()}")["is_json"]


def test_json_depth_is_bounded(driver: Driver) -> None:
    assert driver.one(f"parse {(64 * b'[' + 64 * b']').hex()}")["is_json"]
    assert not driver.one(f"parse {(65 * b'[' + 65 * b']').hex()}")["is_json"]
    assert not driver.one(f"parse {(30000 * b'[').hex()}")["is_json"]


def test_lone_surrogates_and_zeros_are_replaced(driver: Driver) -> None:
    text = rb'"a\u0000b\ud800c\udc00d\ud800\u0041"'
    assert driver.one(f"parse {text.hex()}")["string"] == "a\ufffdb\ufffdc\ufffdd\ufffdA"


def test_long_strings_are_cut_between_characters(driver: Driver) -> None:
    text = json.dumps("a" + "€" * 100, ensure_ascii=False).encode()
    assert driver.one(f"parse {text.hex()}")["string"] == "a" + "€" * 84  # limited to 255 bytes


def test_numbers_round_trip_exactly(driver: Driver) -> None:
    rng = np.random.default_rng(3)
    bits = rng.integers(0, 1 << 64, 300, dtype=np.uint64)
    numbers = [*bits.view(float), 0.1, 1 / 3, 5e-324, 1.7976931348623157e308, 0.0, 123456789.0, 1e21, 2**53 + 2.0]
    for number in numbers:
        (word,) = struct.unpack("<Q", struct.pack("<d", number))
        found = driver.one(f"bits {word:016x}")
        if np.isfinite(number):
            assert found["number"] == number
            read = driver.one(f"parse {repr(float(number)).encode().hex()}")
            assert read["number"] == pytest.approx(number, rel=1e-14, abs=5e-324)
        else:
            assert found == {"failed": True}


def test_scenes_built_by_the_client_equal_the_expected_scenes(driver: Driver) -> None:
    driver.do("scene")
    scene = SceneSnapshot.from_json(driver.printed[-2])
    assert (scene.name, scene.up_axis) == ('a "study"', "z")
    table, spike = scene.object("table"), scene.object("spike")
    assert table.name == "Oak table €\t\\"
    assert table.pose.position_m == (0.1, -2e-7, 1e3)
    assert table.pose.rotation_xyzw == pytest.approx((0.0, 0.6, 0.0, 0.8))
    assert isinstance(table.geometry, Box)
    assert table.geometry.size_m == (1.2, 0.04, 0.7)
    assert isinstance(spike.geometry, TriMesh)
    assert spike.pose.rotation_xyzw == (0.0, 0.0, 0.0, 1.0)
    vertices = np.asarray(spike.geometry.vertices_m, np.float32)
    np.testing.assert_array_equal(vertices, np.array([[0, 0, 0], [0.1, 0, 0], [0, 0.1, 0], [0, 0, 1 / 3]], np.float32))
    a, b, c = (vertices.astype(float)[np.asarray(spike.geometry.faces)[:, k]] for k in range(3))
    assert (a * np.cross(b, c)).sum() / 6 == pytest.approx(0.1 * 0.1 / 18)  # outwards


def test_a_locale_with_decimal_commas_changes_nothing(build: Build, tmp_path: Path) -> None:
    localedef = shutil.which("localedef")
    made = tmp_path / "de_DE.UTF-8"
    if localedef is not None:
        subprocess.run([localedef, "-i", "de_DE", "-f", "UTF-8", str(made)], capture_output=True, check=False)
    if not (made / "LC_NUMERIC").exists():
        pytest.skip("no locale with decimal commas can be made; on Debian: apt-get install locales")
    program = build(HERE / "driver.c", HERE / "client.c")
    driver = Driver(program, LOCPATH=str(tmp_path), SCENE2HAP_DRIVER_LOCALE="de_DE.UTF-8")
    try:
        assert driver.one("decimal_point")["decimal_point"] == ","
        assert driver.one("bits 3fb999999999999a")["number"] == 0.1
        assert driver.one(f"parse {b'0.25'.hex()}")["number"] == 0.25
        driver.do("scene")
        table = SceneSnapshot.from_json(driver.printed[-2]).object("table")
        assert table.geometry == Box((1.2, 0.04, 0.7))
        assert not driver.end()
    finally:
        driver.kill()
