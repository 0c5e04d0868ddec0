#!/usr/bin/env python3
"""The checks of the animated layers must pass a sound movement and name an unsound one."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "scenes"))

from scenegen import check_motion, office, small  # noqa: E402
from scenegen.layer import Layer  # noqa: E402
from scenegen.motion import Curve, ease, stroll  # noqa: E402


def moved(scene, name, step, frames=4):
    """Complaints about an object that goes a step a frame."""
    layer = Layer("test", scene, frames, 24, "")
    at = scene.find(name).at
    for frame in layer.frames:
        layer.pose(name, frame, [c + s * (frame - 1) for c, s in zip(at, step)])
    return check_motion.complaints(layer)


class CheckMotion(unittest.TestCase):
    def test_passes_what_stays_on_the_floor_and_clear_of_all(self):
        self.assertEqual(moved(small.chamber(), "LowBox", (0, -0.05, 0)), [])

    def test_names_what_is_pushed_into_something(self):
        found = moved(small.chamber(), "RedBox", (0.15, 0, 0))
        self.assertIn("test, frame 4: RedBox and Gem interpenetrate", found)
        found = moved(office.build(), "Seat", (-0.05, 0.14, 0), frames=6)
        self.assertTrue(any("Seat and Desk1 interpenetrate" in text for text in found), found)

    def test_names_what_leaves_the_floor(self):
        found = moved(small.chamber(), "LowBox", (0, 0, 0.01))
        self.assertIn("test, frame 2: LowBox touches nothing", found)

    def test_names_jumps_and_gaps(self):
        self.assertIn("test: LowBox: goes 0.20 m from frame 1 to 2",
                      moved(small.chamber(), "LowBox", (0, -0.2, 0), frames=2))
        layer = Layer("test", small.chamber(), 3, 24, "")
        for frame in (1, 3):
            layer.pose("LowBox", frame, layer.base.find("LowBox").at)
        self.assertEqual(check_motion.complaints(layer),
                         ["test: LowBox: has frames without a place"])

    def test_names_what_people_may_not_move(self):
        found = moved(small.chamber(), "Room", (0, 0, 0), frames=1)
        self.assertIn("test: Room moves but is not movable in chamber", found)


class Motion(unittest.TestCase):
    def test_goes_from_rest_to_rest(self):
        for pace in (ease, stroll):
            self.assertEqual((pace(0), pace(1)), (0, 1))
            self.assertAlmostEqual(pace(0.5), 0.5)
            self.assertLess(pace(0.01), 0.001)
            self.assertGreater(pace(0.99), 0.999)

    def test_a_curve_goes_through_its_points_at_an_even_pace(self):
        curve = Curve((0, 0, 0), (1, 0, 0), (3, 0, 0), (4, 0, 0))
        for share in (0, 0.125, 0.25, 0.5, 0.75, 1):
            x, y, z = curve.at(share)
            self.assertAlmostEqual(x, 4 * share, places=3)
            self.assertEqual((y, z), (0, 0))


if __name__ == "__main__":
    unittest.main()
