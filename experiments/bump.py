"""How far should rays start off the surface they leave, and along what?

Held constant: scenes (lib/bump_scenes.py), whose pictures are known beforehand, so that whatever else comes out was the
bump's doing. Varied: the bump, by another kernels/lib/surface/ray_offset.cl (bumps/) or a fixed length; the scene's size, 1e-6 to
1e8 m at the origin, and its distance from the origin, up to 1e4 times its size. Counted at each: acne (light lost on
convex bodies), mirror and air (rays that leave one and meet it again), leak (lit pixels in a closed room), the smallest
gap whose shadow and mirror image are whole. Frames of two scenes are timed in turn, with what each needs compiled.
Writes data/bump.tsv (counts), bump_lengths.tsv (acne against the length), bump_times.tsv; figures bump, bump_lengths
and the picture bump_why.
"""
import concurrent.futures
import dataclasses
import functools
import shutil

from lib import bump_picture
from lib import bump_scenes as scenes
from lib import measure as repeat
from lib.bump_scenes import Place
from lib.context import ROOT, SCENES, size
from peers.pictures import pixels


@dataclasses.dataclass(frozen=True)
class Variant:
    """A bump: the file that replaces kernels/lib/surface/ray_offset.cl, and a fixed length where it has one: metres, or heights."""
    name: str
    file: str | None = None
    metres: float | None = None
    heights: float | None = None

    def options(self, context, place):
        kernels = ["--kernels", kernelFolder(context, self.file)] if self.file else []
        length = self.metres if self.heights is None else self.heights * place.size
        return kernels + ([] if length is None else ["--bump", f"{length:.9g}"])


DEFAULT = Variant("2^-20 of the hit, geometric normal")
# Not every vector with every length: a length's faults are the same along each (bump_lengths.tsv has them all).
VARIANTS = [
    DEFAULT,
    Variant("error bound (pbrt-v4), geometric normal", "error_bound"),
    Variant("256 ulp (Ray Tracing Gems 6), geometric normal", "ulp"),
    Variant("1e-5 of the scene, geometric normal", heights=2e-5),
    Variant("1e-4 m, geometric normal", metres=1e-4),
    Variant("2^-20 of the hit, shading normal", "shading_normal"),
    Variant("2^-20 of the hit, ray", "ray_direction"),
    Variant("none", metres=0.0)]
# What the picture shows: the heads of its columns, and the variants.
SHOWN = {"none": "none", "1e-4 m": "1e-4 m, geometric normal",
         "256 ulp": "256 ulp (Ray Tracing Gems 6), geometric normal",
         "$2^{-20}$ along the ray": "2^-20 of the hit, ray",
         "error bound": "error bound (pbrt-v4), geometric normal",
         "$2^{-20}$ (the default)": DEFAULT.name}
QUICK = VARIANTS[:2]
PLACES = [Place(10.0**k) for k in (-6, -4, -2, 0, 2, 4, 6, 8)] + [Place(1.0, 10.0**k) for k in (2, 3, 4)]
QUICK_PLACES = [Place(1e-4), Place(1.0, 1e3)]
LENGTHS = [2.0**k for k in range(-2, 7)]  # in 2^-24 of the coordinates: half an ulp or more
FAR = Place(1.0, 1000.0)
# name: scene, bounces; more than one, so that one program draws all three
PICTURES = {"shadow": (scenes.shadowScene, 2), "mirror": (scenes.mirrorScene, 2), "air": (scenes.airScene, 3)}
RENDERED = ["bump_why.png"]  # a sheet of pictures; none of them is kept as data
COLUMNS = ["variant", "size_m", "away_m", "measure", "value", "of"]
TIMED = {"cornell_box": lambda c: SCENES / "cornell_box.glb", "height_field_256": lambda c: c.heightField(256)}


def kernelFolder(context, name):
    """The program's kernels with bumps/NAME.cl in the place of lib/surface/ray_offset.cl, which it may include as default_ray_offset.cl."""
    folder = context.folder / f"kernels_{name}"
    if not folder.exists():
        shutil.copytree(ROOT / "kernels", folder)
        shutil.copy(folder / "lib" / "surface" / "ray_offset.cl", folder / "lib" / "surface" / "default_ray_offset.cl")
        shutil.copy(ROOT / "experiments" / "bumps" / f"{name}.cl", folder / "lib" / "surface" / "ray_offset.cl")
    return folder


def sceneFile(context, name, place):
    file = context.folder / f"bump_{name}_{place.size:g}_{place.away:g}.glb"
    return file if file.exists() else PICTURES[name][0](place).write(file)


def picture(context, name, place, *options):
    """Radiance of one of the three scenes. All features are kept: one program for all of them."""
    tag = abs(hash((name, place, options)))
    file = context.folder / f"bump_{tag}.exr"
    context.render(sceneFile(context, name, place), *size(scenes.WIDTH, scenes.HEIGHT), "--bounces", PICTURES[name][1],
                   "--threads", 1, "--keep-all-features", "-o", file, *options)
    radiance = pixels(file).astype("f4")
    file.unlink()
    return radiance


def acne(lit, found, *bodies):
    """Lights of pixels that convex bodies lost, and lights of pixels that reach them."""
    spans = [scenes.columns(s) for s in bodies]
    lost = sum(int((lit[:, s] != found[:, s]).sum()) for s in spans)
    return lost, sum(int((lit[:, s] > 0).sum()) for s in spans)


