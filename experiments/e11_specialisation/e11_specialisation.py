"""E11: What does leaving out what a scene does not need save?

Each scene as it is and with --keep-all-features, in turn: the frame's time, the time to compile with nothing on disk,
bytes of buffers, and the pixels in which the two pictures differ (there must be none). Then the plainest scene with
features that it does without: each alone, beside the scene as it is; and one after the other, until all are in. A
feature brings those that it cannot be without. Last, options of the picture beside the picture without them, in a scene
that has a use for them and in one that has none. Held constant: picture, search, all threads.

Writes e11_frames.tsv, e11_features.tsv and e11_options.tsv (a row for each run), e11_compile.tsv, e11_pictures.tsv;
figures e11_scenes, e11_features, e11_options.
"""
import functools
import json
import subprocess

from e11_specialisation import figures, switches
from lib import table
from lib.context import SCENES, RunFailed, size
from lib.measure import interleaved

SHARED_SCENES = ["gltf/SpecularTest/glTF-Binary/SpecularTest.glb", "bench/cornell-mcguire/CornellBox-Original.glb",
                 "bench/teapot-full/teapot-full.glb", "bench/crytek-sponza/crytek-sponza.glb"]
PLAINEST = SCENES / "height_field.glb"
VARIANTS = {"special": [], "everything": ["--keep-all-features"]}
FRAMES = ["scene", "variant", "run", "triangles", "features", "render_s", "queues_scene_bytes"]
COMPILE = ["what", "variant", "compile_s"]
FEATURES = ["mode", "feature", "variant", "run", "render_s", "bytes"]


def kept(features):
    return ["--keep-features", ",".join(features)] if features else []


def bytesOf(stats, *groups):
    return sum(stats["memory"].get(group, 0) for group in ("tree", "triangles", "textures", "queues", *groups))


def picture(context):
    return [*context.pick(size(320, 180), size(640, 360)), "--rays-per-pixel", 4]


def coldSeconds(context, scene, *options):
    """To compile with nothing on disk."""
    return context.renderCold(scene, *size(32, 18), "--rays-per-pixel", 4, *options)["time"]["compile"]


def differingPixels(context, scene):
    files = [context.folder / f"e11_{variant}.exr" for variant in VARIANTS]
    for file, options in zip(files, VARIANTS.values()):
        context.render(scene, *picture(context), "-o", file, *options)
    done = subprocess.run([context.whittle, "compare", *files, "--json"], capture_output=True, text=True)
    if not done.stdout:
        raise RunFailed(done.stderr.strip())
    return json.loads(done.stdout)["differingPixels"]


def scenes(context):
    own = sorted(SCENES.glob("*.glb"))
    if context.quick:
        return [f for f in own if f.stem in ("height_field", "mirror")]
    there = [file for path in SHARED_SCENES if (file := context.shared(path))]
    if len(there) < len(SHARED_SCENES):
        context.note(f"e11: {len(SHARED_SCENES) - len(there)} shared scenes are not there and are left out")
    return [*own, context.generated("frame", "--frame"), *there]


def measureScene(context, scene, frames, compiled, pictures):
    runs = {v: functools.partial(context.render, scene, *picture(context), *o) for v, o in VARIANTS.items()}
    for variant, run, stats in interleaved(runs, context.pick(2, 5)):
        frames.row(scene=scene.stem, variant=variant, run=run, triangles=stats["scene"]["triangles"],
                   features=len(stats["features"]["used"]), render_s=stats["time"]["render"],
                   queues_scene_bytes=bytesOf(stats))
    for variant, options in VARIANTS.items():
        compiled.row(what=scene.stem, variant=variant, compile_s=coldSeconds(context, scene, *options))
    pictures.row(scene=scene.stem, differing_pixels=differingPixels(context, scene))


def leftOut(context):
    """Features that the plainest scene does without, in the program's own order."""
    stats = context.render(PLAINEST, *size(32, 18), "--rays-per-pixel", 4)
    names = [f["name"] for f in stats["features"]["leftOut"]]
    return names[::9] if context.quick else names


def plainest(context, features):
    return functools.partial(context.render, PLAINEST, *context.pick(size(160, 90), size(640, 360)),
                             "--rays-per-pixel", 8, *kept(features))


def writeFeature(out, mode, feature, variant, run, stats):
    out.row(mode=mode, feature=feature, variant=variant, run=run, render_s=stats["time"]["render"],
            bytes=bytesOf(stats, "film"))


def measureAlone(context, names, out, progress):
    """Each beside the scene as it is, so often that a few per cent show."""
    for feature in names:
        pair = {"plain": plainest(context, []), "kept": plainest(context, [feature])}
        for variant, run, stats in interleaved(pair, context.pick(2, 7)):
            writeFeature(out, "alone", feature, variant, run, stats)
        progress.step(f"{PLAINEST.stem} with {feature}")


def measureAdded(context, names, out, compiled, progress):
    """One after the other; all of them take turns."""
    steps = {"nothing": []} | {name: names[:i + 1] for i, name in enumerate(names)}
    for feature, features in steps.items():
        compiled.row(what=PLAINEST.stem, variant=f"added: {feature}",
                     compile_s=coldSeconds(context, PLAINEST, *kept(features)))
    variants = {feature: plainest(context, features) for feature, features in steps.items()}
    for feature, run, stats in interleaved(variants, context.pick(1, 5)):
        writeFeature(out, "added", feature, "kept", run, stats)
    progress.step(f"{PLAINEST.stem} with features added one after the other", len(names))


def measure(context):
    frames, compiled = context.table("e11_frames", FRAMES), context.table("e11_compile", COMPILE)
    pictures = context.table("e11_pictures", ["scene", "differing_pixels"])
    features = context.table("e11_features", FEATURES)
    chosen, names = scenes(context), leftOut(context)
    progress = context.progress("e11", 4 * len(chosen) + 2 * len(names) + len(list(switches.pairs())))
    for scene in chosen:
        measureScene(context, scene, frames, compiled, pictures)
        progress.step(scene.stem, 4)
    measureAlone(context, names, features, progress)
    measureAdded(context, names, features, compiled, progress)
    switches.measure(context, progress)


def plot(folder):
    names = ("e11_frames", "e11_compile", "e11_pictures", "e11_features")
    figures.draw(folder, *(table.read(folder, name) for name in names))
    if (folder / "e11_options.tsv").exists():  # data of former runs have none
        switches.draw(folder, table.read(folder, "e11_options"))
