"""E7: Is the time linear in the pixels, in the rays for each pixel and in the depth?

Three sweeps, all threads, each scene on its own: the size of the picture (80×45 to 2560×1440, 1 ray for each pixel, 4
bounces), rays for each pixel (1 to 64 at 320×180, 4 bounces) and bounces (1 to 16 at 640×360; nested glass, whose rays
double at each interface, to 10 at 320×180). Held constant within a sweep: everything else. Settings of a sweep take
turns. Time is that of the frame; the rays are counted by the program.

Writes e7_linearity.tsv (a row for each run); figures e7_pixels, e7_samples and e7_depth: above, time, with
a power law and a line a + b x fitted to relative errors; below, time for each ray, level where time follows the rays.
"""
from lib import fit, style, table
from lib.context import SCENES, size
from lib.measure import curve, interleaved

COLUMNS = ["sweep", "scene", "x", "width", "height", "raysPerPixel", "bounces", "repetition", "render", "rays",
           "launches"]
SPONZA = "bench/crytek-sponza/crytek-sponza.glb"
SWEEPS = {"pixels": "pixels", "samples": "rays for each pixel", "depth": "bounces"}


def scenes(context):
    found = {name: SCENES / f"{name}.glb" for name in context.pick(["cornell_box", "height_field"],
                                                                   ["cornell_box", "mirror_box", "height_field"])}
    sponza = context.shared(SPONZA)
    if sponza is None:
        context.note("e7: Sponza is not there and is left out")
    elif not context.quick:
        found["sponza"] = sponza
    return found


def sweeps(context):
    """(sweep, scene, file, [(x, width, height, rays for each pixel, bounces), ...])."""
    widths = context.pick([80, 320, 1280], [80, 160, 320, 480, 640, 960, 1280, 1920, 2560])
    samples = context.pick([1, 4, 16], [1, 2, 4, 8, 16, 32, 64])
    depths = context.pick([1, 4, 8], [1, 2, 3, 4, 6, 8, 10, 12, 14, 16])
    for name, file in scenes(context).items():
        yield "pixels", name, file, [(w * w * 9 // 16, w, w * 9 // 16, 1, 4) for w in widths]
        yield "samples", name, file, [(n, 320, 180, n, 4) for n in samples]
    yield "depth", "mirror_box", SCENES / "mirror_box.glb", [(d, 640, 360, 1, d) for d in depths]
    yield "depth", "nested_glass", SCENES / "nested_glass.glb", [(d, 320, 180, 1, d) for d in depths if d <= 10]


def measureSweep(context, sweep, name, file, points, out):
    def one(_, width, height, samples, bounces):
        return lambda: context.render(file, *size(width, height), "--rays-per-pixel", samples, "--bounces", bounces)
    variants = {point: one(*point) for point in points}
    for (x, width, height, samples, bounces), repetition, s in interleaved(variants, context.pick(2, 3)):
        out.row(sweep=sweep, scene=name, x=x, width=width, height=height, raysPerPixel=samples, bounces=bounces,
                repetition=repetition, render=s["time"]["render"], rays=s["rays"]["total"],
                launches=sum(stage["launches"] for stage in s["stages"]))


def measure(context):
    out = context.table("e7_linearity", COLUMNS)
    todo = list(sweeps(context))
    progress = context.progress("e7", len(todo))
    for sweep, name, file, points in todo:
        measureSweep(context, sweep, name, file, points, out)
        progress.step(f"{SWEEPS[sweep]} of {name}")


def perRay(rows):
    return [dict(r, nanoseconds=1e9 * r["render"] / r["rays"]) for r in rows]


def words(name, x, y):
    """The scene with its power law, and the constant a of a + b x where that is known to better than a factor."""
    if len(x) < 4:  # with fewer the interval says nothing
        return name
    power, line = fit.power(x, y), fit.linear(x, y, relative=True)
    text = f"{name}\n∝ x^({fit.shown(*power[1])})"
    constant, half = line[0]
    return text + f"\n{1e3 * constant:.1f} ± {1e3 * half:.1f} ms at x = 0" if half < abs(constant) else text


def plotSweep(above, below, rows, sweep, looks):
    """Time above, time for each ray below; the title says how far the latter is from constant."""
    factors, labels = [], style.EndLabels(above)
    for name in dict.fromkeys(r["scene"] for r in rows):
        i = looks[name]
        x, y, low, high = curve(rows, "x", "render", scene=name)
        style.draw(above, i, x, y, low, high)
        text = style.sceneText(name)
        labels.add(x[-1], y[-1], text if sweep == "depth" else words(text, x, y), style.look(i)["color"])
        cost = curve(perRay(rows), "x", "nanoseconds", scene=name)
        style.draw(below, i, *cost)
        factors.append(max(cost[1]) / min(cost[1]))
    scale = "linear" if sweep == "depth" else "log"  # rays grow with depth by steps or powers, not by decades
    above.set(xscale=scale, yscale="log")
    below.set(xscale=scale)
    style.plainLog(above.yaxis)
    if sweep == "samples":
        style.plainLog(below.xaxis)
    below.set_ylim(bottom=0)
    above.set_title(f"the cost of a ray varies by {min(factors):.2g} to {max(factors):.2g} times")
    return labels


def plot(folder):
    rows = table.read(folder, "e7_linearity")
    threads = style.threadsText(table.readMachine(folder, "e7_linearity")["cpu"]["threads"])
    names = list(dict.fromkeys(r["scene"] for r in rows))
    looks = {name: i for i, name in enumerate(names)}
    for sweep in SWEEPS:
        figure, (above, below) = style.figure(rows=2, height=5.6, sharex=True, height_ratios=[1.5, 1])
        chosen = [r for r in rows if r["sweep"] == sweep]
        labels = plotSweep(above, below, chosen, sweep, looks)
        above.set_ylabel("time of a frame, s")
        symbol = "" if sweep == "depth" else " x"  # in the fits
        below.set(xlabel=f"{SWEEPS[sweep]}{symbol} ({threads})", ylabel="time for each ray, ns")
        above.set_title(f"Over the {SWEEPS[sweep]}, {above.get_title(loc='left')}")
        labels.place()
        style.save(figure, folder, f"e7_{sweep}")
