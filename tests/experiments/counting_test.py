"""The kernels that count texels (experiments/textures/counting.py) fit the project's own: each line that they replace is
there once. Compiles none of them."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "experiments"))

from textures import counting  # noqa: E402


class Counting(unittest.TestCase):
    def test_what_is_replaced_is_there(self):
        for name, pairs in counting.REPLACED.items():
            own = (counting.KERNELS / name).read_text()
            self.assertNotEqual(counting.replaced(own, pairs, name), own)

    def test_what_is_not_there_is_said(self):
        with self.assertRaisesRegex(ValueError, "texture.cl has 0 times: b"):
            counting.replaced("a\n", [("  b\n", "c\n")], "texture.cl")


if __name__ == "__main__":
    unittest.main()
