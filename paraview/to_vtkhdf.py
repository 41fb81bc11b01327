"""All frames of a run in one VTKHDF file, for ParaView 5.13 or later: python3 paraview/to_vtkhdf.py runs/dump_kekerdom

The file, RUN/frames.vtkhdf if no other is named, has a block each for particles, membranes and rigid bodies, with the fields
of the VTU and VTP files and their times. Its layout is that of VTKHDF 2.3 (docs.vtk.org, "VTKHDF format specification"):
a multi-block set of poly data, each with the arrays of all frames one after the other and Steps that say where each begins.
Needs numpy and h5py (python3-h5py on Debian).
"""

import argparse
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import h5py
import numpy

from geodrop import array_of

VERSION = (2, 3)
BLOCKS = ("particles", "membranes", "rigid")
KINDS = ("Vertices", "Lines", "Polygons", "Strips")  # of cells, in the order in which ParaView counts them
TAGS = {"Cells": "Vertices", "Lines": "Lines", "Polys": "Polygons"}  # of our files; particles are cells of a point each


class Piece:
    """The arrays of one file: points, cells of each kind, fields of points and of cells."""

    def __init__(self, path):
        root = ElementTree.parse(path).getroot()
        self.points = array_of(root.find(".//Points/DataArray"), root)
        self.point_data = self.fields(root, "PointData")
        self.cell_data = self.fields(root, "CellData")
        self.cells = {kind: (numpy.zeros(0, "i8"), numpy.zeros(1, "i8")) for kind in KINDS}
        for tag, kind in TAGS.items():
            arrays = {each.get("Name"): each for each in root.iterfind(f".//{tag}/DataArray")}
            if arrays:
                ends = array_of(arrays["offsets"], root).astype("i8")
                connectivity = array_of(arrays["connectivity"], root).astype("i8")
                self.cells[kind] = connectivity, numpy.concatenate((numpy.zeros(1, "i8"), ends))

    @staticmethod
    def fields(root, tag):
        return {each.get("Name"): array_of(each, root) for each in root.iterfind(f".//{tag}/DataArray")}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", type=Path, help="run directory")
    parser.add_argument("file", type=Path, nargs="?", help="file to write (default: RUN/frames.vtkhdf)")
    options = parser.parse_args()
    if not (options.run / "particles.pvd").exists():
        parser.error(f"{options.run} has no particles.pvd: not a run directory, or one without frames")
    file = options.file or options.run / "frames.vtkhdf"
    convert(options.run, file)
    print(file)


def convert(run, file):
    """Writes the frames of a run directory."""
    part = file.with_name(file.name + ".part")
    with h5py.File(part, "w", track_order=True) as out:
        root = head(out.create_group("VTKHDF", track_order=True), "MultiBlockDataSet")
        assembly = root.create_group("Assembly", track_order=True)
        for name in BLOCKS:
            if (run / f"{name}.pvd").exists():
                write_block(head(root.create_group(name), "PolyData"), run, name)
                assembly[name] = h5py.SoftLink(f"/VTKHDF/{name}")
    part.replace(file)


def head(group, kind):
    group.attrs["Version"] = numpy.array(VERSION, "i8")
    group.attrs.create("Type", kind.encode("ascii"), dtype=h5py.string_dtype("ascii", len(kind)))
    return group


def write_block(block, run, name):
    times, paths = frames_of(run / f"{name}.pvd")
    steps = block.create_group("Steps")
    steps.attrs["NSteps"] = len(times)
    append(steps, "Values", numpy.array(times))
    for kind in KINDS:
        block.create_group(kind)
    for number, path in enumerate(paths):
        write_frame(block, steps, number, Piece(path))


def frames_of(collection):
    sets = list(ElementTree.parse(collection).iter("DataSet"))
    return [float(each.get("timestep")) for each in sets], [collection.parent / each.get("file") for each in sets]


def write_frame(block, steps, number, piece):
    append(steps, "PartOffsets", [number])
    append(steps, "NumberOfParts", [1])
    append(steps, "PointOffsets", [append(block, "Points", piece.points)])
    append(block, "NumberOfPoints", [len(piece.points)])
    begins = [write_cells(block[kind], *piece.cells[kind]) for kind in KINDS]
    append(steps, "CellOffsets", [[cells for cells, _ in begins]])
    append(steps, "ConnectivityIdOffsets", [[ids for _, ids in begins]])
    for group, fields in (("PointData", piece.point_data), ("CellData", piece.cell_data)):
        for name, values in fields.items():
            begin = append(block.require_group(group), name, values)
            append(steps.require_group(group + "Offsets"), name, [begin])


def write_cells(group, connectivity, offsets):
    """The number of cells and of point numbers that were there before."""
    append(group, "NumberOfCells", [len(offsets) - 1])
    append(group, "NumberOfConnectivityIds", [len(connectivity)])
    before = append(group, "Offsets", offsets) - (group["NumberOfCells"].shape[0] - 1)  # each frame has one more
    return before, append(group, "Connectivity", connectivity)


def append(group, name, values):
    """The rows of a data set that grows; how many there were before."""
    values = numpy.asarray(values)
    if name not in group:
        rows = max(1, len(values))
        group.create_dataset(name, data=values, maxshape=(None, *values.shape[1:]), chunks=(rows, *values.shape[1:]),
                             compression="gzip" if values.size > 1000 else None)
        return 0
    before = group[name].shape[0]
    group[name].resize(before + len(values), axis=0)
    group[name][before:] = values
    return before


if __name__ == "__main__":
    main()
