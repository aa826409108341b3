#!/usr/bin/python3
"""Do moving scenes look at five times as an independent viewer has them?

Draws skins, morph targets, turning and jumping nodes and properties by JSON pointer with `whittle render --time` and
with three.js in a browser without a window, and prints for each file and time FLIP's mean and the RMSE of the light, as
`whittle compare` has them. So that only the movement is asked about, every material is made matte (no metal, no
specular part), and one directional light without shadows and, where the file has none, a camera are added to the file,
which both read. Both pictures are means of sixteen samples of each pixel.

usage: experiments/checks/viewer.py [--whittle FILE] [--keep FOLDER]   (by hand: it asks npm for packages)
needs: npm, chromium, Debian's python3-numpy and python3-pil; /usr/bin/python3
"""
import argparse
import base64
import functools
import http.server
import io
import json
import pathlib
import shutil
import subprocess
import tempfile
import threading

import numpy
from PIL import Image

from same_bits import ROOT, SHARED
from viewer_scenes import moving_parts, pointers

HERE = pathlib.Path(__file__).resolve().parent
PACKAGES = ["three@0.180.0", "@needle-tools/three-animation-pointer@1.0.7"]
BROWSER = ["chromium", "--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--use-angle=swiftshader",
           "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist", "--disable-background-networking"]
WIDTH, HEIGHT, SIDE = 320, 240, 4  # SIDE x SIDE samples of a pixel
MOMENTS = (0.05, 0.3, 0.5, 0.7, 0.95)  # of the animation's length
REAL = ["AnimatedCube", "RiggedSimple", "SimpleMorph", "SimpleSkin"]


class Server(http.server.ThreadingHTTPServer):
    """Hands out the folder and the packages, and takes what the page posts."""

    def __init__(self, folder, modules):
        self.done, self.answer = threading.Event(), None
        server = self

        class Handler(http.server.SimpleHTTPRequestHandler):
            def translate_path(self, path):
                if path.startswith("/modules/"):
                    return str(modules / path.removeprefix("/modules/").split("?")[0])
                return super().translate_path(path)

            def do_POST(self):
                server.answer = json.loads(self.rfile.read(int(self.headers["Content-Length"])))
                self.send_response(204)
                self.end_headers()
                server.done.set()

            def log_message(self, *_):
                pass

        super().__init__(("127.0.0.1", 0), functools.partial(Handler, directory=str(folder)))
        threading.Thread(target=self.serve_forever, daemon=True).start()


def viewed(folder, modules, file, times, by_pointer):
    """The pictures that the page makes of a file in the folder, RGB in 8 bits."""
    (folder / "wanted.json").write_text(json.dumps({"file": file, "times": times, "width": WIDTH * SIDE,
                                                    "height": HEIGHT * SIDE, "pointers": by_pointer}))
    shutil.copy(HERE / "viewer/page.html", folder / "page.html")
    server = Server(folder, modules)
    address = f"http://127.0.0.1:{server.server_address[1]}/page.html"
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        browser = subprocess.Popen([*BROWSER, f"--user-data-dir={profile}", address], stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL)
        server.done.wait(240)
        browser.terminate()
        browser.wait()
    server.shutdown()
    if server.answer is None or "error" in server.answer:
        raise RuntimeError((server.answer or {"error": "the browser made no picture in four minutes"})["error"])
    return [averaged(base64.b64decode(url.split(",")[1])) for url in server.answer["pictures"]]


def averaged(png):
    """The mean light of SIDE x SIDE pixels of a picture, as sRGB codes."""
    codes = numpy.asarray(Image.open(io.BytesIO(png)).convert("RGB")) / 255.0
    light = numpy.where(codes <= 0.04045, codes / 12.92, ((codes + 0.055) / 1.055) ** 2.4)
    light = light.reshape(HEIGHT, SIDE, WIDTH, SIDE, 3).mean(axis=(1, 3))
    codes = numpy.where(light <= 0.0031308, light * 12.92, 1.055 * light ** (1 / 2.4) - 0.055)
    return Image.fromarray(numpy.rint(codes * 255).astype(numpy.uint8))


def looking(box):
    """A matrix that looks at a box from the front right, glTF's order."""
    low, high = numpy.array(box["min"]), numpy.array(box["max"])
    back = numpy.array([0.45, 0.35, 1.0]) / numpy.linalg.norm([0.45, 0.35, 1.0])
    eye = (low + high) / 2 + 1.6 * max(numpy.linalg.norm(high - low), 1e-3) * back
    right = numpy.cross([0, 1, 0], back)
    right /= numpy.linalg.norm(right)
    return [*right, 0, *numpy.cross(back, right), 0, *back, 0, *eye, 1]


