#!/usr/bin/python3
"""Every effect of the model beside the same picture without it, on one sheet: contact_sheet.jpg.

What has an option is left out by it; a cone, a glow and a bend are taken out of a copy of the scene, whose JSON is
edited. Anti-aliased, but where that itself is left out.

usage: scenes/pictures/contact_sheet.py [WHITTLE]   (default build/release/whittle)
needs: Debian's python3-numpy and python3-openimageio; /usr/bin/python3
"""
import json
import pathlib
import struct
import subprocess
import sys
import tempfile

import numpy
import OpenImageIO as oiio

HERE = pathlib.Path(__file__).resolve().parent
WIDTH, HEIGHT = 472, 266   # of a picture, pixels
GAP, LABEL = 8, 46         # between two, and of the two lines below each
COLUMNS = 4
FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"  # of fonts-dejavu-core
SMOOTH = ["--rays-per-pixel", "16", "--sampler", "stratified"]
WITH, WITHOUT = (0.13, 0.15, 0.18), (0.23, 0.15, 0.13)  # behind pictures, with the effect and without it


def edited(scene, change, folder):
    """A copy of the .glb whose JSON `change` has gone over."""
    data = (HERE.parent / f"{scene}.glb").read_bytes()
    length, = struct.unpack_from("<I", data, 12)
    document = json.loads(data[20:20 + length])
    change(document)
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    rest = data[20 + length:]
    copy = folder / f"{scene}_edited.glb"
    copy.write_bytes(struct.pack("<4sIIII", b"glTF", 2, 20 + len(text) + len(rest), len(text), 0x4E4F534A) + text + rest)
    return copy


def without_cones(document):
    for light in document["extensions"]["KHR_lights_punctual"]["lights"]:
        light["type"] = "point"
        light.pop("spot", None)


def without_glow(document):
    for material in document["materials"]:
        material.pop("emissiveFactor", None)
        material.get("extensions", {}).pop("KHR_materials_emissive_strength", None)


def without_bend(document):
    for material in document["materials"]:
        extensions = material.get("extensions", {})
        if "KHR_materials_transmission" in extensions:
            extensions["KHR_materials_ior"] = {"ior": 1.0}
    document["extensionsUsed"] = sorted({*document["extensionsUsed"], "KHR_materials_ior"})


# Scene, with the effect?, what to change in the file, options, two lines.
CELLS = [
    *(("mirror_box", True, None, [*SMOOTH, "--bounces", str(n)], f"Mirror box, {n} bounce{'s' if n > 1 else ''}", text)
      for n, text in ((1, "light from the lamp alone"), (2, "one room behind each mirror"), (7, "rooms within rooms"),
                      (32, "until the mirrors have swallowed the light"))),
    ("cornell_box", True, None, SMOOTH, "Cornell box", "all effects together"),
    ("cornell_box", False, None, ["--no-shadows", "--bounces", "1"], "and none of them",
     "--no-shadows --bounces 1, one ray per pixel"),
    ("spot_cone", True, None, SMOOTH, "Spot lights", "one with a soft edge, two with a hard one"),
    ("spot_cone", False, without_cones, SMOOTH, "without their cones", "the same lamps as points"),
    ("emission", True, None, SMOOTH, "Emission", "rings that glow, and their images"),
    ("emission", False, without_glow, SMOOTH, "without it", "what little other light there is"),
    ("shadow", True, None, SMOOTH, "Shadows", "of a red, a green and a blue lamp"),
    ("shadow", False, None, [*SMOOTH, "--no-shadows"], "without them", "--no-shadows"),
    ("mirror", True, None, SMOOTH, "Mirrors", "one flat, one round"),
    ("mirror", False, None, [*SMOOTH, "--bounces", "1"], "without reflections", "--bounces 1"),
    ("refraction", True, None, SMOOTH, "Refraction", "a ball, a plate and a wedge of glass"),
    ("refraction", False, without_bend, SMOOTH, "without bending", "glass of index 1"),
    ("anti_aliasing", True, None, ["--rays-per-pixel", "64", "--sampler", "stratified"], "Anti-aliasing",
     "64 rays per pixel"),
    ("anti_aliasing", False, None, ["--rays-per-pixel", "1"], "without it", "one ray per pixel"),
    ("anti_aliasing", True, None, ["--rays-per-pixel", "64", "--sampler", "stratified", "--crop", "40%,40%,25%,25%"],
     "The same, four times as large", "64 rays per pixel"),
    ("anti_aliasing", False, None, ["--rays-per-pixel", "1", "--crop", "40%,40%,25%,25%"], "and without it",
     "one ray per pixel"),
]


def render(whittle, scene, options, folder):
    """Linear sRGB codes in [0, 1], [HEIGHT, WIDTH, 3]; a crop is enlarged pixel by pixel."""
    picture = folder / "picture.png"
    subprocess.run([whittle, "render", scene, "-o", picture, "--quiet", "--exposure", "0", "--width", str(WIDTH), "--height", str(HEIGHT),
                    *options], check=True)
    image = oiio.ImageInput.open(str(picture))  # an ImageBuf may show what a cache has of the file's last content
    codes = image.read_image(oiio.FLOAT)[..., :3]
    image.close()
    larger = WIDTH // codes.shape[1]
    return numpy.ascontiguousarray(codes.repeat(larger, axis=0).repeat(larger, axis=1)[:HEIGHT, :WIDTH])


def main():
    whittle = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else HERE.parent.parent / "build" / "release" / "whittle")
    rows = (len(CELLS) + COLUMNS - 1) // COLUMNS
    across, down = WIDTH + GAP, HEIGHT + LABEL + GAP
    sheet = oiio.ImageBuf(oiio.ImageSpec(COLUMNS * across + GAP, rows * down + GAP, 3, oiio.FLOAT))
    oiio.ImageBufAlgo.fill(sheet, (0.07, 0.07, 0.08))
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for i, (scene, has_effect, change, options, title, line) in enumerate(CELLS):
            file = edited(scene, change, folder) if change else HERE.parent / f"{scene}.glb"
            codes = render(whittle, file, options, folder)
            left, top = GAP + i % COLUMNS * across, GAP + i // COLUMNS * down
            oiio.ImageBufAlgo.fill(sheet, WITH if has_effect else WITHOUT,
                                   roi=oiio.ROI(left, left + WIDTH, top, top + HEIGHT + LABEL))
            one = oiio.ImageBuf(oiio.ImageSpec(codes.shape[1], codes.shape[0], 3, oiio.FLOAT))
            one.set_pixels(one.roi, codes)
            oiio.ImageBufAlgo.paste(sheet, left, top, 0, 0, one)
            oiio.ImageBufAlgo.render_text(sheet, left + 8, top + HEIGHT + 20, title, 17, FONT, (1, 1, 1))
            oiio.ImageBufAlgo.render_text(sheet, left + 8, top + HEIGHT + 39, line, 14, FONT, (0.80, 0.80, 0.80))
    sheet.set_write_format(oiio.UINT8)
    sheet.specmod().attribute("Compression", "jpeg:88")
    sheet.write(str(HERE / "contact_sheet.jpg"))
    print("contact_sheet.jpg")


if __name__ == "__main__":
    main()
