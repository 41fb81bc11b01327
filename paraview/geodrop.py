"""Runs of geodrop as numpy arrays: geodrop.read("runs/dump_kekerdom").

    import sys; sys.path.insert(0, "paraview")
    import geodrop
    run = geodrop.read("runs/dump_kekerdom")
    run.results["fall_velocity_max_m_s"]            # 3.79
    run.history["container.velocity_y_m_s"]         # array over run.history["time_s"]
    frame = run.frame(2.5)                          # the nearest in time
    frame.particles["velocity"]                     # (particles, 3) [m/s]
    frame.membranes["tension"]                      # (segments,) [N/m]
    frame.membranes["connectivity"].reshape(-1, 2)  # nodes of the segments, rows of frame.membranes["points"]; in space (-1, 3)
    frame.particles["points"]                       # (particles, 3) [m]

Needs numpy and nothing else.
"""

import base64
import json
import xml.etree.ElementTree as ElementTree
import zlib
from dataclasses import dataclass
from pathlib import Path

import numpy

TYPES = {
    "Float32": "<f4", "Float64": "<f8", "Int8": "<i1", "UInt8": "<u1", "Int16": "<i2", "UInt16": "<u2",
    "Int32": "<i4", "UInt32": "<u4", "Int64": "<i8", "UInt64": "<u8",
}


@dataclass
class Frame:
    """One frame: arrays by name, each of particles, of segments of membranes, of lines of rigid bodies."""

    time: float  # [s]
    particles: dict
    membranes: dict
    rigid: dict


class Run:
    """A run directory. history: columns by name; results, facts: numbers by name; times: of the frames [s]."""

    def __init__(self, directory):
        self.directory = Path(directory)
        self.summary = json.loads((self.directory / "summary.json").read_text())
        self.results = {name: each["value"] for name, each in self.summary["results"].items()}
        self.facts = {name: each["value"] for name, each in self.summary["facts"].items()}
        with open(self.directory / "history.csv") as file:
            names = file.readline().strip().split(",")
            rows = numpy.loadtxt(file, delimiter=",", ndmin=2)
        self.history = {name: rows[:, column] for column, name in enumerate(names)}
        collection = self.directory / "particles.pvd"
        sets = ElementTree.parse(collection).iter("DataSet") if collection.exists() else ()
        self.times = numpy.array([float(each.get("timestep")) for each in sets])

    def frame(self, time):
        """The frame that is nearest to this time [s]."""
        return self.frame_number(int(numpy.argmin(numpy.abs(self.times - time))))

    def frame_number(self, index):
        def arrays(kind, ending):
            path = self.directory / f"{kind}_{index:06d}.{ending}"
            return read_vtk(path) if path.exists() else {}

        return Frame(float(self.times[index]), arrays("particles", "vtu"), arrays("membranes", "vtp"),
                     arrays("rigid", "vtp"))


def read(directory):
    """A run directory of geodrop."""
    return Run(directory)


def read_vtk(path):
    """All arrays of a VTU or VTP file by name; positions are called "points"."""
    root = ElementTree.parse(path).getroot()
    arrays = {}
    for element in root.iter("DataArray"):
        if element.get("format") == "binary":
            name = "points" if element.get("Name") == "Points" else element.get("Name")
            values = array_of(element, root)
            if name not in arrays or values.size > 0:  # a VTP file has connectivities of four kinds of cells, all but one empty
                arrays[name] = values
    return arrays


def array_of(element, root):
    """The values of a DataArray of a VTU or VTP file, a row each where it has several components."""
    head = "<u8" if root.get("header_type") == "UInt64" else "<u4"
    raw = decode(element.text.strip(), head, root.get("compressor"))
    values = numpy.frombuffer(raw, TYPES[element.get("type")])
    width = int(element.get("NumberOfComponents") or 1)
    return values.reshape(-1, width) if width > 1 else values


def letters(size):
    """Of so many bytes in base64."""
    return 4 * ((size + 2) // 3)


def decode(text, head, compressor):
    """The bytes of an array: before it the number of its bytes or, compressed, the sizes of its blocks."""
    size = int(head[-1])
    if compressor is None:
        raw = base64.b64decode(text)
        return raw[size:size + int(numpy.frombuffer(raw[:size], head)[0])]
    decompress = {"vtkLZ4DataCompressor": decompress_lz4, "vtkZLibDataCompressor": zlib.decompress}
    blocks = int(numpy.frombuffer(base64.b64decode(text[:letters(size)])[:size], head)[0])
    table = numpy.frombuffer(base64.b64decode(text[:letters((3 + blocks) * size)]), head)
    raw, at, out = base64.b64decode(text[letters((3 + blocks) * size):]), 0, b""
    for length in table[3:3 + blocks]:
        out += decompress[compressor](raw[at:at + int(length)])
        at += int(length)
    return out


def decompress_lz4(block):
    """The bytes of an LZ4 block: sequences of new bytes, each followed by bytes that stood `back` before."""
    out, at = bytearray(), 0

    def length(size):
        nonlocal at
        if size == 15:  # goes on in the next bytes, as long as these are full
            while block[at] == 255:
                size += 255
                at += 1
            size += block[at]
            at += 1
        return size

    while True:
        token = block[at]
        at += 1
        new = length(token >> 4)
        out += block[at:at + new]
        at += new
        if at == len(block):  # the last sequence has no copy
            return bytes(out)
        back = block[at] | block[at + 1] << 8
        at += 2
        count, begin = 4 + length(token & 15), len(out) - back
        while count > 0:  # a copy that overlaps itself repeats
            piece = out[begin:begin + count]
            out += piece
            count -= len(piece)
