"""jets.h5 in the hands of h5py, an independent reader and writer of HDF5.

python3 jets_hdf5_test.py HAMJET    runs the built command; exits with 77 (skipped) without h5py.
"""

import csv
import fcntl
import json
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import textwrap
import unittest

try:
    import h5py
    import numpy
except ImportError as error:
    print(f"skipped: {error}; install python3-h5py")
    sys.exit(77)

HAMJET = os.path.abspath(sys.argv.pop(1))

SCENE = """schema = 1
title = "kepler"
[system]
model = "kepler"
mu_km3_s2 = 398600.4415
[nominal]
position_km = [7000, 0, 0]
velocity_km_s = [0.5, 7.5, 0.1]
[jet]
order = 3
duration_canonical = 0.7
[[integrator]]
label = "gauss8"
method = "gauss"
stages = 8
tolerance = 1e-14
[[integrator]]
label = "midpoint"
method = "gauss"
stages = 1
step_canonical = 0.1
[generating_function]
kinds = ["F1"]
[output]
formats = ["hdf5"]
"""


def hamjet(*arguments):
    return subprocess.run([HAMJET, *map(str, arguments)], capture_output=True, text=True, timeout=120)


def bits(numbers):
    return [struct.pack("<d", float(number)) for number in numbers]


def rows(file):
    with open(file, newline="") as stream:
        return list(csv.DictReader(stream))


