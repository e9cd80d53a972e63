"""The built command, as a user runs it."""
import csv
import json
import os
import resource
import signal
import subprocess

PROGRAM = os.environ.get("HAMJET_COMMAND", "hamjet")


class Refused(Exception):
    """The command ended without results: its exit code and what it says."""

    def __init__(self, code, text):
        super().__init__(text)
        self.code, self.text = code, text


class TooSlow(Exception):
    pass


class NoNumber(Exception):
    """A result that is not a number where there should be one."""


def no_constant(name):
    raise NoNumber(f"{name} in summary.json")


class Run:
    """A finished command: exit code, what it printed, and its results if it wrote any."""

    def __init__(self, folder, arguments, limit=60):
        """`limit` is of the processor's time, in seconds."""
        # Without gnuplot in the path pages have no pictures, which take most of a second.
        environment = dict(os.environ, PATH=folder)
        self.line = " ".join(["hamjet", *arguments])

        def restrict():
            resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + 5))

        done = subprocess.run([PROGRAM, *arguments], cwd=folder, env=environment,
                              stdin=subprocess.DEVNULL, capture_output=True, preexec_fn=restrict)
        if done.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
            raise TooSlow(f"{self.line}: no result within {limit} s")
        self.code = done.returncode
        self.printed = done.stdout.decode(errors="replace")
        self.said = done.stderr.decode(errors="replace")
        self.folder = folder

    def summary(self, directory):
        """summary.json; Refused where there is none."""
        path = os.path.join(self.folder, directory, "summary.json")
        if not os.path.exists(path):
            raise Refused(self.code, (self.said or self.printed).strip())
        with open(path) as file:
            return json.load(file, parse_constant=no_constant)

    def table(self, directory, name):
        with open(os.path.join(self.folder, directory, name)) as file:
            return list(csv.DictReader(file))


def number(text):
    """Of a cell; None where it is empty."""
    if text in (None, ""):
        return None
    value = float(text)
    if value != value:
        raise NoNumber(f"{text} in a table")
    return value
