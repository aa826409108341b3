"""Imports of experiments/ go down only: an experiment imports its own folder, peers/ and lib/; peers/ imports lib/;
lib/ imports nothing of the others; and no module imports itself by way of others. Reads the files, runs none of them.
"""
import ast
import pathlib
import unittest

EXPERIMENTS = pathlib.Path(__file__).resolve().parents[2] / "experiments"
FOLDERS = sorted(f.name for f in EXPERIMENTS.iterdir() if f.is_dir() and any(f.glob("*.py")))
SHARED = {"lib": {"lib"}, "peers": {"lib", "peers"}}


def modules():
    """"lib.fit" -> its file."""
    return {f"{folder}.{file.stem}": file for folder in FOLDERS for file in sorted((EXPERIMENTS / folder).glob("*.py"))}


def imported(file, known):
    """Our own modules that a file imports, at its head or within a function."""
    found = set()
    for node in ast.walk(ast.parse(file.read_text())):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            found |= {node.module} | {f"{node.module}.{alias.name}" for alias in node.names}
    return {name for name in found if name in known}


def circle(graph, start):
    """A way from a module back to itself, or None."""
    waiting, seen = [(start, (start,))], set()
    while waiting:
        at, way = waiting.pop()
        for to in sorted(graph[at]):
            if to == start:
                return (*way, to)
            if to not in seen:
                seen.add(to)
                waiting.append((to, (*way, to)))
    return None


class Imports(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        known = modules()
        cls.graph = {name: imported(file, known) for name, file in known.items()}

    def test_imports_are_seen_at_all(self):
        self.assertIn("lib.style", self.graph["e1_triangles.e1_triangles"])
        self.assertEqual(circle({"a": {"b"}, "b": {"c"}, "c": {"a"}}, "a"), ("a", "b", "c", "a"))

    def test_there_is_no_circle(self):
        for name in self.graph:
            self.assertIsNone(circle(self.graph, name))

    def test_they_go_down(self):
        for name, others in self.graph.items():
            folder = name.split(".")[0]
            allowed = SHARED.get(folder, {"lib", "peers", folder})
            for other in others:
                self.assertIn(other.split(".")[0], allowed, f"{name} imports {other}")


if __name__ == "__main__":
    unittest.main()
