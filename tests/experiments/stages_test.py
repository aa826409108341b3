"""What experiments/lib/stages.py reads off the statistics: job and program from their own keys, and from the list of
older kernels only where these are missing."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "experiments"))

from lib import stages  # noqa: E402


def kernel(name, **facts):
    return {"name": name, "launches": 1, "seconds": 0.5, "items": 10, "bytes": 4, **facts}


class Jobs(unittest.TestCase):
    def test_the_statistics_say_what_a_kernel_does(self):
        found = stages.grouped([kernel("sort_keys", job="sort", program="queues"),
                                kernel("sort_rays", job="sort", program="queues")])
        self.assertEqual(dict(found), {"sort": {"program": "queues", "launches": 2, "seconds": 1.0, "items": 20,
                                                "bytes": 8}})

    def test_statistics_of_older_runs_say_nothing(self):
        found = stages.grouped([kernel("compact_count"), kernel("scan_chunks"), kernel("shade"), kernel("shade_light"),
                                kernel("unheard_of")])
        self.assertEqual({job: s["items"] for job, s in found.items()}, {"compact": 10, "shade": 20, "unheard_of": 10})

    def test_bounces_have_the_facts_of_the_whole_frame(self):
        stats = {"stages": [kernel("walk", job="hits", program="searches")],
                 "bounces": [{"bounce": 1, "stages": [kernel("walk")]}]}
        self.assertEqual(stages.byBounce(stats)[1]["hits"]["program"], "searches")
        self.assertEqual(stages.searchSeconds(stats), 0.5)

    def test_searches_are_those_of_that_program(self):
        self.assertTrue(stages.isSearch({"stage": "intersect"}))
        self.assertTrue(stages.isSearch({"stage": "new", "program": "searches"}))
        self.assertFalse(stages.isSearch({"stage": "shade", "program": ""}))

    def test_order_is_from_the_eye_to_the_film(self):
        rows = [{"stage": s} for s in ("raygen", "sort", "shade", "film", "accumulate", "raygen", "film")]
        self.assertEqual(stages.order(rows), ["raygen", "sort", "shade", "accumulate", "film", "host"])


if __name__ == "__main__":
    unittest.main()
