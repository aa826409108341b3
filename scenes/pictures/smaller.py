#!/usr/bin/python3
"""A picture as a .jpg that a repository can keep.

usage: scenes/pictures/smaller.py PICTURE.png PICTURE.jpg
needs: Debian's python3-openimageio; /usr/bin/python3
"""
import sys

import OpenImageIO as oiio

QUALITY = 82  # of 100; edges of neon and chrome show no blocks at full size

picture = oiio.ImageBuf(sys.argv[1])
picture.specmod().attribute("Compression", f"jpeg:{QUALITY}")
if not picture.write(sys.argv[2]):
    sys.exit(f"{sys.argv[2]}: {picture.geterror()}")
