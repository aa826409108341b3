"""What each option of the picture costs where the scene has a use for it, and where it has none: then the same features
are compiled as without it, and the ratio shows noise alone.
"""
import functools
import statistics

from lib import style
from lib.context import SCENES, size
from lib.measure import interleaved, medianInterval

COLUMNS = ["option", "use", "scene", "variant", "run", "features", "seconds"]
SUN = ["--sky", "40,120", "--ambient", "0"]
# Of each option: what leaves it off, what turns it on, a scene with a use for it, one without.
OPTIONS = {
    "area lights": (["--no-default-lights"], ["--no-default-lights", "--area-lights"], "cornell_box", "shadow"),
    "gloss": ([], ["--glossy"], "textured", "shadow"),
    "a thin lens": ([], ["--aperture", "0.05"], "cornell_box", None),
    "soft lamps": ([], ["--light-radius", "0.05"], "cornell_box", "height_field"),
    "a soft sun": ([], ["--sun-angle", "0.53"], "height_field", "cornell_box"),
    "light from the sky": (SUN, [*SUN, "--sky-light"], "height_field", None),
    "light from a black sky": ([], ["--sky-light"], None, "cornell_box"),
    "filtered textures": (["--texture-filter", "none"], [], "textured", "cornell_box"),
    "smooth terminator": (["--no-smooth-terminator"], [], "cornell_box", "emission"),
    "bloom": ([], ["--bloom", "0.05"], "cornell_box", None),
    "dither": ([], ["--dither"], "cornell_box", None),
}


def seconds(stats):
    """Bloom and dither come while the picture is written."""
    return stats["time"]["render"] + stats["time"]["write"]


def pairs():
    for option, (off, on, user, other) in OPTIONS.items():
        for use, scene in (("used", user), ("unused", other)):
            if scene:
                yield option, use, scene, {"off": off, "on": on}


def measure(context, progress):
    out = context.table("e11_options", COLUMNS)
    picture = [*context.pick(size(160, 90), size(640, 360)), "--rays-per-pixel", 8, "-o", context.folder / "o.png"]
    for option, use, scene, variants in pairs():
        runs = {v: functools.partial(context.render, SCENES / f"{scene}.glb", *picture, *o) for v, o in variants.items()}
        for variant, run, stats in interleaved(runs, context.pick(2, 7)):
            out.row(option=option, use=use, scene=scene, variant=variant, run=run,
                    features=len(stats["features"]["used"]), seconds=seconds(stats))
        progress.step(f"{option} in {scene}")


def ratios(rows, option, use):
    """Of each run with the option to the one without beside it, where it has one."""
    found = {(r["variant"], r["run"]): r["seconds"] for r in rows if r["option"] == option and r["use"] == use}
    return [s / found["off", run] for (variant, run), s in found.items() if variant == "on" and ("off", run) in found]


def draw(folder, rows):
    names = list(dict.fromkeys(r["option"] for r in rows))
    figure, axis = style.figure(1, 1, 0.3 * len(names) + 1.6)
    axis.axvline(1.0, color=style.BLACK, linewidth=0.8)
    for use, color, offset in (("used", style.BLUE, -0.14), ("unused", style.RED, 0.14)):
        for y, name in enumerate(names):
            found = ratios(rows, name, use)
            if not found:
                continue
            middle, low, high = medianInterval(found)
            axis.plot([low, high], [y + offset] * 2, color=color, linewidth=3, alpha=0.35, solid_capstyle="butt")
            axis.plot([middle], [y + offset], "o", color=color)
        axis.plot([], [], "o", color=color, label=f"the scene has {'a' if use == 'used' else 'no'} use for it")
    axis.set(xlabel="frame and its files, over those without the option")
    axis.set_yticks(range(len(names)), names)
    axis.set_ylim(len(names) - 0.4, -0.6)
    axis.legend(loc="lower right")
    unused = [m for name in names if (found := ratios(rows, name, "unused")) for m in [statistics.median(found)]]
    figure.suptitle(f"Options that a scene has no use for take {min(unused):.2f} to {max(unused):.2f} times as long",
                    x=0.01, ha="left", fontsize=11, weight="bold")
    style.save(figure, folder, "e11_options")
