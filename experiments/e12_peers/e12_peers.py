"""E12: how fast is it beside Embree, POV-Ray and Blender's Cycles on the same scene and rays?

Whole frames: each scene with its first light alone (a sample of Cycles takes one light at random), one ray through
the centre of each pixel, eight bounces, all threads, 1280x720, runs in turn. The pictures are compared, which shows
that the work is the same: same triangles seen, same shadows, same mirror images. Queries: `whittle bench`, which
times Embree on the same rays.

writes: e12_frames.tsv (a row for each run), e12_pictures.tsv, e12_queries.tsv; figures e12_frames,
        e12_queries, e12_pictures_SCENE
needs: povray and blender (Debian's packages) for whole frames, python3-openimageio for the pictures; what is not
       there is left out
"""
import dataclasses
import pathlib

from lib import measure as repeat
from lib import style, table
from lib.context import SCENES
from peers import cycles, gltf, pictures, povray, runs

RENDERED = ["e12_pictures_*.png"]  # sheets of pictures; none of them is kept as data
MANY_SAMPLES = 64  # until the noise of Cycles's choice between reflection and refraction is small
QUERIES = ["scene", "triangles", "rays", "query", "count", "kernel", "mraysPerSecond", "embreeMode",
           "embreeMraysPerSecond", "ratio"]
FRAMES = ["scene", "triangles", "tool", "impulses", "repetition", "width", "height", "bounces", "threads", "render_s",
          "process_s", "rays"]
PICTURES = ["scene", "peer", "rmse", "flip", "median", "off", "rmse_others", "mean_ratio"]
SCENE_LABELS = {"frame": "the frame: hills, mirror balls", "cornell_box": "Cornell box, mirror and glass",
                "height_field_256": "height field, 256 squares"}
RAY_LABELS = {"eye": "eye", "shadow": "shadow", "mirror1": "mirror, first", "mirror2": "mirror, second",
              "refraction": "refraction", "cosine": "cosine", "uniform": "uniform"}


@dataclasses.dataclass
class Subject:
    """A scene in all formats; `branching`: has glass, of whose two branches Cycles follows one in each sample."""
    name: str
    glb: pathlib.Path
    branching: bool
    triangles: int
    file: object  # suffix -> path of an exported or rendered file


def scenes(context):
    """Name -> GLB."""
    found = {"frame": context.generated("frame", "--frame"), "cornell_box": SCENES / "cornell_box.glb",
             "height_field_256": context.heightField(256)}
    return found


def export(context, name, source, absent):
    glb = context.folder / f"e12_{name}.glb"
    gltf.keepFirstLight(source, glb)
    scene = gltf.load(glb)
    subject = Subject(name, glb, any(m.transmission > 0 for m in scene.materials), scene.triangleCount(),
                      lambda suffix: context.folder / f"e12_{name}{suffix}")
    if "povray" not in absent:
        povray.write(scene, subject.file(".pov"), 8)
    if "blender" not in absent:
        cycles.write(scene, subject.file(".py"))
    return subject


def variants(context, subject, job, absent):
    """(tool, impulses) -> a run that writes its picture and returns its times."""
    f = subject.file
    found = {("whittle", "all"): lambda: runs.whittle(context, subject.glb, f("_whittle.exr"), job)}
    if subject.branching:
        found["whittle", "one"] = lambda: runs.whittle(context, subject.glb, f("_one.exr"), job, "--impulses", "one")
    if "povray" not in absent:
        found["povray", "all"] = lambda: runs.povRay(f(".pov"), f("_povray.exr"), job)
    if "blender" not in absent:
        impulses = "one" if subject.branching else "all"
        found["cycles", impulses] = lambda: runs.cyclesOf(f(".py"), f("_cycles.exr"), job, 1)
    return found


def measureFrames(context, frames, subject, job, absent):
    repetitions = context.pick(1, 4)
    # Reading a text of a million triangles takes longer than anything else; what is timed is short all the same.
    for (tool, impulses), repetition, result in repeat.interleaved(variants(context, subject, job, absent), repetitions,
                                                                   longRun=float("inf")):
        frames.row(scene=subject.name, triangles=subject.triangles, tool=tool, impulses=impulses, repetition=repetition,
                   width=job["width"], height=job["height"], bounces=job["bounces"], threads=job["threads"], **result)


