"""The compiled twin of the kernel in `motion_track`."""

cdef enum:
    NO_STEP = 0  # as in `motion_track`, like all constants here
    STEADY = 1
    CHANGED = 2
    ABRUPT = 3
    MOST_STEPS = 8

cdef double LEFT = 0.3
cdef double LONGEST_GAP_S = 0.12
cdef double GAP_DECAYS = 0.1
cdef double UNEVEN = 3
cdef double JUMP = 10.0
cdef double JUMP_M_S2 = 30.0
cdef double SUDDEN = ((1 - 0.3) * 0.5) ** 2
cdef double LEAST_CHANGE = SUDDEN * (0.004 / MOST_STEPS) ** 2


cdef struct Vector:
    double x, y, z


cdef class Motion:
    cdef readonly list steps
    cdef readonly object pose, own_m
    cdef readonly double gap, far_m2
    cdef readonly Py_ssize_t since, n_steps
    cdef readonly bint goes_on
    cdef object next_pose, rotation_xyzw
    cdef Vector own, middle, origin, step, stopped, next_step, next_middle
    cdef bint is_unconfirmed

    def __init__(self, Py_ssize_t update, double time_s, pose, tuple own_m):
        self.steps = [(update, time_s, pose)]
        self.pose, self.own_m, self.rotation_xyzw = pose, own_m, pose.rotation_xyzw
        self.own.x, self.own.y, self.own.z = own_m
        self.gap = 1.0
        self.middle = self.in_world(pose)
        self.turn(update)

    @property
    def step_m(self):
        return self.step.x, self.step.y, self.step.z

    @property
    def next_m(self):
        return self.next_step.x, self.next_step.y, self.next_step.z

    cpdef turn(self, Py_ssize_t update):
        self.since, self.n_steps, self.far_m2 = update, 0, 0.0
        self.step = Vector(0, 0, 0)
        self.origin = self.middle

    def land(self, Py_ssize_t update):
        self.is_unconfirmed = self.latest()[0] != update
        self.stopped = self.step
        self.turn(update)

    def meet(self, Py_ssize_t update):
        cdef Vector step = self.step
        self.turn(update)
        self.step = step

    def look(self, pose):
        cdef double x, y, z, u, v, w, change
        self.next_step = Vector(0, 0, 0)
        if pose is None:
            return NO_STEP
        rotation_xyzw = pose.rotation_xyzw
        if rotation_xyzw is not self.rotation_xyzw and rotation_xyzw != self.rotation_xyzw:
            self.next_middle = self.in_world(pose)
            self.next_step = minus(self.next_middle, self.middle)
        else:
            x, y, z = <tuple>pose.position_m
            u, v, w = <tuple>self.pose.position_m
            x, y, z = x - u, y - v, z - w
            if not (x or y or z):
                return NO_STEP
            self.next_middle = Vector(self.middle.x + x, self.middle.y + y, self.middle.z + z)
            self.next_step = Vector(x, y, z)
        self.next_pose = pose
        change = squared(minus(self.next_step, self.step))
        if change < LEAST_CHANGE:
            return STEADY
        return ABRUPT if change >= SUDDEN * squared(self.step) else CHANGED

    def follow(self, Py_ssize_t update, double time_s):
        cdef Py_ssize_t last, waited
        cdef double last_s, onward, before, here, gap, far_m2
        cdef bint turns
        last, last_s, _ = self.latest()
        waited = update - last
        if waited > 1 and time_s - last_s > LONGEST_GAP_S:
            self.turn(last)
            self.gap, self.goes_on = 1.0, False
        else:
            onward, before, here = dot(self.next_step, self.step), squared(self.step), squared(self.next_step)
            gap = self.gap - GAP_DECAYS
            if LEFT * before < onward < before / LEFT:
                gap = min(max(gap, <double>waited), UNEVEN * waited)
            self.gap = gap if gap > 1.0 else 1.0
            turns = onward <= 0 or (self.n_steps == 1 and JUMP * onward < before)
            if turns or (here > JUMP * JUMP * before and self.jumps(here, before, time_s - last_s)):
                self.turn(last)
                onward, before = dot(self.next_step, self.stopped), squared(self.stopped)
                self.goes_on = self.is_unconfirmed and onward > LEFT * before
        self.is_unconfirmed = False
        self.pose, self.middle, self.step = self.next_pose, self.next_middle, self.next_step
        self.rotation_xyzw = self.pose.rotation_xyzw
        self.n_steps += 1
        far_m2 = squared(minus(self.middle, self.origin))
        if far_m2 > self.far_m2:
            self.far_m2 = far_m2
        self.steps.append((update, time_s, self.pose))
        if len(self.steps) > 4 * MOST_STEPS:
            del self.steps[: len(self.steps) - 2 * MOST_STEPS]

    cdef tuple latest(self):
        return self.steps[len(self.steps) - 1]

    cdef bint jumps(self, double here, double before, double lasts_s) except -1:
        """Return True if a step is a jump, by its square, that of the step before [m2] and its duration."""
        cdef double lasted_s = 0.0, longer = JUMP, jump_m = JUMP_M_S2 * lasts_s * lasts_s
        if len(self.steps) > 1:
            lasted_s = <double>self.latest()[1] - <double>self.steps[len(self.steps) - 2][1]
        if lasted_s > 0:
            longer = JUMP * max(1.0, lasts_s / lasted_s)
        return here > longer * longer * before and here > jump_m * jump_m > 0

    cdef Vector in_world(self, pose) except *:
        """Return the middle of the box at a pose, as `pose.in_world`."""
        cdef double u, v, w, x, y, z, s, d, e, f, a = self.own.x, b = self.own.y, c = self.own.z
        u, v, w = <tuple>pose.position_m
        if not (a or b or c):
            return Vector(u, v, w)
        x, y, z, s = <tuple>pose.rotation_xyzw
        d, e, f = 2 * (y * c - z * b), 2 * (z * a - x * c), 2 * (x * b - y * a)
        return Vector(u + a + s * d + y * f - z * e, v + b + s * e + z * d - x * f, w + c + s * f + x * e - y * d)


cdef Vector minus(Vector one, Vector other) noexcept:
    return Vector(one.x - other.x, one.y - other.y, one.z - other.z)


cdef double dot(Vector one, Vector other) noexcept:
    return one.x * other.x + one.y * other.y + one.z * other.z


cdef double squared(Vector one) noexcept:
    return dot(one, one)
