"""Height fields of exactly n triangles, as .glb: the camera, lights and material of scenes/height_field.glb, and the
same square of ground, whatever n.

Lines of vertices run across the square; neighbouring lines may have different numbers of segments, and between two of
them lies one triangle for each segment of both. So every count can be met, without holes.
"""
import json
import math
import struct

import numpy

SIDE = 16.0  # metres, as in the generator


def segments(triangles):
    """Segments of each line: those of inner lines count twice, as they border two rows."""
    rows = max(1, round(math.sqrt(triangles / 2)))
    base, rest = divmod(triangles, 2 * rows)
    line = [base] * (rows + 1)
    line[0] += rest % 2
    for i in range(rest // 2):
        line[1 + i] += 1
    return line


def sideIndices(near, far, startNear, startFar):
    """Triangles between two lines of vertices: whichever line lags behind takes the next step."""
    a, b, found = 0, 0, []
    while a < near or b < far:
        if b == far or (a < near and (a + 1) * far <= (b + 1) * near):
            found.append((startNear + a, startFar + b, startNear + a + 1))
            a += 1
        else:
            found.append((startNear + a, startFar + b, startFar + b + 1))
            b += 1
    return found


def hills(x, z, seed):
    """Three waves in directions and phases of the seed; metres above 0 and slopes."""
    random = numpy.random.default_rng(seed)
    height, slopeX, slopeZ = 1.2 * numpy.ones_like(x), numpy.zeros_like(x), numpy.zeros_like(x)
    for amplitude, frequency in ((0.5, 0.4), (0.25, 0.9), (0.12, 1.9)):
        angle, phase = random.uniform(0, 2 * math.pi, 2)
        u, v = frequency * math.cos(angle), frequency * math.sin(angle)
        height = height + amplitude * numpy.sin(u * x + v * z + phase)
        slopeX = slopeX + amplitude * u * numpy.cos(u * x + v * z + phase)
        slopeZ = slopeZ + amplitude * v * numpy.cos(u * x + v * z + phase)
    return height, slopeX, slopeZ


def mesh(triangles, seed):
    """Positions, normals [v, 3] and indices [triangles, 3]."""
    lines, x, z, indices, starts = segments(triangles), [], [], [], []
    for row, count in enumerate(lines):
        starts.append(len(x))
        x += [SIDE * (k / count - 0.5) for k in range(count + 1)] if count else [0.0]
        z += [SIDE * (row / (len(lines) - 1) - 0.5)] * (count + 1)
    for row in range(len(lines) - 1):
        # The farther line has the smaller z; seen from above, fronts run anticlockwise.
        indices += sideIndices(lines[row], lines[row + 1], starts[row], starts[row + 1])
    x, z = numpy.array(x), numpy.array(z)
    y, slopeX, slopeZ = hills(x, z, seed)
    normals = numpy.stack([-slopeX, numpy.ones_like(x), -slopeZ], axis=1)
    normals /= numpy.linalg.norm(normals, axis=1, keepdims=True)
    return numpy.stack([x, y, z], axis=1).astype("<f4"), normals.astype("<f4"), numpy.array(indices, "<u4")


def document(template):
    """The JSON chunk of a .glb."""
    data = template.read_bytes()
    return json.loads(data[20:20 + struct.unpack_from("<I", data, 12)[0]])


def write(file, template, triangles, seed):
    """The template's scene with its mesh replaced."""
    positions, normals, indices = mesh(triangles, seed)
    arrays = [positions, normals, indices]
    glTF, offset = document(template), 0
    for view, accessor, array in zip(glTF["bufferViews"], glTF["accessors"], arrays):
        view.update(byteOffset=offset, byteLength=array.nbytes)
        accessor["count"] = array.size if array is indices else len(array)
        if array is not indices:
            accessor.update(min=array.min(axis=0).tolist(), max=array.max(axis=0).tolist())
        offset += array.nbytes
    glTF["accessors"][2]["componentType"] = 5125  # unsigned int
    glTF["buffers"][0]["byteLength"] = offset
    text = json.dumps(glTF).encode()
    text += b" " * (-len(text) % 4)
    binary = b"".join(a.tobytes() for a in arrays)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(binary), 0x004E4942) + binary
    file.write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks)
    return file