def comparePictures(context, rows, subject, job, absent):
    """Numbers, and the sheet; where Cycles chooses at random, its picture is the mean of many samples."""
    ours, peers = subject.file("_whittle.exr"), {}
    samples = context.pick(8, MANY_SAMPLES) if subject.branching else 1
    if "povray" not in absent:
        peers["POV-Ray"] = subject.file("_povray.exr")
    if "blender" not in absent:
        peers["Cycles" if samples == 1 else f"Cycles, {samples} samples"] = subject.file("_cycles.exr")
        if samples > 1:
            runs.cyclesOf(subject.file(".py"), subject.file("_cycles.exr"), job, samples)
    lines = [f"{SCENE_LABELS[subject.name]}", f"{subject.triangles} triangles, {job['width']}x{job['height']}"]
    for label, file in peers.items():
        found = pictures.compare(context.whittle, ours, file)
        rows.row(scene=subject.name, peer=label, **found)
        lines += ["", label, f"RMSE {found['rmse']:.1e} of the mean, FLIP {found['flip']:.1e}",
                  f"middle pixel off by {found['median']:.0e}", f"{100 * found['off']:.2f} % off by more than 1 %",
                  f"all others: RMSE {found['rmse_others']:.1e}"]
    pictures.sheet(context.out, f"e12_pictures_{subject.name}", "\n".join(lines), ours, peers)


def canLook(context):
    try:
        import OpenImageIO  # noqa: F401
    except ImportError:
        context.note("e12: pictures are not compared: install Debian's python3-openimageio")
        return False
    return True


def measureQueries(context, found, progress):
    rows = context.table("e12_queries", QUERIES)
    options = context.pick(["--rays", 65536, "--runs", 3], ["--runs", 5])
    for name, file in found.items():
        report = context.bench(file, "--threads", context.threads, *options)
        for row in report["rows"]:
            rows.row(scene=name, triangles=report["triangles"], **{c: row.get(c, "") for c in rows.columns[2:]})
        progress.step(f"queries, {name}")


def measure(context):
    absent = runs.missing()
    for name in absent:
        context.note(f"e12: {name} is not installed and is left out: apt-get install {name}")
    found = scenes(context)
    progress = context.progress("e12", len(found) * (1 if len(absent) == 2 else 4))
    measureQueries(context, found, progress)
    if len(absent) == 2:
        return
    job = {"width": context.pick(320, 1280), "height": context.pick(180, 720), "bounces": 8, "threads": context.threads}
    frames, compared = context.table("e12_frames", FRAMES), context.table("e12_pictures", PICTURES)
    look = canLook(context)
    for name, file in found.items():
        subject = export(context, name, file, absent)
        measureFrames(context, frames, subject, job, absent)
        if look:
            comparePictures(context, compared, subject, job, absent)
        progress.step(f"frames, {name}", 3)


def pairs(rows):
    """(scene, peer, our times, their times) in the order measured; ours with the impulses that the peer follows."""
    times = repeat.grouped(rows, ["scene", "tool", "impulses"], lambda r: (r["render_s"], r["process_s"]))
    return [(scene, tool, times[scene, "whittle", impulses], theirs)
            for (scene, tool, impulses), theirs in times.items() if tool != "whittle"]


def legendBelow(figure, entries, share, **options):
    """A legend under all panels, in the lowest `share` of the figure."""
    figure.get_layout_engine().set(rect=(0, share, 1, 1 - share))
    figure.legend(*entries, loc="lower center", frameon=False, **options)


