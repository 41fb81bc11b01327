"""Show a geodrop run in ParaView: soil, water, membrane, rigid bodies such as a barge, axes in metres, camera on the bag.

    pvpython show_run.py RUN_DIR [--time T] [--show PRESET]                       opens a window
    pvbatch show_run.py RUN_DIR [--time T] [--show PRESET] --screenshot FILE      writes a PNG

Presets: layers (of the soil; membrane by tension), stresses (upright stress of the soil, tension positive), pressure
(mean pressure of all bodies), tension (of the membrane, bodies plain), utilisation (tension over strength, likewise).

Works with ParaView 5.11 (Debian 12) and later. Without a display: xvfb-run -a pvbatch ...
"""

import argparse
import collections
import os
import re
import sys

from paraview import simple as pv

WATER_COLOUR = [0.45, 0.65, 0.85]
WATER_OPACITY = 0.25
SOLID_COLOURS = [[0.62, 0.55, 0.45], [0.50, 0.50, 0.50]]
# Light and dark in turn, so that neighbouring layers differ also in a print without colour.
LAYER_COLOURS = [[0.85, 0.62, 0.25], [0.45, 0.26, 0.12]]
PLAIN_COLOUR = [0.55, 0.50, 0.45]
RIGID_COLOUR = [0.15, 0.15, 0.15]

# What bodies and the membrane are coloured by; a field is its name, its component or None, and its title.
Field = collections.namedtuple("Field", "name component title")
Preset = collections.namedtuple("Preset", "bodies membrane with_water")
TENSION = Field("tension", None, "tension [N/m]")


def presets(dimension):
    upright = "YY" if dimension == 2 else "ZZ"
    return {
        "layers": Preset(None, TENSION, False),
        "stresses": Preset(Field("stress", upright, "stress " + upright + " [Pa]"), None, False),
        "pressure": Preset(Field("mean_pressure", None, "mean pressure [Pa]"), None, True),
        "tension": Preset(None, TENSION, False),
        "utilisation": Preset(None, Field("utilisation", None, "tension / strength [-]"), False),
    }


# Part of the picture's height that the body takes.
BODY_SHARE = 0.75


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", help="directory of a run, with particles.pvd")
    parser.add_argument("--time", type=float, help="simulated time [s]; the nearest frame is shown; default: the last")
    parser.add_argument("--show", choices=list(presets(2)), default="layers", help="what the colours mean")
    parser.add_argument("--screenshot", help="PNG file to write instead of opening a window")
    parser.add_argument("--size", type=int, nargs=2, default=[1000, 1200], metavar=("WIDTH", "HEIGHT"))
    return parser.parse_args()


def read_scene(path):
    """Tables of scene.toml with their one-line texts and numbers: {header: [table, ...]}.

    Only the plain `key = value` lines that geodrop writes; ParaView's own Python may be too old to bring tomllib.
    """
    tables = {}
    table = tables.setdefault("", [{}])[0]
    with open(path, encoding="utf-8") as file:
        for line in file:
            header = re.match(r"\[+([\w.-]+)\]+\s*$", line)
            if header:
                table = {}
                tables.setdefault(header.group(1), []).append(table)
                continue
            pair = re.match(r'([\w-]+) = (?:"([^"]*)"|([-+.\deE]+))\s*$', line)
            if pair:
                table[pair.group(1)] = pair.group(2) if pair.group(2) is not None else float(pair.group(3))
    return tables


def is_fluid(scene, body):
    return scene["materials." + body["material"]][0]["model"] == "newtonian"


def camera_body(scene):
    """Index of the body that the picture is about: the first one in a membrane, else the first solid, else any."""
    bodies = scene["bodies"]
    names = [body["name"] for body in bodies]
    if "membranes" in scene:
        return names.index(scene["membranes"][0]["body"])
    solids = [index for index, body in enumerate(bodies) if not is_fluid(scene, body)]
    return solids[0] if solids else 0


def nearest_time(reader, wanted):
    times = list(reader.TimestepValues) if hasattr(reader.TimestepValues, "__iter__") else [reader.TimestepValues]
    return times[-1] if wanted is None else min(times, key=lambda t: abs(t - wanted))