def prepared(gltf, box):
    """Matte materials, a camera and a light: see the head."""
    matte = {"metallicFactor": 0, "roughnessFactor": 1}
    for material in gltf.setdefault("materials", []):
        material.setdefault("pbrMetallicRoughness", {}).update(matte)
        material["pbrMetallicRoughness"].pop("metallicRoughnessTexture", None)
        material.setdefault("extensions", {})["KHR_materials_specular"] = {"specularFactor": 0}
    gltf["materials"].append({"pbrMetallicRoughness": matte,
                              "extensions": {"KHR_materials_specular": {"specularFactor": 0}}})
    for mesh in gltf["meshes"]:
        for primitive in mesh["primitives"]:
            primitive.setdefault("material", len(gltf["materials"]) - 1)
    gltf["extensionsUsed"] = sorted({*gltf.get("extensionsUsed", []), "KHR_materials_specular", "KHR_lights_punctual"})
    gltf.setdefault("extensions", {}).setdefault("KHR_lights_punctual", {}).setdefault("lights", []).append(
        {"type": "directional", "intensity": 2.5})
    light = len(gltf["extensions"]["KHR_lights_punctual"]["lights"]) - 1
    if not gltf.get("cameras"):
        gltf["cameras"] = [{"type": "perspective", "perspective": {"yfov": 0.7, "znear": 0.01, "zfar": 1000}}]
        gltf["nodes"].append({"camera": 0, "matrix": looking(box)})
        gltf["scenes"][gltf.get("scene", 0)]["nodes"].append(len(gltf["nodes"]) - 1)
    gltf["nodes"].append({"rotation": [-0.35, 0.25, 0.1, 0.9], "extensions": {"KHR_lights_punctual": {"light": light}}})
    gltf["scenes"][gltf.get("scene", 0)]["nodes"].append(len(gltf["nodes"]) - 1)
    return gltf


def compared(whittle, folder, name, modules):
    """Prints a line for each time of the file NAME.gltf in the folder."""
    file = folder / f"{name}.gltf"
    info = json.loads(subprocess.run([whittle, "info", "--json", "--quiet", file], check=True,
                                     capture_output=True).stdout)
    gltf = prepared(json.loads(file.read_text()), info["bounds"])
    file.write_text(json.dumps(gltf))
    times = [round(f * info["animations"][0]["seconds"], 4) for f in MOMENTS]
    by_pointer = "KHR_animation_pointer" in gltf["extensionsUsed"]
    for number, (time, picture) in enumerate(zip(times, viewed(folder, modules, file.name, times, by_pointer))):
        theirs, ours = folder / f"{name}_{number}_three.png", folder / f"{name}_{number}.png"
        picture.save(theirs)
        subprocess.run([whittle, "render", file, "-o", ours, "--time", str(time), "--width", str(WIDTH), "--height",
                        str(HEIGHT), "--rays-per-pixel", str(SIDE * SIDE), "--no-shadows", "--exposure", "0",
                        "--tone-map", "none", "--background", "0,0,0", "--quiet"], check=True)
        said = json.loads(subprocess.run([whittle, "compare", "--json", ours, theirs], check=True,
                                         capture_output=True).stdout)
        print(name, time, f"{said['flip']:.5f}", f"{said['rmse']:.5f}", sep="\t", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--whittle", type=pathlib.Path, default=ROOT / "build/release/whittle")
    parser.add_argument("--keep", type=pathlib.Path, metavar="FOLDER", help="leave files and pictures there")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        folder = options.keep or pathlib.Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        subprocess.run(["npm", "install", "--silent", "--no-fund", "--prefix", folder / "npm", *PACKAGES], check=True)
        print("file", "seconds", "FLIP", "RMSE", sep="\t")
        for name, scene in {"moving_parts": moving_parts, "pointers": pointers}.items():
            (folder / name).mkdir(exist_ok=True)
            (folder / name / f"{name}.gltf").write_text(json.dumps(scene()))
            compared(options.whittle, folder / name, name, folder / "npm/node_modules")
        for name in REAL:
            source = SHARED / "gltf" / name / "glTF"
            if not source.exists():
                continue
            shutil.copytree(source, folder / name, dirs_exist_ok=True, copy_function=shutil.copyfile)
            compared(options.whittle, folder / name, name, folder / "npm/node_modules")


if __name__ == "__main__":
    main()
