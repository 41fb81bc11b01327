#!/usr/bin/python3
"""Particles, geotextiles and rigid walls of some frames of a run, side by side in one picture, coloured by speed. For those who
need no window: needs python3-matplotlib and VTK's modules for Python, which come with python3-paraview or with
python3-vtk9 (Debian lets only one of both be installed).

    paraview/draw_frames.py RUN_DIR OUTPUT.png --times 2 6.5 11 14 16 --window -7 7 -2 15 [--fastest 4]
"""
import argparse
import xml.etree.ElementTree as tree
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLUnstructuredGridReader


def read(reader, path):
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def file_at(directory, kind, time):
    """The frame of a kind nearest to a time, from its collection; None if the run has no such frames."""
    collection = directory / f"{kind}.pvd"
    if not collection.exists():
        return None
    frames = tree.parse(collection).getroot().iter("DataSet")
    return directory / min(frames, key=lambda frame: abs(float(frame.get("timestep")) - time)).get("file")


def draw(panel, directory, time, window, fastest):
    particles = read(vtkXMLUnstructuredGridReader(), file_at(directory, "particles", time))
    place = vtk_to_numpy(particles.GetPoints().GetData())
    velocity = vtk_to_numpy(particles.GetPointData().GetArray("velocity"))
    speed = (velocity**2).sum(axis=1) ** 0.5
    picture = panel.scatter(place[:, 0], place[:, 1], c=speed, s=1.6, vmin=0, vmax=fastest, cmap="viridis", linewidths=0)
    for kind, colour in (("membranes", "red"), ("rigid", "black")):
        path = file_at(directory, kind, time)
        if path is None:
            continue
        lines = read(vtkXMLPolyDataReader(), path)
        for number in range(lines.GetNumberOfCells()):
            points = vtk_to_numpy(lines.GetCell(number).GetPoints().GetData())
            panel.plot(points[:, 0], points[:, 1], color=colour, linewidth=0.8)
    panel.set(xlim=window[:2], ylim=window[2:], aspect="equal", title=f"t = {time:g} s", xlabel="x [m]")
    return picture


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory", type=Path)
    parser.add_argument("output", type=Path)
    parser.add_argument("--times", type=float, nargs="+", required=True, help="[s]")
    parser.add_argument("--window", type=float, nargs=4, required=True, help="left right bottom top [m]")
    parser.add_argument("--fastest", type=float, default=4.0, help="speed of the brightest colour [m/s]")
    arguments = parser.parse_args()
    figure, panels = plt.subplots(1, len(arguments.times), figsize=(3.2 * len(arguments.times), 4.2), squeeze=False,
                                  sharey=True, layout="constrained")
    for panel, time in zip(panels[0], arguments.times):
        picture = draw(panel, arguments.directory, time, arguments.window, arguments.fastest)
    panels[0][0].set_ylabel("y [m]")
    figure.colorbar(picture, ax=panels[0][-1], label="speed [m/s]", shrink=0.7)
    figure.savefig(arguments.output, dpi=72)


if __name__ == "__main__":
    main()
