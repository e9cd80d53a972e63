"""The wheel that pip makes, of the finished build: content, metadata, and that it works alone."""

import email
import importlib.util
import os
import pathlib
import shutil
import subprocess
import sys
import zipfile

import pytest

import hamjet
from conftest import SOURCE, command

PACKAGE = SOURCE / "src" / "python"

for name in ("pip", "setuptools", "wheel"):
    if importlib.util.find_spec(name) is None:
        pytest.skip(f"python3-{name} is not installed", allow_module_level=True)
if shutil.which("cmake") is None:
    pytest.skip("cmake is not installed", allow_module_level=True)


@pytest.fixture(scope="module", name="wheel")
def built_wheel(tmp_path_factory):
    folder = tmp_path_factory.mktemp("wheel")
    before = sorted(PACKAGE.rglob("*"))
    build = pathlib.Path(hamjet.__file__).parents[2]
    made = subprocess.run(
        [sys.executable, "-m", "pip", "wheel", "--no-build-isolation", "--no-deps", "--no-index",
         "--no-cache-dir", "--disable-pip-version-check", "--wheel-dir", folder, PACKAGE],
        env={**os.environ, "HAMJET_WHEEL_FROM": str(build)}, capture_output=True, text=True,
        check=False)
    assert made.returncode == 0, made.stdout + made.stderr
    assert sorted(PACKAGE.rglob("*")) == before, "something was left in the source tree"
    (wheel,) = folder.iterdir()
    return wheel


def test_the_wheel_has_the_package_and_nothing_else(wheel):
    with zipfile.ZipFile(wheel) as archive:
        names = set(archive.namelist())
    compiled = pathlib.Path(hamjet._hamjet.__file__).name
    files = {f"hamjet/{path.name}" for path in (PACKAGE / "hamjet").iterdir() if path.is_file()}
    assert {name for name in names if ".dist-info/" not in name} == files | {f"hamjet/{compiled}"}
    assert {"hamjet/py.typed", "hamjet/_hamjet.pyi", "hamjet/orbits.py"} <= names


def test_the_metadata_are_those_of_the_project(wheel):
    with zipfile.ZipFile(wheel) as archive:
        (metadata,) = [name for name in archive.namelist() if name.endswith("/METADATA")]
        said = email.message_from_string(archive.read(metadata).decode())
        (tags,) = [name for name in archive.namelist() if name.endswith("/WHEEL")]
        made_for = email.message_from_string(archive.read(tags).decode())
    assert said["Name"] == "hamjet" and said["Version"] == hamjet.__version__
    printed = command("--version", directory=SOURCE).stdout
    assert said["Version"] in printed
    project = (SOURCE / "CMakeLists.txt").read_text(encoding="utf-8")
    assert said["Summary"] and f'DESCRIPTION "{said["Summary"]}"' in project
    assert any(line.startswith("numpy") for line in said.get_all("Requires-Dist"))
    # The wheel holds compiled code for this interpreter.
    assert made_for["Root-Is-Purelib"] == "false"
    assert f"cp{sys.version_info[0]}{sys.version_info[1]}-" in made_for["Tag"]


def test_what_is_unpacked_works_alone(wheel, tmp_path):
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(tmp_path)
    text = ("import hamjet; print(hamjet.__file__); print(hamjet.run(hamjet.orbit(a_km=7000, e=0, "
            "i_deg=50, order=1, duration_orbits=0.1)).runs['gauss8'].jet.order)")
    printed = subprocess.run(
        [sys.executable, "-c", text], cwd=tmp_path, check=True, capture_output=True, text=True,
        env={**os.environ, "PYTHONPATH": str(tmp_path)}).stdout.split()
    assert printed == [str(tmp_path / "hamjet" / "__init__.py"), "1"]