class JetsHdf5Test(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory(prefix="hamjet-test-")
        cls.folder = pathlib.Path(cls.temporary.name)
        (cls.folder / "scene.toml").write_text(SCENE)
        for name, options in {"results": [], "extended": ["--set", "precision=extended"]}.items():
            result = hamjet("run", cls.folder / "scene.toml", "-q", "-o", cls.folder / name, *options)
            assert result.returncode == 0, result.stderr
        cls.results = cls.folder / "results"
        cls.file = cls.results / "jets.h5"

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def copy(self, name="copy.h5", source=None):
        """The file as HDF5 alone: without the first 512 bytes, hamjet's checksum."""
        copy = self.folder / name
        copy.write_bytes((source or self.file).read_bytes()[512:])
        return copy

    # What is in the file.

    def test_attributes_are_those_of_the_summary(self):
        summary = json.loads((self.results / "summary.json").read_text())
        with h5py.File(self.file) as file:
            attributes = dict(file.attrs)
            self.assertEqual(file.userblock_size, 512)
        for key in ["scene", "title", "model", "precision", "order", "duration_canonical"]:
            self.assertEqual(attributes[key], summary[key], key)
        self.assertEqual(attributes["hamjet_version"], summary["version"])
        self.assertEqual(attributes["format_version"], 1)
        self.assertEqual(attributes["length_unit_km"], summary["units"]["length_km"])
        self.assertEqual(attributes["time_unit_s"], summary["units"]["time_s"])
        for key in ["components", "variables", "nominal_initial"]:
            self.assertEqual(list(attributes[key]), summary[key], key)
        self.assertEqual(list(attributes["runs"]), ["gauss8", "midpoint"])
        self.assertEqual(list(attributes["state"]), ["x", "y", "z", "px", "py", "pz"])
        self.assertIn("inertial", attributes["frame"])
        self.assertIn("HDF5_USE_FILE_LOCKING", attributes["description"])

    def test_coefficients_are_those_of_the_csv(self):
        with h5py.File(self.file) as file:
            for label in file.attrs["runs"]:
                table = rows(self.results / label / "jet.csv")
                run = file[label]
                self.assertEqual(run["coefficients"].shape, (6, 84))
                self.assertEqual(run["exponents"].dtype, numpy.uint8)
                self.assertEqual([axis.label for axis in run["coefficients"].dims],
                                 ["component", "term"])
                self.assertEqual([axis.label for axis in run["exponents"].dims],
                                 ["term", "variable"])
                self.assertEqual(bits(run["coefficients"][()].ravel()),
                                 bits(row["coefficient"] for row in table))
                exponents = [[int(row["e_" + name]) for name in file.attrs["variables"]]
                             for row in table[:84]]
                self.assertEqual(run["exponents"][()].tolist(), exponents)

    def test_nominal_and_generating_function_are_those_of_the_csv(self):
        with h5py.File(self.file) as file:
            run = file["gauss8"]
            table = rows(self.results / "gauss8" / "nominal.csv")
            self.assertEqual(bits(run["nominal_time"]), bits(row["time_canonical"] for row in table))
            names = file.attrs["state"]
            self.assertEqual(bits(run["nominal_state"][()].ravel()),
                             bits(row[name] for row in table for name in names))
            function = run["generating_functions/F1"]
            table = rows(self.results / "gauss8" / "generating_function_F1.csv")
            self.assertEqual(bits(function["coefficients"]), bits(row["coefficient"] for row in table))
            exponents = [[int(row["e_" + name]) for name in function.attrs["variables"]]
                         for row in table]
            self.assertEqual(function["exponents"][()].tolist(), exponents)

    def test_extended_precision_has_all_digits(self):
        table = rows(self.folder / "extended" / "gauss8" / "jet.csv")
        with h5py.File(self.folder / "extended" / "jets.h5") as file:
            run = file["gauss8"]
            self.assertEqual([text.decode() for text in run["coefficients_decimal"][()].ravel()],
                             [row["coefficient"] for row in table])
            self.assertEqual(bits(run["coefficients"][()].ravel()),
                             bits(row["coefficient"] for row in table))

    def test_the_lines_for_python_in_the_description(self):
        with h5py.File(self.file) as file:
            description = file.attrs["description"]
        lines = description[description.index("Python:\n") + 8 : description.index("MATLAB and")]
        names = {}
        here = os.getcwd()
        os.chdir(self.results)
        try:
            exec(textwrap.dedent(lines), names)
        finally:
            os.chdir(here)
        deviation = [1e-3, -2e-3, 5e-4, 1e-4, 3e-4, -2e-4]
        result = hamjet("eval", self.results, "--frame", "canonical", "--json", "-q", "--deviation",
                        ",".join(map(repr, deviation)))
        self.assertEqual(result.returncode, 0, result.stderr)
        (row,) = json.loads(result.stdout)["rows"]
        zero = names["final"](numpy.zeros(6))
        for value, name, nominal in zip(names["final"](deviation), names["names"], zero):
            self.assertAlmostEqual(value - nominal, row[name], delta=4e-15)  # of states about 1
        self.assertEqual(names["axes"], ["component", "term"])

    # What something else has written.

    def test_a_file_of_h5py_is_read(self):
        other = self.folder / "other.h5"
        with h5py.File(self.file) as source, h5py.File(other, "w") as target:
            for key in source.attrs:
                if key != "description":
                    target.attrs[key] = source.attrs[key]
            target.attrs["scene"] = numpy.bytes_(source.attrs["scene"])  # of fixed length
            group = target.create_group("gauss8")
            group.attrs["nominal_final"] = source["gauss8"].attrs["nominal_final"]
            group["coefficients"] = source["gauss8/coefficients"][()].astype(">f8")
            group["exponents"] = source["gauss8/exponents"][()]
            target.attrs["runs"] = ["gauss8"]
        result = hamjet("convert", other, self.folder / "other.csv")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertEqual((self.folder / "other.csv").read_bytes(),
                         (self.results / "gauss8" / "jet.csv").read_bytes())

    def test_a_file_locked_by_another_is_read(self):
        # hamjet hands HDF5 the bytes, so that no lock of HDF5's is taken: nothing fails on file
        # systems that have none, or whose locks hang.
        with open(self.file, "rb+") as locked:
            fcntl.flock(locked, fcntl.LOCK_EX)
            result = hamjet("convert", self.file, self.folder / "locked.csv")
        self.assertEqual((result.returncode, result.stderr), (0, ""))

    # Damage.

    def expect_refused(self, file, *words):
        result = hamjet("eval", file, "--deviation", "0,0,0,0,0,0")
        message = result.stderr
        self.assertEqual((result.returncode, result.stdout), (5, ""), message)
        self.assertTrue(message.startswith(f"hamjet: {file}: "), message)
        self.assertEqual(message.count("\n"), 1, message)
        self.assertNotIn("HDF5-DIAG", message)
        self.assertLess(len(message), 600)
        for word in words:
            self.assertIn(word, message)

    def damaged(self, damage, *words, source=None):
        copy = self.copy(source=source)
        with h5py.File(copy, "r+") as file:
            damage(file)
        with self.subTest(words=words):
            self.expect_refused(copy, *words)

    def test_left_open_by_its_writer(self):
        file = self.folder / "open.h5"
        child = os.fork()
        if child == 0:
            left = h5py.File(file, "w", libver="latest")
            left["data"] = [1.0]
            left.flush()
            os._exit(0)  # as a kill would
        os.waitpid(child, 0)
        self.expect_refused(file, "HDF5 cannot open it", "left open")

    def test_other_files(self):
        text = self.folder / "text.h5"
        text.write_text("no HDF5")
        self.expect_refused(text, "is not an HDF5 file of jets")
        text.write_text("")
        self.expect_refused(text, "is not an HDF5 file of jets")
        with h5py.File(text, "w") as file:
            file["data"] = [1.0]
        self.expect_refused(text, "format: must be", "holds no jets")
        changed = self.folder / "changed.h5"
        changed.write_bytes(self.file.read_bytes())
        with h5py.File(changed, "r+") as file:
            file["gauss8/coefficients"][0, 3] *= 2
        self.expect_refused(changed, "was cut or changed", "checksum")

    def test_additions_of_another_program(self):
        added = self.folder / "added.h5"

        def write(change):
            added.write_bytes(self.file.read_bytes())
            with h5py.File(added, "r+") as file:
                file["gauss8"].attrs["note"] = numpy.arange(100.0)
                file.create_group("analysis")["residuals"] = numpy.ones((50, 3))
                change(file)

        write(lambda file: None)
        self.assertGreater(added.stat().st_size, self.file.stat().st_size)
        result = hamjet("convert", added, self.folder / "added.csv")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("note: ", result.stderr)
        self.assertIn("another program has added to it", " ".join(result.stderr.split()))
        self.assertEqual((self.folder / "added.csv").read_bytes(),
                         (self.results / "gauss8" / "jet.csv").read_bytes())

        # What is hamjet's own is checked as before.
        def scaled(file):
            file["gauss8/coefficients"][0, 3] *= 2

        for change in [scaled,
                       lambda file: file.attrs.__setitem__("length_unit_km", 7001.0),
                       lambda file: file.attrs.__setitem__("duration_canonical", 0.75),
                       lambda file: file.attrs.__setitem__("scene", "another"),
                       lambda file: file["gauss8"].attrs.__delitem__("content_crc32")]:
            write(change)
            self.expect_refused(added, "was cut or changed", "checksum")

    def test_attributes(self):
        needed = ["format", "format_version", "scene", "model", "precision", "length_unit_km",
                  "time_unit_s", "duration_canonical", "nominal_initial", "components", "variables",
                  "order", "runs"]

        def without(key):
            return lambda file: file.attrs.__delitem__(key)

        def having(key, value):
            return lambda file: file.attrs.__setitem__(key, value)

        for key in needed:
            self.damaged(without(key), key + ": ")
            is_text = key in ["format", "scene", "model", "precision", "components", "variables",
                              "runs"]
            self.damaged(having(key, 1.5 if is_text else "text"), key + ": the attribute must be")
            self.damaged(having(key, h5py.Empty("f8")), key + ": ")
        self.damaged(having("format_version", 4), "format_version: is 4, this hamjet reads 1 to 3")
        # Of the second version, which is that of jets in other coordinates, it must name them.
        self.damaged(having("format_version", 2), "coordinates: the attribute is missing")
        self.damaged(having("length_unit_km", -1.0), "length_unit_km: the attribute must be positive")
        self.damaged(having("time_unit_s", numpy.nan), "time_unit_s: the attribute must be finite")
        self.damaged(having("time_unit_s", [1.0, 2.0]), "time_unit_s: the attribute must have 1")
        self.damaged(having("model", "kelper"), "model: the attribute must be one of", "kepler")
        self.damaged(having("order", 0), "order: the attribute must be 1 to 60, is 0")
        self.damaged(having("order", 4), "gauss8/coefficients: must have the shape (6, 210)")
        self.damaged(having("order", 60), "gauss8/coefficients: must have the shape")
        self.damaged(having("nominal_initial", numpy.zeros(5)), "nominal_initial: ", "no state")
        self.damaged(having("nominal_initial", numpy.zeros(5000)), "nominal_initial: ", "5000")
        self.damaged(having("components", ["y", "x"]), "components: ", "ascend")
        self.damaged(having("variables", ["x", "w"]), "variables: ", '"w"')
        self.damaged(having("scene", "two\nlines"), "scene: ", "printable")
        self.damaged(having("scene", b"\xff\xfe"), "scene: ", "printable")
        self.damaged(having("runs", ["../gauss8"]), "runs: ", "names of groups")
        self.damaged(having("runs", ["absent"]), "absent: is missing")
        self.damaged(lambda file: file["gauss8"].attrs.__setitem__("nominal_final", numpy.ones(6)),
                     "gauss8/nominal_final: ", "constant term")

    def test_datasets(self):
        def replaced(name, change, **options):
            def damage(file):
                data = change(file[name][()])
                del file[name]
                file.create_dataset(name, data=data, **options)

            return damage

        def number(value):
            def change(data):
                data[2, 7] = value
                return data

            return change

        def swapped(data):
            data[[4, 5]] = data[[5, 4]]
            return data

        def repeated(data):
            data[5] = data[4]
            return data

        coefficients, exponents = "gauss8/coefficients", "gauss8/exponents"
        for name in [coefficients, exponents]:
            self.damaged(lambda file: file.__delitem__(name), name + ": is missing")
            self.damaged(replaced(name, lambda data: data[:-1]), name + ": must have the shape")
            self.damaged(replaced(name, lambda data: data.T), name + ": must have the shape")
            self.damaged(replaced(name, lambda data: data.ravel()), name + ": must have the shape")
            self.damaged(replaced(name, lambda data: data, compression="gzip"),
                         name + ": must be contiguous")
            self.damaged(lambda file: (file.move(name, "x"),
                                       file.__setitem__(name, h5py.SoftLink("/x"))),
                         name + ": is a link")
            self.damaged(lambda file: (file.__delitem__(name), file.create_group(name)),
                         name + ": must be a dataset")
        for kind in ["f4", "i8", "S8"]:
            self.damaged(replaced(coefficients, lambda data: data.astype(kind)),
                         coefficients + ": must be float64")
        self.damaged(replaced(exponents, lambda data: data.astype("i4")), exponents + ": must be uint8")
        self.damaged(replaced(coefficients, number(numpy.nan)), "component 2, term 7", "finite")
        self.damaged(replaced(coefficients, number(-numpy.inf)), "component 2, term 7", "finite")
        self.damaged(replaced(exponents, swapped), exponents + ": of term 4 must be", "graded order")
        self.damaged(replaced(exponents, repeated), exponents + ": of term 5 must be")
        self.damaged(replaced(exponents, lambda data: data + 200), exponents + ": of term 0")
        self.damaged(lambda file: (file.__delitem__("gauss8"),
                                   file.__setitem__("gauss8", h5py.ExternalLink("a.h5", "/"))),
                     "gauss8: is a link")
        self.damaged(lambda file: (file.__delitem__("gauss8"), file.__setitem__("gauss8", 1.0)),
                     "gauss8: must be a group")

    def test_sizes_beyond_the_file(self):
        def huge(file):
            file.attrs["order"] = 60
            del file["gauss8/coefficients"]
            file.create_dataset("gauss8/coefficients", (6, 90858768), "f8")  # C(66, 6): 4 GB

        self.damaged(huge, "gauss8/coefficients: would be 4.36e+09 bytes, and the file has")

        def elsewhere(file):
            del file["gauss8/coefficients"]
            file.create_dataset("gauss8/coefficients", (6, 84), "f8",
                                external=[(str(self.folder / "scene.toml"), 0, 6 * 84 * 8)])

        self.damaged(elsewhere, "gauss8/coefficients: must be contiguous", "in another file")

    def test_extended_precision(self):
        name = "gauss8/coefficients_decimal"
        source = self.folder / "extended" / "jets.h5"

        def digits(text):
            def damage(file):
                data = file[name][()]
                data[2, 7] = text
                file[name][()] = data

            return damage

        for text in [b"nan", b"", b"1.0x", b"1e99999999", b"\xff", b"0.5"]:
            self.damaged(digits(text), name + ": component 2, term 7", source=source)
        self.damaged(lambda file: file.__delitem__(name), name + ": is missing", source=source)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[1:]], verbosity=1)
