"""Checks an Orbit Ephemeris Message in keyword = value notation against CCSDS 502.0-B-3, sections
5.2 and 7.3 to 7.8, and prints its states: for each the object, the seconds since the first epoch as
an exact fraction, and six numbers. Written from the standard; shares nothing with hamjet."""

import datetime
import fractions
import re
import sys

HEADER = ["CLASSIFICATION?", "CREATION_DATE", "ORIGINATOR", "MESSAGE_ID?"]
METADATA = ["OBJECT_NAME", "OBJECT_ID", "CENTER_NAME", "REF_FRAME", "REF_FRAME_EPOCH?",
            "TIME_SYSTEM", "START_TIME", "USEABLE_START_TIME?", "USEABLE_STOP_TIME?", "STOP_TIME",
            "INTERPOLATION?", "INTERPOLATION_DEGREE?"]
FIXED = re.compile(r"[+-]?\d+\.\d+")
FLOATING = re.compile(r"[+-]?\d\.\d{1,15}[eE][+-]?\d+")
EPOCH = re.compile(r"(\d{4})-(\d\d)-(\d\d)T(\d\d):(\d\d):(\d\d(?:\.\d+)?)Z?")


def require(holds, what):
    if not holds:
        sys.exit("check_oem: " + what)


def seconds(text):
    parts = EPOCH.fullmatch(text)
    require(parts and len(parts[6].replace(".", "")) <= 16, "no epoch: " + text)
    day = datetime.date(int(parts[1]), int(parts[2]), int(parts[3])).toordinal()
    minutes = (24 * day + int(parts[4])) * 60 + int(parts[5])
    require(int(parts[4]) < 24 and int(parts[5]) < 60 and float(parts[6]) < 60, "no time: " + text)
    return 60 * minutes + fractions.Fraction(parts[6])


def number(text):
    digits = re.sub(r"[eE].*|[^0-9]", "", text)
    require(FIXED.fullmatch(text) and len(digits) <= 16 or FLOATING.fullmatch(text),
            "no number: " + text)
    return text


class Message:
    def __init__(self, data):
        require(all(c == 10 or 32 <= c < 127 for c in data), "not printable ASCII")
        self.lines = data.decode("ascii").split("\n")
        require(all(len(line) <= 254 for line in self.lines), "a line of more than 254 characters")
        self.lines = [line.strip() for line in self.lines if line.strip()]

    def take(self):
        require(self.lines, "the end of the file")
        return self.lines.pop(0)

    def take_word(self, word):
        line = self.take()
        require(line == word, "%s where %s must be" % (line, word))

    def take_comments(self):
        while self.lines and self.lines[0].startswith("COMMENT "):
            self.take()

    def take_assignments(self, keywords):
        values = {}
        for keyword in keywords:
            name = keyword.rstrip("?")
            found = self.lines and re.fullmatch(name + r" *= *(\S.*)", self.lines[0])
            require(found or keyword.endswith("?"), name + " is missing at " + self.lines[0])
            if found:
                values[name] = found[1]
                self.take()
        return values

    def take_block(self, start):
        self.take_word("META_START")
        self.take_comments()
        metadata = self.take_assignments(METADATA)
        self.take_word("META_STOP")
        self.take_comments()
        times = []
        while self.lines and self.lines[0][0].isdigit():
            fields = self.take().split()
            require(len(fields) in (7, 10), "a state of %d numbers" % (len(fields) - 1))
            times.append(seconds(fields[0]))
            start = times[0] if start is None else start
            print(metadata["OBJECT_NAME"], times[-1] - start,
                  *[number(field) for field in fields[1:7]], sep=",")
        require(times and all(a < b for a, b in zip(times, times[1:])), "epochs out of order")
        require(seconds(metadata["START_TIME"]) <= times[0], "START_TIME after the first state")
        require(seconds(metadata["STOP_TIME"]) >= times[-1], "STOP_TIME before the last state")
        return start, metadata["OBJECT_NAME"]


def main():
    with open(sys.argv[1], "rb") as stream:
        message = Message(stream.read())
    require(message.take() in ("CCSDS_OEM_VERS = 2.0", "CCSDS_OEM_VERS = 3.0"), "no version")
    message.take_comments()
    seconds(message.take_assignments(HEADER)["CREATION_DATE"])
    print("object,seconds,x,y,z,x_dot,y_dot,z_dot")
    start, objects = None, set()
    while message.lines:
        start, name = message.take_block(start)
        objects.add(name)
    require(len(objects) == 1, "not the states of a single object (5.1.3)")


main()