def darkened(found, spans):
    """Pixels that should be 1, and are not."""
    parts = [found[:, scenes.columns(s)] for s in spans]
    return sum(int((p != 1).any(axis=-1).sum()) for p in parts), sum(p.shape[0] * p.shape[1] for p in parts)


def leak(found):
    """Pixels inside the room that are not black."""
    rows = slice(int(0.06 * scenes.HEIGHT), int(0.94 * scenes.HEIGHT))
    inside = found[rows, scenes.columns(scenes.ROOM)]
    return int((inside > 0).any(axis=-1).sum()), inside.shape[0] * inside.shape[1]


def smallestGap(isKept):
    """In heights: the smallest of the gaps that are kept down to it; "none" where the widest is lost."""
    smallest = "none"
    for k, gap in enumerate(scenes.GAPS):
        if not isKept(scenes.tilePixels(k)):
            break
        smallest = gap
    return smallest, ""


def measures(lit, found):
    """measure -> (value, of); found: the pictures, lit: that of suns without shadows."""
    sun = 0  # the one from straight ahead: others shine into a wide gap
    shadow = found["shadow"]
    return {"acne": acne(lit, shadow, scenes.BALL, scenes.FLAT, scenes.SLANTED),
            "acne, leaning normals": acne(lit, shadow, scenes.LEANING),
            "acne, low facet": acne(lit, shadow, scenes.LOW),
            "leak": leak(shadow),
            "gap of a shadow": smallestGap(lambda at: (shadow[at][..., sun] == 0).all() and lit[at][..., sun].all()),
            "mirror": darkened(found["mirror"], [scenes.BALL]),
            "air": darkened(found["air"], [scenes.BALL, scenes.FLAT]),
            "gap in a mirror": smallestGap(lambda at: (found["air"][at] == 0).all())}


def warmUp(context, variants):
    """Compiles each program once, so that runs side by side do not."""
    for file in dict.fromkeys(v.file for v in variants):
        for name in PICTURES:
            picture(context, name, Place(1.0), *Variant("", file).options(context, Place(1.0)))


def sideBySide(context, jobs):
    """Results of functions without arguments, in their order; each run of the program has one thread."""
    with concurrent.futures.ThreadPoolExecutor(context.threads) as pool:
        yield from pool.map(lambda job: job(), jobs)


def count(context, variants, places):
    out = context.table("bump", COLUMNS)
    lit = dict(zip(places, sideBySide(context, [
        functools.partial(picture, context, "shadow", p, "--no-shadows") for p in places])))
    asked = [(v, p) for v in variants for p in places]
    jobs = [functools.partial(picture, context, name, p, *v.options(context, p)) for v, p in asked for name in PICTURES]
    found = sideBySide(context, jobs)
    progress = context.progress("bump", len(asked))
    for variant, place in asked:
        pictures = {name: next(found) for name in PICTURES}
        for measure_, (value, of) in measures(lit[place], pictures).items():
            out.row(variant=variant.name, size_m=place.size, away_m=place.away, measure=measure_, value=value, of=of)
        progress.step(f"{variant.name}, {place.size:g} m, {place.away:g} m away")


def sweepLengths(context):
    """Light lost against the length, for each vector, where the largest coordinate is the same everywhere."""
    out = context.table("bump_lengths", ["vector", "length", "measure", "value", "of"])
    vectors = {"geometric normal": None, "shading normal": "shading_normal", "ray": "ray_direction"}
    lit = picture(context, "shadow", FAR, "--no-shadows")
    asked = [(vector, length) for vector in vectors for length in LENGTHS]
    jobs = []
    for vector, length in asked:
        fixed = Variant("", vectors[vector], metres=length * 2.0**-24 * FAR.away)
        jobs += [functools.partial(picture, context, name, FAR, *fixed.options(context, FAR))
                 for name in ("shadow", "mirror")]
    found = sideBySide(context, jobs)
    for vector, length in asked:
        shadow, image = next(found), next(found)
        lost = {"acne": acne(lit, shadow, scenes.BALL, scenes.FLAT, scenes.SLANTED),
                "acne, leaning normals": acne(lit, shadow, scenes.LEANING), "mirror": darkened(image, [scenes.BALL])}
        for measure_, (value, of) in lost.items():
            out.row(vector=vector, length=length, measure=measure_, value=value, of=of)


def timeFrames(context):
    """Frames of each length and vector, in turn; one fixed length stands for all."""
    out = context.table("bump_times", ["scene", "variant", "run", "render_s"])
    chosen = [v for v in VARIANTS if v.name != "none" and v.heights is None]
    for name, find in list(TIMED.items())[:context.pick(1, None)]:
        file, picture_ = find(context), context.pick(size(320, 180), size(1280, 720))
        runs = {v.name: functools.partial(context.render, file, *picture_, *v.options(context, Place(1.0)))
                for v in context.pick(chosen[:2], chosen)}
        for variant, run, stats in repeat.interleaved(runs, context.pick(2, 7)):
            out.row(scene=name, variant=variant, run=run, render_s=stats["time"]["render"])


def counts(context):
    """Everything that does not depend on how busy the machine is."""
    variants = context.pick(QUICK, VARIANTS)
    warmUp(context, variants)
    count(context, variants, context.pick(QUICK_PLACES, PLACES))
    if not context.quick:
        sweepLengths(context)
    named = {v.name: v for v in variants}
    bump_picture.render(context, {title: named[name] for title, name in SHOWN.items() if name in named})


def measure(context):
    counts(context)
    timeFrames(context)


def plot(folder):
    from lib import bump_figures
    bump_figures.draw(folder)
