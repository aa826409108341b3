"""Kernels that write, in the place of the base colour, how many texels of its texture a hit asks for.

The lookups of the project's own kernels, with some lines replaced in a copy of the folder, so that the program that people
run carries no counter. Each line must be there once: tests/experiments/counting_test.py.
"""
import pathlib
import shutil

KERNELS = pathlib.Path(__file__).resolve().parents[2] / "kernels"
MOST = 4 * (4 + 2)  # texels: of four lookups, one pair of them in two levels

# File -> [(lines, what takes their place)].
REPLACED = {
    "lib/surface/texture.cl": [
        ("  Rgba sum = {{(Real)(0.0f), (Real)(0.0f), (Real)(0.0f), (Real)(0.0f)}};\n",
         "  Real texels = (Real)(0.0f);\n  Rgba sum = {{texels, texels, texels, texels}};\n"),
        ("    const int both = some(isBoth);\n",
         "    const int both = some(isBoth);\n"
         "    texels += (asked ? (Real)(4.0f) : (Real)(0.0f)) + (isBoth ? (Real)(4.0f) : (Real)(0.0f));\n"),
        ("  for (uint c = 0; c < 4; ++c) sum.c[c] = sum.c[c] / count;\n",
         "  for (uint c = 0; c < 4; ++c) sum.c[c] = c < 3 ? texels : sum.c[c] / count;\n"),
        ("  return blendQuad(scene, deep, &q, srgb);\n", "  Rgba four = blendQuad(scene, deep, &q, srgb);\n"
         "  for (uint c = 0; c < 3; ++c) four.c[c] = (Real)(4.0f);\n  return four;\n"),
    ],
    # The factor and the vertices' colours are 1; alpha stays, so that cut-outs do.
    "lib/surface/point.cl": [
        ("  for (uint n = 0; n < 4; ++n) color.c[n] = wordOf(&at->material, word + n);\n",
         "  for (uint n = 0; n < 4; ++n) color.c[n] = n < 3 ? (Real)(1.0f) : wordOf(&at->material, word + n);\n"),
        ("  if (scene->colors) {\n", "  if (scene->colors && scene->triangleCount == 0) {\n"),
    ],
}


def replaced(text, pairs, name):
    for lines, others in pairs:
        if text.count(lines) != 1:
            raise ValueError(f"{name} has {text.count(lines)} times: {lines.strip()}")
        text = text.replace(lines, others)
    return text


def countingKernels(folder):
    """Writes them into `folder`, and returns it."""
    shutil.copytree(KERNELS, folder)
    for name, pairs in REPLACED.items():
        file = folder / name
        file.write_text(replaced(file.read_text(), pairs, name))
    return folder
