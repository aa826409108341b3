"""Writes one of our scenes for other renderers.

The same triangles, lights, camera and depth, so that they do the same work.

usage: experiments/run export_scene -- SCENE.glb [--povray FILE.pov] [--blender FILE.py] [--bounces N]
       povray +IFILE.pov +WT2 -A +FE Declare=Bounces=8   (one ray for each pixel; see peers/povray.py for the units)
       blender --background --factory-startup --python FILE.py -- OUT.exr WIDTH HEIGHT THREADS BOUNCES SAMPLES
needs: Debian's python3-numpy; povray and blender only to render what was written
"""
import argparse
import sys

from peers import cycles, gltf, povray


def main(arguments):
    parser = argparse.ArgumentParser(prog="experiments/run export_scene --", description=__doc__.split("\n")[0])
    parser.add_argument("scene", help="a GLB")
    parser.add_argument("--povray", metavar="FILE.pov", help="scene description for POV-Ray 3.7")
    parser.add_argument("--blender", metavar="FILE.py", help="script for Blender 3.4; its arrays go to FILE.npz")
    parser.add_argument("--bounces", type=int, default=8, help="default depth in FILE.pov")
    a = parser.parse_args(arguments)
    if not (a.povray or a.blender):
        parser.error("nothing to write: give --povray FILE.pov or --blender FILE.py")
    try:
        scene = gltf.load(a.scene)
        for what in scene.ignored:
            print(f"{a.scene}: {what} left out", file=sys.stderr)
        if a.povray:
            povray.write(scene, a.povray, a.bounces)
        if a.blender:
            cycles.write(scene, a.blender)
    except (OSError, gltf.SceneError) as problem:
        print(problem, file=sys.stderr)
        return 2
    return 0
