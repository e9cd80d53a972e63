"""Makes the wheel of the package: CMake compiles and installs, setuptools packs what is there."""

from __future__ import annotations

import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

SOURCE = pathlib.Path(__file__).resolve().parents[2]

#: A finished build, whose package is packed as it is; without one there is a build of its own.
FINISHED = os.environ.get("HAMJET_WHEEL_FROM")
#: It stays, so that the next wheel compiles what has changed alone.
BUILD = SOURCE / (FINISHED or os.environ.get("HAMJET_BUILD", "build-python"))


def said_to_cmake(pattern: str) -> str:
    """What the project's CMakeLists.txt says of the project."""
    found = re.search(pattern, (SOURCE / "CMakeLists.txt").read_text(encoding="utf-8"))
    if found is None:
        sys.exit(f"{SOURCE}/CMakeLists.txt: has nothing like {pattern}")
    return found[1]


def build() -> None:
    options = [f"-DPython3_EXECUTABLE={sys.executable}", "-DHAMJET_PYTHON=ON", "-DHAMJET_HDF5=ON",
               "-DHAMJET_COMMAND=OFF", "-DHAMJET_WERROR=OFF"]
    try:
        import pybind11
    except ImportError:
        pass  # Debian's is found where CMake looks.
    else:
        options.append(f"-Dpybind11_DIR={pybind11.get_cmake_dir()}")
    # Who calls has the last word, as with other packages that CMake builds.
    options += shlex.split(os.environ.get("CMAKE_ARGS", ""))
    subprocess.run([SOURCE / "tools" / "build", *options], check=True,
                   env={**os.environ, "HAMJET_BUILD": str(BUILD)})


class BuildWithCMake(build_ext):
    """Puts the package, as CMake installs it, where setuptools packs it from."""

    def run(self) -> None:
        if not FINISHED:
            build()
        with tempfile.TemporaryDirectory() as prefix:
            subprocess.run(["cmake", "--install", BUILD, "--component", "python", "--prefix",
                            prefix], check=True)
            (package,) = pathlib.Path(prefix).rglob("hamjet/__init__.py")
            shutil.copytree(package.parent, pathlib.Path(self.build_lib) / "hamjet",
                            dirs_exist_ok=True)


with tempfile.TemporaryDirectory() as work:  # setuptools would leave its folders in the source tree
    setup(
        version=said_to_cmake(r"project\(hamjet VERSION ([0-9.]+)"),
        description=said_to_cmake(r'DESCRIPTION "([^"]+)"'),
        packages=[],  # CMake installs all files, those of Python too
        ext_modules=[Extension("hamjet._hamjet", sources=[])],
        cmdclass={"build_ext": BuildWithCMake},
        options={"build": {"build_base": work}, "egg_info": {"egg_base": work}},
    )
