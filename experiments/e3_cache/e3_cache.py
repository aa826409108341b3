"""E3: What does a ray cost as the scene outgrows the caches?

Height fields of 2 N² triangles, always the same part of the picture, so that the same rays meet ever more and smaller
triangles. Held constant: camera, rays, one thread (so that a core's L2 is one cache). Varied: triangles. Coherent
rays: stages `intersect` (eye rays) and `occlude` (shadow rays) of whole frames, 640×360. Incoherent ones: `whittle
bench`, eye, shadow, cosine and uniform rays through the same tree. Cost is given per ray; the scene's memory is the
tree and the triangle records on the device.

Writes e3_cache.tsv (a row for each stage and run, or kind of ray); figure e3_cache. Two lines that meet, in cost
against log2 of the bytes, say where it bends and how steep it is on either side.
"""
import math

from lib import fit, style, table
from lib.context import size
from lib.measure import curve, interleaved

COLUMNS = ["source", "rays", "squares", "triangles", "bytes", "repetition", "count", "nanoseconds"]
STAGES = {"intersect": "eye, in a frame", "occlude": "shadow, in a frame"}
BENCH = {("eye", "nearest"), ("shadow", "any"), ("cosine", "nearest"), ("uniform", "nearest")}
SHOWN = [("frame", "eye, in a frame", "eye rays, frame"), ("frame", "shadow, in a frame", "shadow rays, frame"),
         ("bench", "cosine", "diffuse directions, bench"), ("bench", "uniform", "uniform, bench")]


def measureFrame(context, scene, squares, out):
    """Bytes of the scene."""
    variant = {"tree": lambda: context.render(scene, "--search", "tree", "--threads", 1, *size(640, 360))}
    for _, repetition, s in interleaved(variant, context.pick(2, 5)):
        used = s["memory"]["tree"] + s["memory"]["triangles"]
        for stage in s["stages"]:
            if stage["name"] in STAGES and stage["items"]:
                out.row(source="frame", rays=STAGES[stage["name"]], squares=squares, triangles=2 * squares**2,
                        bytes=used, repetition=repetition, count=stage["items"],
                        nanoseconds=1e9 * stage["seconds"] / stage["items"])
    return used


def measureBench(context, scene, squares, used, out):
    report = context.bench(scene, "--threads", 1, "--rays", context.pick(32768, 262144), "--runs", context.pick(1, 3))
    for r in report["rows"]:
        if (r["rays"], r["query"]) in BENCH:
            out.row(source="bench", rays=r["rays"], squares=squares, triangles=report["triangles"], bytes=used,
                    repetition=0, count=r["count"], nanoseconds=1e3 / r["mraysPerSecond"])


def measure(context):
    out = context.table("e3_cache", COLUMNS)
    todo = context.pick([4, 16, 64, 181, 512], [4, 8, 16, 32, 64, 91, 128, 181, 256, 362, 512, 724, 1024, 1448])
    progress = context.progress("e3", sum(20 + n**2 / 35000 for n in todo))
    for squares in todo:
        scene = context.heightField(squares)
        used = measureFrame(context, scene, squares, out)
        measureBench(context, scene, squares, used, out)
        scene.unlink()
        progress.step(f"{2 * squares**2} triangles, {style.bytesText(used)}", 20 + squares**2 / 35000)


def bent(x, y):
    """The bend of cost against log2 of the bytes, or None; the curve that was fitted, and what to say of it."""
    found = fit.bend([math.log2(v) for v in x], y)
    if found is None or found.gain < 6:
        line = fit.linear([math.log2(v) for v in x], y)
        reason = "too few points for a bend" if found is None else "no bend"
        return None, line.curve, f"{reason}:\n{fit.shown(*line[1], digits=1)} ns a doubling"
    return found, found.curve, (f"bends at {style.bytesText(2**found.at)} [{style.bytesText(2**found.low)}, "
                   f"{style.bytesText(2**found.high)}]:\n{fit.shown(*found.before, digits=1)}, then "
                   f"{fit.shown(*found.after, digits=1)} ns a doubling")


def markCaches(axis, machine):
    for name, cache in machine["cpu"]["caches"].items():
        axis.axvline(cache["one"], color=style.GREY, linewidth=1, linestyle=":")
        axis.annotate(f"{name} {style.bytesText(cache['one'])}", (cache["one"], 1.0), (0, 1), ha="center", fontsize=8.5,
                      xycoords=("data", "axes fraction"), textcoords="offset points", color=style.GREY)


def statement(bends):
    real = {words: b for words, b in bends.items() if b is not None and b.after[0] > b.before[0]}
    if not real:
        return "Cost of a ray against the scene's memory: no upward bend found"
    words, steepest = max(real.items(), key=lambda item: item[1].after[0])
    return (f"Steepest for {words.split(',')[0]}: {steepest.after[0]:.0f} ns a doubling beyond "
            f"{style.bytesText(2**steepest.at)}, {steepest.before[0]:.0f} before")


def plot(folder):
    rows, machine = table.read(folder, "e3_cache"), table.readMachine(folder, "e3_cache")
    figure, axis = style.figure(height=5.6)
    axis.set(xscale="log", xlabel="tree and triangles of the scene, bytes", ylabel="time of a ray, ns (1 thread)")
    labels, bends = style.EndLabels(axis), {}
    for i, (source, rays, words) in enumerate(SHOWN):
        x, y, low, high = curve(rows, "bytes", "nanoseconds", source=source, rays=rays)
        style.draw(axis, i, x, y, low, high, linestyle="")
        bends[words], fitted, text = bent(x, y)
        along = [x[0] * (x[-1] / x[0])**(k / 200) for k in range(201)]
        axis.plot(along, [fitted(math.log2(v)) for v in along], **{**style.look(i), "marker": ""})
        labels.add(x[-1], y[-1], f"{words}\n{text}", style.look(i)["color"])
    axis.set_ylim(bottom=0)
    markCaches(axis, machine)
    axis.set_title(statement(bends), pad=18)
    labels.place()
    style.save(figure, folder, "e3_cache")