def drawPairs(axis, found, which):
    """A line of the plot for each pair: both times, joined, and how many times as long the peer takes."""
    for i, (_, tool, ours, theirs) in enumerate(reversed(found)):
        a, b = (repeat.quartiles([t[which] for t in times]) for times in (ours, theirs))
        number = 1 + (tool == "cycles")
        axis.plot([a[1], b[1]], [i, i], color="#bbbbbb", linewidth=1, zorder=1)
        for times, look, filled in ((a, 0, True), (b, number, False)):
            style_ = style.look(look)
            axis.hlines(i, times[0], times[2], color=style_["color"], linewidth=4, alpha=0.3)
            axis.plot(times[1], i, marker=style_["marker"], color=style_["color"], markersize=7, linestyle="",
                      markerfacecolor=style_["color"] if filled else "white")
        axis.annotate(f"{b[1] / a[1]:.1f}×", (max(a[2], b[2]), i), xytext=(9, 0), textcoords="offset points",
                      va="center")
    axis.set_xscale("log")
    axis.margins(x=0.2, y=0.08)
    style.plainLog(axis.xaxis)


def plotFrames(folder):
    found = pairs(table.read(folder, "e12_frames"))
    if not found:
        return
    row = table.read(folder, "e12_frames")[0]
    figure, axes = style.figure(1, 2, height=1.6 + 0.42 * len(found), sharey=True, width_ratios=[1.15, 1])
    for axis, which, title in zip(axes, (0, 1), ("Rays alone, as each program times them", "The whole process")):
        drawPairs(axis, found, which)
        axis.set_title(title)
        axis.set_xlabel("seconds")
    names = {"povray": "POV-Ray", "cycles": "Cycles, 1 sample"}
    labels = [f"{SCENE_LABELS[s]}\nagainst {names[t]}" for s, t, _, _ in reversed(found)]
    axes[0].set_yticks(range(len(found)), labels, fontsize=8.5)
    for look, label in ((0, "Whittle"), (1, "POV-Ray"), (2, "Cycles")):
        axes[0].plot([], [], **{**style.look(look), "linestyle": ""}, label=label, markersize=7,
                     markerfacecolor=style.look(look)["color"] if look == 0 else "white")
    size = f"{row['width']}×{row['height']}, {row['bounces']} bounces, {row['threads']} threads"
    legendBelow(figure, axes[0].get_legend_handles_labels(), 0.15, ncols=3, title=size)
    style.save(figure, folder, "e12_frames")


def plotQueries(folder):
    rows = table.read(folder, "e12_queries")
    kinds = list(dict.fromkeys(r["rays"] for r in rows))
    names = list(dict.fromkeys(r["scene"] for r in rows))
    figure, axes = style.figure(1, 2, height=4.4, sharey=True, sharex=True)
    threads = style.threadsText(table.readMachine(folder, "e12_queries")["cpu"]["threads"])
    for axis, query in zip(axes, ("nearest", "any")):
        for i, name in enumerate(names):
            chosen = [r for r in rows if r["scene"] == name and r["query"] == query]
            look = {**style.look(i), "linestyle": ""}
            heights = [len(kinds) - 1 - kinds.index(r["rays"]) + 0.14 * ((len(names) - 1) / 2 - i) for r in chosen]
            axis.plot([r["ratio"] for r in chosen], heights, **look, label=SCENE_LABELS[name])
        axis.axvline(1, color=style.BLACK, linewidth=0.9)
        axis.set_xscale("log")
        axis.set_title({"nearest": "Nearest hit", "any": "Any hit"}[query])
        axis.set_xlabel(f"rays per second, × Embree's best mode ({threads})")
        ticks = [0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1, 1.2, 1.4, 1.6, 2, 2.5, 3]
        axis.xaxis.set_major_locator(style.matplotlib.ticker.FixedLocator(ticks))
        axis.xaxis.set_major_formatter("{x:g}")
        axis.xaxis.set_minor_locator(style.matplotlib.ticker.NullLocator())
    axes[0].set_yticks(range(len(kinds)), [RAY_LABELS.get(k, k) for k in reversed(kinds)])
    legendBelow(figure, axes[0].get_legend_handles_labels(), 0.12, ncols=2)
    style.save(figure, folder, "e12_queries")


def plot(folder):
    plotQueries(folder)
    if (folder / "e12_frames.tsv").exists():
        plotFrames(folder)
