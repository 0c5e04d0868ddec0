"""How people move things: eased in time, rounded in space."""

from . import vec


def ease(t):
    """Share of the way done at share t of the time: the smoothest motion from rest to rest, which
    is how hands move things (minimum jerk) [FlashHogan1985]. Before and after it rests."""
    t = min(max(t, 0.0), 1.0)
    return t * t * t * (10 + t * (6 * t - 15))


def stroll(t, ramp=0.15):
    """The same for walking: an even pace, with a ramp at both ends as a share of the time."""
    t = min(max(t, 0.0), 1.0)
    if t > 0.5:
        return 1 - stroll(1 - t, ramp)
    return (t * t / (2 * ramp) if t < ramp else t - ramp / 2) / (1 - ramp)


def between(frame, first, last):
    """Share of a movement done at a frame, if it begins at the first and ends at the last."""
    return ease((frame - first) / (last - first))


def blend(a, b, t):
    return a + (b - a) * t


class Curve:
    """Smooth path through points [CatmullRom1974], walked by its length."""

    STEPS = 64   # chords a span by which its length is told

    def __init__(self, *points):
        first = vec.sub(vec.mul(points[0], 2), points[1])
        last = vec.sub(vec.mul(points[-1], 2), points[-2])
        self.points = [first, *points, last]
        spans = len(points) - 1
        self.table = [(0.0, 0.0)]   # length walked, parameter
        before = self.at_parameter(0.0)
        for k in range(1, spans * self.STEPS + 1):
            here = self.at_parameter(k / self.STEPS)
            walked = self.table[-1][0] + vec.length(vec.sub(here, before))
            self.table.append((walked, k / self.STEPS))
            before = here

    def at_parameter(self, u):
        k = min(int(u), len(self.points) - 4)
        t = u - k
        a, b, c, d = self.points[k:k + 4]
        weights = ((-t + 2 * t * t - t ** 3) / 2, (2 - 5 * t * t + 3 * t ** 3) / 2,
                   (t + 4 * t * t - 3 * t ** 3) / 2, (t ** 3 - t * t) / 2)
        p = (0.0, 0.0, 0.0)
        for point, weight in zip((a, b, c, d), weights):
            p = vec.add(p, vec.mul(point, weight))
        return p

    def at(self, share):
        """The point at that share of the length."""
        length = share * self.table[-1][0]
        for (l0, u0), (l1, u1) in zip(self.table, self.table[1:]):
            if length <= l1:
                return self.at_parameter(blend(u0, u1, (length - l0) / (l1 - l0)))
        return self.at_parameter(self.table[-1][1])
