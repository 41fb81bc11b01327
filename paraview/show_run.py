"""Show a geodrop run in ParaView: soil, water, membrane, rigid bodies such as a barge, axes in metres, camera on the bag.

    pvpython show_run.py RUN_DIR [--time T] [--show PRESET]                       opens a window
    pvbatch show_run.py RUN_DIR [--time T] [--show PRESET] --screenshot FILE      writes a PNG
    pvbatch show_run.py RUN_DIR [--show PRESET] --animation FILE                  writes a movie, or a PNG for each frame

Presets: layers (of the soil; membrane by tension), stresses (upright stress of the soil, tension positive), pressure
(mean pressure of all bodies), tension (of the membrane, bodies plain), utilisation (tension over strength, likewise). Colours mean the same at all times: from the least to the largest value of the
run, or --range MIN MAX.

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


MOVIES = (".avi", ".ogv")


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", help="directory of a run, with particles.pvd")
    parser.add_argument("--time", type=float, help="simulated time [s]; the nearest frame is shown; default: the last")
    parser.add_argument("--show", choices=list(presets(2)), default="layers", help="what the colours mean")
    written = parser.add_mutually_exclusive_group()
    written.add_argument("--screenshot", help="PNG file to write instead of opening a window")
    written.add_argument("--animation", help="file to write with all frames: .avi or .ogv, or .png for OUT.0000.png, OUT.0001.png, ...")
    parser.add_argument("--range", type=float, nargs=2, metavar=("MIN", "MAX"), help="values of the first and the last colour")
    parser.add_argument("--rate", type=float, default=10, help="frames a second of a movie; default: 10")
    parser.add_argument("--size", type=int, nargs=2, default=[1000, 1200], metavar=("WIDTH", "HEIGHT"))
    arguments = parser.parse_args()
    if arguments.range and not arguments.range[0] < arguments.range[1]:
        parser.error("argument --range: found {:g} {:g}; allowed: MIN below MAX".format(*arguments.range))
    if arguments.animation and not arguments.animation.endswith((".png",) + MOVIES):
        parser.error("argument --animation: found {}; allowed: a file .png, .avi or .ogv".format(arguments.animation))
    if arguments.animation and arguments.time is not None:
        parser.error("argument --time: not allowed with argument --animation, which shows all times")
    return arguments


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


def times_of(reader):
    return list(reader.TimestepValues) if hasattr(reader.TimestepValues, "__iter__") else [reader.TimestepValues]


def nearest_time(times, wanted):
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


# What is coloured by a field: its source, POINTS or CELLS, the field, and whether the scale begins at 0.
Coloured = collections.namedtuple("Coloured", "source association field from_zero")
COLOURED = []


def colour_by(display, coloured, view, location):
    """Colours by a field, with a colour bar; the scale is set once all that has it is there, by set_scale."""
    COLOURED.append(coloured)
    field = coloured.field
    pv.ColorBy(display, (coloured.association, field.name) if field.component is None else (coloured.association, field.name, field.component))
    table = pv.GetColorTransferFunction(field.name)
    table.ApplyPreset("Viridis (matplotlib)", True)
    legend = pv.GetScalarBar(table, view)
    legend.Title = field.title
    legend.ComponentTitle = ""
    legend.TitleColor = legend.LabelColor = [0, 0, 0]
    legend.AddRangeLabels = 0
    legend.WindowLocation = location
    legend.Visibility = 1


def range_now(coloured):
    """Least and largest value in the frame that its source has read; nothing if there is none."""
    array = (coloured.source.PointData if coloured.association == "POINTS" else coloured.source.CellData)[coloured.field.name]
    if array is None:
        return []
    names = [array.GetComponentName(c) for c in range(array.GetNumberOfComponents())]
    low, high = array.GetRange(names.index(coloured.field.component) if coloured.field.component else 0)
    return [low, high] if low <= high else []


def bounds_now(source):
    return source.GetDataInformation().GetBounds()


def survey(times, body):
    """Values of what is coloured and bounds of a source over these times; the sources have read the last one then."""
    values, bounds = [], None
    for time in times:
        body.UpdatePipeline(time)
        now = bounds_now(body)
        bounds = now if bounds is None else [(min, max)[i % 2](pair) for i, pair in enumerate(zip(bounds, now))]
        for coloured in COLOURED:
            coloured.source.UpdatePipeline(time)
            values += range_now(coloured)
    return values, bounds


def set_scale(values, asked):
    """One scale for all times."""
    if not COLOURED:
        return
    low, high = min(values, default=0), max(values, default=1)
    if COLOURED[0].from_zero:
        low, high = 0, high if high > 0 else 1
    table = pv.GetColorTransferFunction(COLOURED[0].field.name)
    table.RescaleTransferFunction(*(asked or (low, high)))
    table.AutomaticRescaleRangeMode = "Never"


def colour_body(display, source, scene, index, preset, show, view):
    body = scene["bodies"][index]
    water = is_fluid(scene, body)
    if preset.bodies and (preset.with_water or not water):
        colour_by(display, Coloured(source, "POINTS", preset.bodies, False), view, "Upper Right Corner")
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
        colour_by(display, Coloured(membranes, "CELLS", field, True), view, "Upper Right Corner")
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
        grid.AxesToLabel = 3  # below and on the left; the colour bar is on the right
    grid.Visibility = 1
    grid.XTitle, grid.YTitle, grid.ZTitle = "x [m]", "y [m]", "z [m]" if dimension == 3 else ""
    for colour in ("XTitleColor", "YTitleColor", "ZTitleColor", "XLabelColor", "YLabelColor", "ZLabelColor", "GridColor"):
        setattr(grid, colour, [0.2, 0.2, 0.2])


def aim_camera(view, bounds, dimension):
    """In 2D across the plane, in 3D from the front wall along y; the vertical axis up."""
    centre = [(bounds[2 * axis] + bounds[2 * axis + 1]) / 2 for axis in range(3)]
    up, across = (1, 2) if dimension == 2 else (2, 1)
    width, height = view.ViewSize
    view.CameraParallelProjection = 1
    view.CameraFocalPoint = centre
    view.CameraPosition = [x + (100 if dimension == 2 else -100) * (axis == across) for axis, x in enumerate(centre)]
    view.CameraViewUp = [float(axis == up) for axis in range(3)]
    tall, wide = bounds[2 * up + 1] - bounds[2 * up], bounds[1] - bounds[0]
    view.CameraParallelScale = 0.5 * max(tall, wide * height / width) / BODY_SHARE


def show_label(view, particles, name):
    label = pv.AnnotateTimeFilter(registrationName="time", Input=particles, Format="t = {time:.2f} s, " + name)
    display = pv.Show(label, view)
    display.Color = [0, 0, 0]
    display.FontSize = 24
    display.WindowLocation = "Upper Left Corner"


def write_animation(arguments, view, times):
    if arguments.animation.endswith(MOVIES):
        pv.SaveAnimation(arguments.animation, view, ImageResolution=arguments.size, FrameRate=arguments.rate)
    else:
        pv.SaveAnimation(arguments.animation, view, ImageResolution=arguments.size, SuffixFormat=".%04d")
    print("show_run.py: {} frames, t = {:g} to {:g} s -> {}".format(len(times), times[0], times[-1], arguments.animation))


def make_view(size, dimension):
    pv._DisableFirstRenderCameraReset()
    view = pv.CreateRenderView()
    view.ViewSize = size
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    view.OrientationAxesVisibility = 0
    view.InteractionMode = "2D" if dimension == 2 else "3D"
    return view


def main():
    arguments = parse_arguments()
    collection = os.path.join(arguments.run, "particles.pvd")
    if not os.path.exists(collection):
        sys.exit("show_run.py: no particles.pvd in " + arguments.run + ", so it is not the directory of a run")
    scene = read_scene(os.path.join(arguments.run, "scene.toml"))
    dimension = int(scene[""][0].get("dimension", 2))
    view = make_view(arguments.size, dimension)

    particles = pv.PVDReader(registrationName="particles", FileName=collection)
    times = times_of(particles)
    time = nearest_time(times, arguments.time)
    particles.UpdatePipeline(time)
    pv.GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
    pv.GetAnimationScene().AnimationTime = time  # the view follows
    preset = presets(dimension)[arguments.show]
    body = show_bodies(particles, scene, view, preset, arguments.show)
    membranes = os.path.join(arguments.run, "membranes.pvd")
    if os.path.exists(membranes):
        show_membranes(membranes, view, time, preset.membrane)
    rigid = os.path.join(arguments.run, "rigid.pvd")
    if os.path.exists(rigid):
        show_rigid(rigid, view, time)
    show_label(view, particles, arguments.show)
    values, bounds = survey([] if arguments.range and not arguments.animation else times, body)
    set_scale(values, arguments.range)
    body.UpdatePipeline(time)
    aim_camera(view, bounds if arguments.animation else bounds_now(body), dimension)
    show_axes(view, dimension)

    if arguments.animation:
        write_animation(arguments, view, times)
    elif arguments.screenshot:
        pv.SaveScreenshot(arguments.screenshot, view, ImageResolution=arguments.size)
        print("show_run.py: t = {:g} s -> {}".format(time, arguments.screenshot))
    else:
        pv.Render(view)
        pv.Interact(view)


main()
