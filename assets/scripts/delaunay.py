"""Delaunay triangulation in the plane (Bowyer and Watson, with a walk to find each point's triangle)."""


def triangulate(points):
    """Triangles (a, b, c), counter-clockwise, over points (x, y) of about unit size and no two the same."""
    count = len(points)
    mesh = _Triangulation(list(points) + [(-3e3, -3e3), (3e3, -3e3), (0.0, 3e3)], count)
    for p in sorted(range(count), key=lambda k: _serpentine(points[k])):
        mesh.insert(p)
    return sorted(_lowest_first(t) for t in mesh.corners.values() if max(t) < count)


def _serpentine(point, rows=40):
    """Neighbours in this order lie near each other, so the walk from one to the next is short."""
    row = int(point[1] * rows)
    return row, point[0] if row % 2 == 0 else -point[0]


def _lowest_first(triangle):
    k = triangle.index(min(triangle))
    return triangle[k:] + triangle[:k]


class _Triangulation:
    """corners[t] = (a, b, c); beyond[t][k] = the triangle across the edge opposite corner k, or None."""

    def __init__(self, points, first):
        self.points = points
        self.corners = {0: (first, first + 1, first + 2)}
        self.beyond = {0: [None, None, None]}
        self.latest = 0
        self.next = 1

    def insert(self, p):
        cavity = self.cavity_of(p)
        rim = [(t, k) for t in cavity for k in range(3) if self.beyond[t][k] not in cavity]
        fan = {}
        for t, k in rim:
            a, b = self.corners[t][(k + 1) % 3], self.corners[t][(k + 2) % 3]
            outside = self.beyond[t][k]
            new, self.next = self.next, self.next + 1
            self.corners[new] = (p, a, b)
            self.beyond[new] = [outside, None, None]
            if outside is not None:
                self.beyond[outside][self.beyond[outside].index(t)] = new
            fan[a] = new
        for a, t in fan.items():
            after = fan[self.corners[t][2]]
            self.beyond[t][1], self.beyond[after][2] = after, t
            self.latest = t
        for t in cavity:
            del self.corners[t], self.beyond[t]

    def cavity_of(self, p):
        """All triangles whose circumcircle holds p; they hang together."""
        start = self.walk_to(p)
        cavity, open_ = {start}, [start]
        while open_:
            for t in self.beyond[open_.pop()]:
                if t is not None and t not in cavity and self.in_circle(t, p):
                    cavity.add(t)
                    open_.append(t)
        return cavity

    def walk_to(self, p):
        t = self.latest
        while True:
            corner = self.corners[t]
            for k in range(3):
                if self.side(corner[(k + 1) % 3], corner[(k + 2) % 3], p) < 0.0:
                    t = self.beyond[t][k]
                    break
            else:
                return t

    def side(self, a, b, p):
        (ax, ay), (bx, by), (px, py) = self.points[a], self.points[b], self.points[p]
        return (bx - ax) * (py - ay) - (by - ay) * (px - ax)

    def in_circle(self, t, p):
        px, py = self.points[p]
        (ax, ay), (bx, by), (cx, cy) = ((self.points[k][0] - px, self.points[k][1] - py) for k in self.corners[t])
        return ((ax * ax + ay * ay) * (bx * cy - cx * by) - (bx * bx + by * by) * (ax * cy - cx * ay)
                + (cx * cx + cy * cy) * (ax * by - bx * ay)) > 0.0