def show_particles(source, view, radius):
    """Discs of `radius` [m], so that a picture at any zoom shows the same body."""
    display = pv.Show(source, view)
    display.SetRepresentationType("Point Gaussian")
    display.ShaderPreset = "Plain circle"
    display.GaussianRadius = radius
    return display


def put_behind(display, particles):
    """In 2D all particles lie in one plane, where a faint disc would veil the bag's."""
    z0, z1 = particles.GetDataInformation().GetBounds()[4:]
    if z0 == z1:
        display.Position = [0, 0, -1]


def colour_plainly(display, colour, opacity):
    display.ColorArrayName = ["POINTS", ""]  # ColorBy(display, None) fails in 5.11
    display.DiffuseColor = display.AmbientColor = colour
    display.Opacity = opacity


def colour_by_layer(display, layers):
    pv.ColorBy(display, ("POINTS", "layer"))
    table = pv.GetColorTransferFunction("layer")
    table.InterpretValuesAsCategories = 1
    table.AnnotationsInitialized = 1
    table.Annotations = [text for layer in range(layers) for text in (str(layer), str(layer))]
    table.IndexedColors = [part for layer in range(layers) for part in LAYER_COLOURS[layer % 2]]


RANGES = {}  # of the fields that are shown, over all sources


def colour_by(display, source, association, field, view, location, from_zero):
    """Colours by a field from the least to the largest value of all that is coloured by it (or from 0), with a colour bar."""
    pv.ColorBy(display, (association, field.name) if field.component is None else (association, field.name, field.component))
    array = (source.PointData if association == "POINTS" else source.CellData)[field.name]
    names = [array.GetComponentName(c) for c in range(array.GetNumberOfComponents())]
    low, high = array.GetRange(names.index(field.component) if field.component else 0)
    if low <= high:  # else there is nothing of it
        before = RANGES.get(field.name, (low, high))
        RANGES[field.name] = min(low, before[0]), max(high, before[1])
    low, high = RANGES.get(field.name, (0, 1))
    table = pv.GetColorTransferFunction(field.name)
    table.ApplyPreset("Viridis (matplotlib)", True)
    table.RescaleTransferFunction(0 if from_zero else low, high if high > low or not from_zero else 1.0)
    legend = pv.GetScalarBar(table, view)
    legend.Title = field.title
    legend.ComponentTitle = ""
    legend.TitleColor = legend.LabelColor = [0, 0, 0]
    legend.WindowLocation = location
    legend.Visibility = 1


def colour_body(display, source, scene, index, preset, show, view):
    body = scene["bodies"][index]
    water = is_fluid(scene, body)
    if preset.bodies and (preset.with_water or not water):
        colour_by(display, source, "POINTS", preset.bodies, view, "Upper Right Corner", False)
    elif water:
        colour_plainly(display, WATER_COLOUR, WATER_OPACITY)
    elif show != "layers":
        colour_plainly(display, PLAIN_COLOUR, 0.4)
    elif body.get("layers", 1) > 1:
        colour_by_layer(display, int(body["layers"]))
    else:
        colour_plainly(display, SOLID_COLOURS[index % len(SOLID_COLOURS)], 1.0)


def show_bodies(particles, scene, view, preset, show):
    """Shows every body; returns the source of the one that the camera looks at."""
    spacing = scene["grid"][0]["spacing"]
    centre_of_interest = None
    for index, body in enumerate(scene["bodies"]):
        source = pv.Threshold(registrationName=body["name"], Input=particles)
        source.Scalars = ["POINTS", "body"]
        source.LowerThreshold = index
        source.UpperThreshold = index
        source.UpdatePipeline(view.ViewTime)
        # Discs that just overlap: the diagonal half of the spacing of particles.
        radius = 0.75 * spacing / body.get("particles_per_cell_axis", 2)
        display = show_particles(source, view, radius)
        if is_fluid(scene, body):
            put_behind(display, particles)
        colour_body(display, source, scene, index, preset, show, view)
        if index == camera_body(scene):
            centre_of_interest = source
    return centre_of_interest


def show_membranes(path, view, time, field):
    """By the field; without one as a dark line."""
    membranes = pv.PVDReader(registrationName="membranes", FileName=path)
    membranes.UpdatePipeline(time)
    display = pv.Show(membranes, view)
    display.SetRepresentationType("Surface")
    display.LineWidth = 5
    if field:
        colour_by(display, membranes, "CELLS", field, view, "Upper Right Corner", True)
    else:
        colour_plainly(display, RIGID_COLOUR, 1.0)
        display.LineWidth = 2


