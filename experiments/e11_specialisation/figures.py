"""Figures of E11: each scene against everything, and what features cost the plainest scene, alone and one after
another."""
import statistics

from lib import style
from lib.measure import medianInterval


def median(rows, key, **chosen):
    return statistics.median(r[key] for r in rows if all(r[k] == v for k, v in chosen.items()))


def sceneRow(scene, frames, compiled):
    """What everything takes over what the scene takes: time of frames, of compiling; and bytes the other way."""
    frame = {v: median(frames, "render_s", scene=scene, variant=v) for v in ("special", "everything")}
    kernels = {v: median(compiled, "compile_s", what=scene, variant=v) for v in ("special", "everything")}
    held = {v: median(frames, "queues_scene_bytes", scene=scene, variant=v) for v in ("special", "everything")}
    features = next(r["features"] for r in frames if r["scene"] == scene and r["variant"] == "special")
    return {"scene": f"{scene} ({features})", "frame": frame["everything"] / frame["special"],
            "compile": kernels["everything"] / kernels["special"], "memory": held["special"] / held["everything"]}


def bars(axis, values, label):
    axis.barh(range(len(values)), values, color=style.BLUE, height=0.7)
    for i, value in enumerate(values):
        axis.text(value, i, f"{value:.2f} ", va="center", ha="right", fontsize=8, color="white")
    axis.axvline(1.0, color=style.BLACK, linewidth=0.8, zorder=0)
    axis.set(xlabel=label, ylim=(-0.6, len(values) - 0.4), xlim=(0, max(1.0, *values) * 1.04))
    axis.grid(False)


def title(rows, pictures):
    ratios = [r["frame"] for r in rows]
    changed = sum(p["differing_pixels"] for p in pictures)
    return (f"{len(rows)} scenes: frames {min(ratios):.2f} to {max(ratios):.2f} times as fast as with everything; "
            f"{changed} pixels differ")


def drawScenes(folder, frames, compiled, pictures):
    scenes = list(dict.fromkeys(r["scene"] for r in frames))
    rows = sorted((sceneRow(s, frames, compiled) for s in scenes), key=lambda r: r["frame"])
    figure, axes = style.figure(1, 3, max(3.4, 0.25 * len(rows) + 1.5), sharey=True)
    bars(axes[0], [r["frame"] for r in rows], "frame: times as fast\nas with everything")
    bars(axes[1], [r["compile"] for r in rows], "compiling, nothing on disk:\ntimes as fast")
    bars(axes[2], [r["memory"] for r in rows], "queues and scene:\nshare of everything's bytes")
    axes[0].set_yticks(range(len(rows)), [r["scene"] for r in rows])
    axes[0].set_ylabel("scene (features it needs)")
    figure.suptitle(title(rows, pictures), x=0.01, ha="left", fontsize=11, weight="bold")
    style.save(figure, folder, "e11_scenes")


def aloneRatios(features, name):
    """Of each run with the feature to the one without beside it."""
    seconds = {(r["variant"], r["run"]): r["render_s"] for r in features
               if r["mode"] == "alone" and r["feature"] == name}
    return [s / seconds["plain", run] for (variant, run), s in seconds.items() if variant == "kept"]


def drawAlone(axis, features, names):
    axis.set(xlabel="alone: frame over that\nof the scene as it is")
    axis.axvline(1.0, color=style.BLACK, linewidth=0.8)
    for y, name in enumerate(names):
        if name == "nothing":
            continue
        ratios = aloneRatios(features, name)
        middle, low, high = medianInterval(ratios)
        sure = len(ratios) >= 5 and (low > 1.0 or high < 1.0)  # of fewer the interval is no more than their range
        axis.plot([low, high], [y, y], color=style.BLUE, linewidth=3, alpha=0.35, solid_capstyle="butt")
        axis.plot([middle], [y], "o", color=style.BLUE, markerfacecolor=style.BLUE if sure else "white")


def drawSteps(axis, values, label, base=None):
    """A step line down the list of features."""
    axis.set_xlabel(label)
    axis.step(values, range(len(values)), where="pre", color=style.RED, linewidth=1.2)
    axis.plot(values, range(len(values)), "s", color=style.RED, markersize=3.5)
    if base is not None:
        axis.axvline(base, color=style.BLACK, linewidth=0.8)


def drawFeatures(folder, features, compiled):
    added = [r for r in features if r["mode"] == "added"]
    names = list(dict.fromkeys(r["feature"] for r in added))
    figure, axes = style.figure(1, 4, 0.2 * len(names) + 1.6, sharey=True, width_ratios=[1.3, 1, 1, 1])
    drawAlone(axes[0], features, names)
    frame = [median(added, "render_s", feature=n) for n in names]
    drawSteps(axes[1], [f / frame[0] for f in frame], "one after another:\nframe over the first", 1.0)
    seconds = {r["variant"]: r["compile_s"] for r in compiled}
    drawSteps(axes[2], [seconds[f"added: {n}"] for n in names], "one after another:\ncompiling, s")
    drawSteps(axes[3], [median(added, "bytes", feature=n) / 1e6 for n in names], "one after another:\nbuffers, MB")
    axes[0].set_yticks(range(len(names)), names, fontsize=8)
    axes[0].set_ylim(len(names) - 0.4, -0.6)
    figure.suptitle(f"height_field with features that it does without: all of them take "
                    f"{frame[-1] / frame[0]:.2f} times as long", x=0.01, ha="left", fontsize=11, weight="bold")
    style.save(figure, folder, "e11_features")


def draw(folder, frames, compiled, pictures, features):
    drawScenes(folder, frames, compiled, pictures)
    drawFeatures(folder, features, compiled)
