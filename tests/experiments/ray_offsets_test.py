"""The other ray offsets that experiments/ray_offset measures fit the kernels: what they include is there, and they
define the functions that they replace. Reads the files, compiles none of them."""
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
DEFAULT = "default_ray_offset.cl"  # the kernels' own file, put beside it under another name
OTHERS = sorted((ROOT / "experiments" / "ray_offset" / "ray_offsets").glob("*.cl"))


def functions(text):
    return set(re.findall(r"^INLINE \w+ (\w+)\(", text, re.MULTILINE))


class RayOffsets(unittest.TestCase):
    def setUp(self):
        found = list((ROOT / "kernels").rglob("ray_offset.cl"))
        self.assertEqual(len(found), 1)
        self.own, self.beside = found[0].read_text(), found[0].with_name(DEFAULT)

    def test_there_are_some(self):
        self.assertEqual(len(OTHERS), 4)
        self.assertIn("offsetOrigin", functions(self.own))

    def test_what_they_include_is_there(self):
        for file in OTHERS:
            for name in re.findall(r'#include "([^"]+)"', file.read_text()):
                place = ROOT / "kernels" / name
                self.assertTrue(place == self.beside or place.is_file(), f"{file.name} includes {name}")

    def test_they_replace_all_of_it(self):
        for file in OTHERS:
            text = file.read_text()
            given = functions(text) | (functions(self.own) if DEFAULT in text else set())
            self.assertLessEqual(functions(self.own), given, file.name)

    def test_members_of_the_constants_are_those_of_the_kernels(self):
        for file in OTHERS:
            for member in re.findall(r"constants->(\w+)", file.read_text()):
                self.assertIn(f"constants->{member}", self.own, file.name)


if __name__ == "__main__":
    unittest.main()
