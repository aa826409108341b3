#!/usr/bin/python3
"""Where a picture begins to go wrong as one thing grows or shrinks: the Cornell box scaled, moved, brightened, and with
many lamps for one, each against the picture that it should still be. One line of tab-separated values for each step:
RMSE over the mean radiance (a brighter picture is divided by its factor first), the same against double precision on
the same triangles (where the scene is moved: the floats of its file move, too), samples that were not finite, triangles
that were dropped, rays over the rays of the first picture, seconds of rendering, the first warning or the error.

usage: experiments/run limits [-- --sweep NAME ...]   (default: all of them)
needs: Debian's python3-numpy and python3-openimageio; /usr/bin/python3
"""
import argparse
import json
import pathlib
import struct
import subprocess
import tempfile

import numpy
import OpenImageIO

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENE = ROOT / "scenes" / "cornell_box.glb"
POWERS = {"scale": [-20, -19, -18, -17, -16, -15, -12, -9, -6, -3, 3, 6, 9, 12, 15, 16, 17, 18, 19],
          "distance": range(0, 7), "intensity": [-44, -42, -40, -38, -36, -34, -30, -20, 20, 30, 34, 36, 37, 38, 39],
          "lights": range(0, 5)}


def parts():
    """JSON and binary chunk of the scene."""
    data = SCENE.read_bytes()
    length = struct.unpack_from("<I", data, 12)[0]
    return json.loads(data[20:20 + length]), data[20 + length:]


def write(file, document, binary):
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    file.write_bytes(struct.pack("<4sII", b"glTF", 2, 20 + len(text) + len(binary)) +
                     struct.pack("<II", len(text), 0x4E4F534A) + text + binary)


def lights(document):
    return document["extensions"]["KHR_lights_punctual"]["lights"]


def under(document, **transform):
    """The whole scene as the child of one more node."""
    scene = document["scenes"][0]
    document["nodes"].append({"children": scene["nodes"], **transform})
    scene["nodes"] = [len(document["nodes"]) - 1]


def scaled(document, factor):
    """The same picture at any size: lamps grow with the square, absorption lengths with the size."""
    under(document, scale=[factor] * 3)
    for light in lights(document):
        light["intensity"] *= factor**2
    for material in document["materials"]:
        volume = material.get("extensions", {}).get("KHR_materials_volume", {})
        for key in ("attenuationDistance", "thicknessFactor"):
            if key in volume:
                volume[key] *= factor


def brighter(document, factor):
    for light in lights(document):
        light["intensity"] *= factor
    for material in document["materials"]:
        extensions = material.get("extensions", {})
        if "KHR_materials_emissive_strength" in extensions:
            extensions["KHR_materials_emissive_strength"]["emissiveStrength"] *= factor


def manyLamps(document, count):
    """`count` lamps with a share each where there was one."""
    for node in [n for n in document["nodes"] if "KHR_lights_punctual" in n.get("extensions", {})]:
        for _ in range(int(count) - 1):
            document["scenes"][0]["nodes"].append(len(document["nodes"]))
            document["nodes"].append(dict(node))
    for light in lights(document):
        light["intensity"] /= count


def changed(sweep, factor):
    """The scene of one step."""
    document, binary = parts()
    if sweep == "scale":
        scaled(document, factor)
    elif sweep == "distance":
        under(document, translation=[factor, 0, 0])
    elif sweep == "intensity":
        brighter(document, factor)
    elif sweep == "lights":
        manyLamps(document, factor)
    return document, binary


def render(whittle, folder, command="render"):
    """Radiance [h, w, 3] or None, statistics, first line of standard error."""
    picture = folder / f"{len(list(folder.iterdir()))}.exr"  # another name each: OpenImageIO keeps files that it read
    done = subprocess.run([whittle, command, folder / "scene.glb", "--width", "64", "--height", "36", "--quiet",
                           "-o", picture, "--stats", "-"], capture_output=True, text=True)
    said = (done.stderr.strip().split("\n") or [""])[0]
    if done.returncode != 0:
        return None, None, said
    image = OpenImageIO.ImageBuf(str(picture))
    return image.get_pixels(OpenImageIO.FLOAT).astype(float)[..., :3], json.loads(done.stdout), said


def distance(picture, right):
    """RMSE over the mean, as text."""
    with numpy.errstate(all="ignore"):
        return f"{numpy.sqrt(((picture - right)**2).mean()) / right.mean():.2e}"


def line(step, base, found, factor, double):
    (picture, stats, said), (right, rightStats, _) = found, base
    if picture is None:
        return f"{step}\t\t\t\t\t\t\t{said}"
    beside = "" if double is None else distance(picture, double)
    return (f"{step}\t{distance(picture / factor, right)}\t{beside}\t{stats['nonFinite']}\t"
            f"{stats['scene'].get('droppedTriangles', 0)}\t"
            f"{stats['rays']['total'] / rightStats['rays']['total']:.4f}\t{stats['time']['render']:.3f}\t{said}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--whittle", default=str(ROOT / "build/release/whittle"))
    parser.add_argument("--sweep", action="append", choices=list(POWERS))
    args = parser.parse_args()
    print("sweep\tfactor\trmse/mean\trmse/mean to double\tnonFinite\tdropped\trays\tseconds\tsaid")
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        for sweep in args.sweep or POWERS:
            write(folder / "scene.glb", *parts())
            base = render(args.whittle, folder)
            for power in POWERS[sweep]:
                write(folder / "scene.glb", *changed(sweep, 10.0**power))
                found = render(args.whittle, folder)
                double = render(args.whittle, folder, "reference")[0] if sweep == "distance" else None
                brightness = 10.0**power if sweep == "intensity" else 1.0
                print(line(f"{sweep}\t1e{power}", base, found, brightness, double), flush=True)


if __name__ == "__main__":
    main()
