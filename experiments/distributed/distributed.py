"""How does the error of soft shadows, gloss and a lens fall with time, by sampler?

Four pictures (96×54), each with one kind of distributed rays (Cook, Porter and Carpenter 1984), at 4 to 256 rays for
each pixel. Held constant: device, all threads, depth; kernels are compiled beforehand. The truth is a picture of 64 times
as many Sobol points with another seed; runs measure themselves against it with --reference.

Writes distributed.tsv (a row for each run); figure distributed.
"""
import functools
import json
import struct

from lib import fit, style, table
from lib.context import SCENES, size
from lib.measure import curve, grouped, interleaved

SAMPLERS = ["random", "stratified", "sobol"]
COLUMNS = ["subject", "sampler", "rays_per_pixel", "seed", "seconds", "rmse", "mean"]
ROUGHNESS = 0.35


def roughened(context, scene):
    """The scene with mirrors and glass of that roughness."""
    data = (SCENES / f"{scene}.glb").read_bytes()
    length = struct.unpack_from("<I", data, 12)[0]
    document = json.loads(data[20:20 + length])
    for material in document["materials"]:
        factors = material.setdefault("pbrMetallicRoughness", {})
        factors["roughnessFactor"] = max(ROUGHNESS, factors.get("roughnessFactor", 1.0))
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    rest = data[20 + length:]
    file = context.folder / f"rough_{scene}.glb"
    file.write_bytes(struct.pack("<4sIIII", b"glTF", 2, 20 + len(text) + len(rest), len(text), 0x4E4F534A) + text + rest)
    return file


def subjects(context):
    """Title -> (scene, options)."""
    found = {"soft shadow of a lamp": (SCENES / "cornell_box.glb", ["--area-lights", "--bounces", 1]),
             "soft shadows of balls": (SCENES / "shadow.glb", ["--light-radius", 0.15, "--bounces", 1]),
             "gloss": (roughened(context, "cornell_box"), ["--glossy", "--bounces", 4]),
             "lens": (SCENES / "anti_aliasing.glb", ["--aperture", 0.05, "--focus-pixel", "48,40", "--bounces", 2])}
    return dict(list(found.items())[:2]) if context.quick else found


def truth(context, title, scene, options, most):
    """The converged picture, and its mean radiance."""
    file = context.folder / f"{title.replace(' ', '_')}.exr"
    stats = context.render(scene, *options, *size(96, 54), "--sampler", "sobol", "--seed", 1000, "--rays-per-pixel",
                           64 * most, "-o", file)
    return file, stats["meanRadiance"]


def measure(context):
    out = context.table("distributed", COLUMNS)
    counts, seeds = context.pick(([4, 16], 1), ([4, 16, 64, 256], 5))
    todo = subjects(context)
    progress = context.progress("distributed", len(todo))
    for title, (scene, options) in todo.items():
        reference, mean = truth(context, title, scene, options, counts[-1])
        for seed in range(1, seeds + 1):
            runs = {(sampler, n): functools.partial(context.render, scene, *options, *size(96, 54), "--sampler", sampler,
                                                    "--seed", seed, "--rays-per-pixel", n, "--reference", reference)
                    for sampler in SAMPLERS for n in counts}
            for (sampler, n), _, stats in interleaved(runs, 1):
                out.row(subject=title, sampler=sampler, rays_per_pixel=n, seed=seed, seconds=stats["time"]["render"],
                        rmse=stats["error"][-1]["rmse"], mean=mean)
        progress.step(title)


def slope(rows, **chosen):
    """Exponent of the error over the rays: mean over the seeds, with Student's interval."""
    picked = [r for r in rows if all(r[k] == v for k, v in chosen.items())]
    by_seed = grouped(picked, ["seed"], lambda r: (r["rays_per_pixel"], r["rmse"])).values()
    return fit.across([float(fit.power(*zip(*points)).values[1]) for points in by_seed if len(points) >= 3])


def plot(folder):
    rows = [dict(r, error=r["rmse"] / r["mean"]) for r in table.read(folder, "distributed")]
    titles = list(dict.fromkeys(r["subject"] for r in rows))
    threads = style.threadsText(table.readMachine(folder, "distributed")["cpu"]["threads"])
    figure, axes = style.figure((len(titles) + 1) // 2, 2, 3.3 * ((len(titles) + 1) // 2), squeeze=False)
    every = []
    for title, axis in zip(titles, axes.flat):
        axis.set(xscale="log", yscale="log", title=title, xlabel=f"seconds of rendering ({threads})",
                 ylabel="RMSE over the mean")
        style.plainLog(axis.xaxis, (1, 3))
        labels = style.EndLabels(axis)
        for i, sampler in enumerate(SAMPLERS):
            seconds = curve(rows, "rays_per_pixel", "seconds", subject=title, sampler=sampler)[1]
            _, middle, low, high = curve(rows, "rays_per_pixel", "error", subject=title, sampler=sampler)
            style.draw(axis, i, seconds, middle, low, high)
            name = sampler.replace("sobol", "Sobol")
            if len(seconds) >= 3:
                name += f" ∝ N^{fit.shown(*slope(rows, subject=title, sampler=sampler))}"
            labels.add(seconds[-1], middle[-1], name, style.look(i)["color"])
        every.append(labels)
    style.placeAll(every, size=8)
    style.save(figure, folder, "distributed")
