"""The compiled twin of the kernel in `certificate`."""

from array import array

from cpython.mem cimport PyMem_Free, PyMem_Malloc, PyMem_Realloc
from libc.math cimport fabs

cdef enum:
    MOST_POINTS = 4
    MANY_CORNERS = 8  # as in `free_space`

cdef double INSIDE_M = 1e-9  # as in `certificate`


cdef struct Wall:
    double n_u, n_v, most_m
    bint is_square


cdef class Track:
    cdef readonly object stance
    cdef object rotation_xyzw
    cdef bint is_upright, stands
    cdef int up, flat, n_points
    cdef double u0, v0, u1, v1, lowest, highest, middle_m, top_m, least_m, most_m
    # n_u, n_v and offset of each edge, one after the other.
    cdef double* edges
    cdef Py_ssize_t n_edges
    cdef Wall* walls
    cdef Py_ssize_t n_walls
    # At the present rotation: AABB, footprint and base face, relative to the body's position.
    cdef double low[3]
    cdef double high[3]
    cdef double a_u, a_v, half_1, half_2, reach_m
    cdef double base_face, mu, mv, radius
    cdef double pu[MOST_POINTS]
    cdef double pv[MOST_POINTS]
    # In the shape's frame, along the two axes that are level while it is upright: box middle and half edges; base face.
    cdef double box_u, box_v, half_u, half_v, own_u, own_v
    cdef double own_pu[MOST_POINTS]
    cdef double own_pv[MOST_POINTS]
    # Outline of the base face, computed on first use. If upright, it is in the shape's frame; these numbers rotate it.
    cdef double[:, ::1] outline
    cdef double turned_a, turned_c

    def __init__(self, stance, standing):
        cdef Py_ssize_t k
        self.up, self.flat = stance.up_axis, stance.v_axis
        self.stands = standing is not None
        if self.stands:
            edges, self.top_m, self.least_m, self.most_m, self.middle_m = standing
            self.edges = <double*>PyMem_Malloc(3 * len(edges) * sizeof(double))
            if self.edges is NULL:
                raise MemoryError
            self.n_edges = len(edges)
            for k in range(self.n_edges):
                self.edges[3 * k], self.edges[3 * k + 1], self.edges[3 * k + 2] = edges[k]
        self.stand(stance)

    def __dealloc__(self):
        PyMem_Free(self.edges)
        PyMem_Free(self.walls)

    def keep_in(self, rectangle, heights, walls):
        cdef Wall* larger
        cdef Py_ssize_t k
        self.u0, self.v0, self.u1, self.v1 = rectangle
        self.lowest, self.highest = heights
        if len(walls) > self.n_walls:
            larger = <Wall*>PyMem_Realloc(self.walls, len(walls) * sizeof(Wall))
            if larger is NULL:
                raise MemoryError
            self.walls = larger
        self.n_walls = len(walls)
        for k in range(self.n_walls):
            self.walls[k].n_u, self.walls[k].n_v, self.walls[k].most_m, self.walls[k].is_square = walls[k]

    cdef stand(self, stance):
        """Copy the data of a stance."""
        cdef int k
        self.stance, self.rotation_xyzw = stance, stance.rotation_xyzw
        self.is_upright = upright(self.rotation_xyzw, self.up)
        for k in range(3):
            self.low[k], self.high[k] = stance.low[k], stance.high[k]
        self.a_u, self.a_v, self.half_1, self.half_2, self.reach_m = stance.footprint
        if self.is_upright:
            self.box_u, self.box_v = stance.shape.middle[0], stance.shape.middle[self.flat]
            self.half_u, self.half_v = stance.shape.half[0], stance.shape.half[self.flat]
        self.outline = None
        if not self.stands:
            return
        points, self.base_face, (self.mu, self.mv), self.radius, _ = stance.posed_base_face
        self.n_points = len(points)
        for k in range(self.n_points):
            self.pu[k], self.pv[k] = points[k]
        if self.is_upright:
            base_face = stance.shape.base_face(stance.way_up)
            self.own_u, self.own_v = base_face.middle_m[0], base_face.middle_m[self.flat]
            for k in range(self.n_points):
                self.own_pu[k], self.own_pv[k] = base_face.points_m[k][0], base_face.points_m[k][self.flat]
            self.turned_a, self.turned_c = turning(self.rotation_xyzw, self.up)
        else:
            self.turned_a, self.turned_c = 1, 0

    cdef bint turn(self, rotation_xyzw) except -1:
        """Rotate the body, bit-identical to `Stance`. Returns False if a resting body's upward direction changes."""
        cdef double y, z, a, c, u, v, over, across
        cdef int k
        if not (self.is_upright and upright(rotation_xyzw, self.up)):
            turned = self.stance.turned(rotation_xyzw)
            if self.stands and turned.way_up != self.stance.way_up:
                return False
            self.stand(turned)
            return True
        # A rotation about the vertical changes no height, and half of its products are 0.
        a, c = turning(rotation_xyzw, self.up)
        self.turned_a, self.turned_c = a, c
        self.a_u, self.a_v = a, -c
        u, v = a * self.box_u + c * self.box_v, a * self.box_v - c * self.box_u
        over, across = fabs(a), fabs(c)
        y, z = over * self.half_u + across * self.half_v, across * self.half_u + over * self.half_v
        self.low[0], self.low[self.flat], self.high[0], self.high[self.flat] = u - y, v - z, u + y, v + z
        self.rotation_xyzw = rotation_xyzw
        if not self.stands:
            return True
        self.mu, self.mv = a * self.own_u + c * self.own_v, a * self.own_v - c * self.own_u
        for k in range(self.n_points):
            self.pu[k] = a * self.own_pu[k] + c * self.own_pv[k]
            self.pv[k] = a * self.own_pv[k] - c * self.own_pu[k]
        return True

    def moved(self, tuple position_m, tuple rotation_xyzw):
        cdef double low[3]
        cdef double high[3]
        cdef double x, y, z, h, u, v, fall_m, cu, cv, height
        cdef int k
        if rotation_xyzw is not self.rotation_xyzw and rotation_xyzw != self.rotation_xyzw:
            if not self.turn(rotation_xyzw):
                return None
        x, y, z = position_m
        low[0], low[1], low[2] = x + self.low[0], y + self.low[1], z + self.low[2]
        high[0], high[1], high[2] = x + self.high[0], y + self.high[1], z + self.high[2]
        if low[0] < self.u0 or high[0] > self.u1 or low[self.flat] < self.v0 or high[self.flat] > self.v1:
            return None
        if low[self.up] < self.lowest or high[self.up] > self.highest:
            return None
        h, u, v = (y, x, z) if self.up == 1 else (z, x, y)
        cu, cv = u + (self.low[0] + self.high[0]) / 2, v + (self.low[self.flat] + self.high[self.flat]) / 2
        if not self.is_behind(cu, cv):
            return None
        if not self.stands:
            return (low[0], low[1], low[2]), (high[0], high[1], high[2]), ()
        fall_m = h + self.base_face - self.top_m
        if low[self.up] + high[self.up] <= self.middle_m or not self.least_m < fall_m < self.most_m:
            return None
        cu, cv = self.mu + u, self.mv + v
        for k in range(self.n_edges):
            if self.inside(k, cu, cv) < self.radius:
                if not self.is_inside(u, v):
                    return None
                break
        height = (h + self.base_face + self.top_m) / 2
        if self.up == 1:
            places = tuple([(u + self.pu[k], height, v + self.pv[k]) for k in range(self.n_points)])
        else:
            places = tuple([(u + self.pu[k], v + self.pv[k], height) for k in range(self.n_points)])
        return (low[0], low[1], low[2]), (high[0], high[1], high[2]), places

    cdef bint is_behind(self, double u, double v) noexcept:
        """Return True if the footprint, with its middle at (u, v), is behind all walls."""
        cdef Py_ssize_t k
        cdef double n_u, n_v, reach_m
        for k in range(self.n_walls):
            n_u, n_v = self.walls[k].n_u, self.walls[k].n_v
            reach_m = fabs(n_u * self.a_u + n_v * self.a_v) * self.half_1
            reach_m = reach_m + fabs(n_v * self.a_u - n_u * self.a_v) * self.half_2
            if not self.walls[k].is_square and reach_m > self.reach_m:
                reach_m = self.reach_m
            if n_u * u + n_v * v + reach_m > self.walls[k].most_m:
                return False
        return True

    cdef bint is_inside(self, double u, double v) except -1:
        """Return True if the outline of the base face is surely inside all edges. Called only if its circle is not."""
        cdef Py_ssize_t i, k
        cdef double pu, pv, a = self.turned_a, c = self.turned_c
        if self.outline is None:
            if self.is_upright:
                corners = [(x[0], x[self.flat]) for x in self.stance.shape.base_face(self.stance.way_up).outline_m]
            else:
                corners = self.stance.base_outline
            numbers = array("d", [number for corner in corners for number in corner])
            self.outline = memoryview(numbers).cast("B").cast("d", (len(corners), 2))
        if self.outline.shape[0] > MANY_CORNERS:
            return False
        for i in range(self.outline.shape[0]):
            pu = u + a * self.outline[i, 0] + c * self.outline[i, 1]
            pv = v + a * self.outline[i, 1] - c * self.outline[i, 0]
            for k in range(self.n_edges):
                if self.inside(k, pu, pv) < INSIDE_M:
                    return False
        return True

    cdef double inside(self, Py_ssize_t k, double u, double v) noexcept:
        """Return how far inside an edge a point is."""
        return self.edges[3 * k] * u + self.edges[3 * k + 1] * v - self.edges[3 * k + 2]


cdef (double, double) turning(tuple rotation_xyzw, int up) except *:
    """Return the first row (a, c) of a rotation about the vertical, in the level plane."""
    cdef double y, z, w
    _, y, z, w = rotation_xyzw
    if up == 1:
        return 1 - 2 * (y * y), 2 * (y * w)
    return 1 - 2 * (z * z), -2 * (z * w)


cdef bint upright(tuple rotation_xyzw, int up) except -1:
    """Return True if a rotation is about the vertical."""
    cdef double x, y, z
    x, y, z, _ = rotation_xyzw
    return x == 0 and (z if up == 1 else y) == 0