def show_rigid(path, view, time):
    rigid = pv.PVDReader(registrationName="rigid", FileName=path)
    rigid.UpdatePipeline(time)
    display = pv.Show(rigid, view)
    display.SetRepresentationType("Surface")
    display.LineWidth = 3
    colour_plainly(display, RIGID_COLOUR, 1.0)


def show_axes(view, dimension):
    """Axes with numbers in metres; in 2D around most of the picture, whatever lies beyond."""
    grid = view.AxesGrid
    if dimension == 2:
        tall = 0.88 * view.CameraParallelScale
        wide = 0.8 * view.CameraParallelScale * view.ViewSize[0] / view.ViewSize[1]
        x, y, z = view.CameraFocalPoint
        grid.UseCustomBounds = 1
        grid.CustomBounds = [x - wide, x + wide, y - tall, y + tall, z, z]
    grid.Visibility = 1
    grid.XTitle, grid.YTitle, grid.ZTitle = "x [m]", "y [m]", "z [m]" if dimension == 3 else ""
    for colour in ("XTitleColor", "YTitleColor", "ZTitleColor", "XLabelColor", "YLabelColor", "ZLabelColor", "GridColor"):
        setattr(grid, colour, [0.2, 0.2, 0.2])


def aim_camera(view, source, time, dimension):
    """In 2D across the plane, in 3D from the front wall along y; the vertical axis up."""
    source.UpdatePipeline(time)
    bounds = source.GetDataInformation().GetBounds()
    centre = [(bounds[2 * axis] + bounds[2 * axis + 1]) / 2 for axis in range(3)]
    up, across = (1, 2) if dimension == 2 else (2, 1)
    width, height = view.ViewSize
    view.CameraParallelProjection = 1
    view.CameraFocalPoint = centre
    view.CameraPosition = [x + (100 if dimension == 2 else -100) * (axis == across) for axis, x in enumerate(centre)]
    view.CameraViewUp = [float(axis == up) for axis in range(3)]
    tall, wide = bounds[2 * up + 1] - bounds[2 * up], bounds[1] - bounds[0]
    view.CameraParallelScale = 0.5 * max(tall, wide * height / width) / BODY_SHARE


def main():
    arguments = parse_arguments()
    collection = os.path.join(arguments.run, "particles.pvd")
    if not os.path.exists(collection):
        sys.exit("show_run.py: no particles.pvd in " + arguments.run + ", so it is not the directory of a run")
    scene = read_scene(os.path.join(arguments.run, "scene.toml"))
    pv._DisableFirstRenderCameraReset()
    view = pv.CreateRenderView()
    view.ViewSize = arguments.size
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    view.OrientationAxesVisibility = 0
    dimension = int(scene[""][0].get("dimension", 2))
    view.InteractionMode = "2D" if dimension == 2 else "3D"

    particles = pv.PVDReader(registrationName="particles", FileName=collection)
    time = nearest_time(particles, arguments.time)
    particles.UpdatePipeline(time)
    pv.GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
    view.ViewTime = time
    preset = presets(dimension)[arguments.show]
    body = show_bodies(particles, scene, view, preset, arguments.show)
    membranes = os.path.join(arguments.run, "membranes.pvd")
    if os.path.exists(membranes):
        show_membranes(membranes, view, time, preset.membrane)
    rigid = os.path.join(arguments.run, "rigid.pvd")
    if os.path.exists(rigid):
        show_rigid(rigid, view, time)
    label = pv.Show(pv.Text(registrationName="time", Text="t = {:.2f} s, {}".format(time, arguments.show)), view)
    label.Color = [0, 0, 0]
    label.FontSize = 24
    label.WindowLocation = "Upper Left Corner"
    aim_camera(view, body, time, dimension)
    show_axes(view, dimension)

    if arguments.screenshot:
        pv.SaveScreenshot(arguments.screenshot, view, ImageResolution=arguments.size)
        print("show_run.py: t = {:g} s -> {}".format(time, arguments.screenshot))
    else:
        pv.Render(view)
        pv.Interact(view)


main()
