"""The compiled twin of the kernel in `contact_paths`."""

from cpython.mem cimport PyMem_Free, PyMem_Malloc, PyMem_Realloc
from libc.math cimport INFINITY, fmax, sqrt
from libc.string cimport memset

cdef double ROUNDED_UP = 1 + 1e-9


cdef struct Edge:
    double x, y, z, crossing_cost
    # Best label in the search with the number `search`.
    double least
    int least_hops
    long long search


cdef struct Entry:
    double x, y, z, cost
    int hops


cdef struct Label:
    double cost
    int hops
    Py_ssize_t k
    void* neighbour


cdef struct Target:
    double x, y, z, radius_m, at_most
    Py_ssize_t row


cdef struct Beside:
    # A neighbour, and a ball around its contact points.
    double x, y, z, radius_m
    bint leads_on  # whether a path may continue through it
    Py_ssize_t row  # of a source, else -1
    void* neighbour


cdef inline double apart(double ax, double ay, double az, double bx, double by, double bz) noexcept nogil:
    ax, ay, az = ax - bx, ay - by, az - bz
    return sqrt(ax * ax + ay * ay + az * az)


cdef inline bint is_beyond(Beside* beside, Edge* at, double cost, double per_m, double limit) noexcept nogil:
    """Whether all contact points of a neighbour are too far away for a cost up to a limit."""
    cdef double metres = apart(at.x, at.y, at.z, beside.x, beside.y, beside.z) - beside.radius_m
    return cost + per_m * metres > limit * ROUNDED_UP


cdef class Object:
    """An object of the network, with its entries in the search with the number `search`."""

    cdef object id
    cdef double per_m
    cdef bint has_cost
    cdef Py_ssize_t row  # of a source, else -1
    cdef dict neighbours
    cdef Beside* around  # neighbours that are sources, or through which a path may continue; in any order
    cdef Py_ssize_t n_around, room_around, n_sources
    cdef Entry* entries
    cdef Py_ssize_t n_entries, room
    cdef long long search
    cdef bint is_ball_known
    cdef double x, y, z, radius_m

    def __dealloc__(self):
        PyMem_Free(self.around)
        PyMem_Free(self.entries)

    cdef int add(self, Neighbour other) except -1:
        cdef Beside* around
        if self.n_around == self.room_around:
            around = <Beside*>PyMem_Realloc(self.around, (2 * self.room_around + 4) * sizeof(Beside))
            if around == NULL:
                raise MemoryError
            self.around, self.room_around = around, 2 * self.room_around + 4
        other.place = self.n_around
        self.around[other.place].neighbour = <void*>other
        self.n_around += 1
        other.enclose()
        return 0

    cdef void drop(self, Neighbour other) noexcept:
        self.n_around -= 1
        self.around[other.place] = self.around[self.n_around]
        (<Neighbour>self.around[other.place].neighbour).place = other.place
        other.place = -1

    cdef int enter(self, Edge* at, double cost, int hops) except -1:
        cdef Entry* entries
        if self.n_entries == self.room:
            entries = <Entry*>PyMem_Realloc(self.entries, (2 * self.room + 4) * sizeof(Entry))
            if entries == NULL:
                raise MemoryError
            self.entries, self.room = entries, 2 * self.room + 4
        self.entries[self.n_entries] = Entry(at.x, at.y, at.z, cost, hops)
        self.n_entries += 1
        return 0

    cdef bint dominates(self, long long search, Edge* at, double cost, int hops) noexcept:
        cdef Py_ssize_t i
        cdef Entry* entry
        if self.search == search:
            for i in range(self.n_entries):
                entry = &self.entries[i]
                if entry.hops <= hops and entry.cost <= cost:
                    if entry.cost + self.per_m * apart(entry.x, entry.y, entry.z, at.x, at.y, at.z) <= cost:
                        return True
        return False

    cdef void find_ball(self) noexcept:
        cdef Neighbour other
        cdef Py_ssize_t k, n = 0
        cdef Edge* at
        self.is_ball_known = True
        self.x = self.y = self.z = self.radius_m = 0
        for other in self.neighbours.values():
            for k in range(other.n):
                at = &other.edges[k]
                self.x, self.y, self.z, n = self.x + at.x, self.y + at.y, self.z + at.z, n + 1
        self.x, self.y, self.z = self.x / n, self.y / n, self.z / n
        for other in self.neighbours.values():
            for k in range(other.n):
                at = &other.edges[k]
                self.radius_m = fmax(self.radius_m, apart(self.x, self.y, self.z, at.x, at.y, at.z))


cdef class Neighbour:
    """The contact points from one object to another."""

    cdef Object out_of, into
    cdef object junction
    cdef Edge* edges
    cdef Py_ssize_t n
    cdef Py_ssize_t place  # index in `out_of.around`, -1 if it is not there

    def __dealloc__(self):
        PyMem_Free(self.edges)

    cdef int allocate(self, Py_ssize_t n) except -1:
        if n != self.n:
            PyMem_Free(self.edges)
            self.n, self.edges = 0, <Edge*>PyMem_Malloc(n * sizeof(Edge))
            if self.edges == NULL:
                raise MemoryError
            self.n = n
        memset(self.edges, 0, n * sizeof(Edge))
        return 0

    cdef void enclose(self) noexcept:
        """Set the ball around the contact points."""
        cdef Beside* ball = &self.out_of.around[self.place]
        cdef Py_ssize_t k
        ball.x = ball.y = ball.z = ball.radius_m = 0
        for k in range(self.n):
            ball.x += self.edges[k].x / self.n
            ball.y += self.edges[k].y / self.n
            ball.z += self.edges[k].z / self.n
        for k in range(self.n):
            ball.radius_m = fmax(
                ball.radius_m, apart(ball.x, ball.y, ball.z, self.edges[k].x, self.edges[k].y, self.edges[k].z)
            )

    cdef int sort_in(self) except -1:
        """Add this neighbour to `out_of.around` if it is a source or a path may continue through it, else drop it."""
        cdef bint leads_on = self.into.has_cost and (
            len(self.into.neighbours) > 1
            or (self.n > 1 and self.out_of.has_cost and self.into.per_m < self.out_of.per_m)
        )
        if leads_on or self.into.row >= 0:
            if self.place < 0:
                self.out_of.add(self)
            self.out_of.around[self.place].leads_on = leads_on
            self.out_of.around[self.place].row = self.into.row
        elif self.place >= 0:
            self.out_of.drop(self)
        return 0


cdef class ContactPaths:
    cdef dict cost_per_m, rows, objects
    cdef list ids
    cdef object crossing_costs
    cdef double least_per_m
    cdef bint is_limited
    cdef int max_hops
    cdef long long search
    cdef Label* labels
    cdef Py_ssize_t n_labels, room
    cdef Target* targets
    cdef Py_ssize_t n_targets
    cdef Py_ssize_t* target_of  # index in `targets` of each source row, -1 if it is no target
    cdef double* found

    def __init__(self, dict cost_per_m, dict rows, crossing_costs, max_hops):
        self.crossing_costs = crossing_costs
        self.is_limited = max_hops is not None
        self.max_hops = min(max_hops, 1 << 30) if self.is_limited else 0
        self.objects = {}
        self.use(cost_per_m, rows)

    def __dealloc__(self):
        PyMem_Free(self.labels)
        self.free_targets()

    cdef void free_targets(self) noexcept:
        PyMem_Free(self.targets)
        PyMem_Free(self.target_of)
        PyMem_Free(self.found)

    def use(self, dict cost_per_m, dict rows):
        cdef Object x
        cdef Neighbour out, back
        cdef bint was_source
        self.cost_per_m, self.rows, self.ids = cost_per_m, rows, list(rows)
        self.least_per_m = min(cost_per_m.values(), default=0.0)
        self.free_targets()
        self.targets = <Target*>PyMem_Malloc((len(rows) + 1) * sizeof(Target))
        self.target_of = <Py_ssize_t*>PyMem_Malloc((len(rows) + 1) * sizeof(Py_ssize_t))
        self.found = <double*>PyMem_Malloc((len(rows) + 1) * sizeof(double))
        if self.targets == NULL or self.target_of == NULL or self.found == NULL:
            raise MemoryError
        for x in self.objects.values():
            was_source = x.row >= 0
            if self.describe(x):
                for out in x.neighbours.values():
                    back = out.into.neighbours[x.id]
                    out.into.n_sources += (x.row >= 0) - was_source
                    out.sort_in()
                    back.sort_in()

    cdef bint describe(self, Object x):
        """Set cost per metre and row of an object. Returns whether any has changed."""
        cost_per_m = self.cost_per_m.get(x.id)
        cdef bint has_cost = cost_per_m is not None
        cdef double per_m = cost_per_m if has_cost else 0.0
        cdef Py_ssize_t row = self.rows.get(x.id, -1)
        if has_cost == x.has_cost and per_m == x.per_m and row == x.row:
            return False
        x.has_cost, x.per_m, x.row = has_cost, per_m, row
        return True

    # The network.

    def update(self, pairs, dict beside):
        cdef dict around
        if pairs is None:
            self.update_all(beside)
            return
        for a, b in pairs:
            around = beside.get(a)
            junction = None if around is None else around.get(b)
            if junction is None:
                self.disconnect(a, b)
            else:
                self.connect(a, b, junction)

    cdef int update_all(self, dict beside) except -1:
        """Connect objects with a new or moved junction (a moved junction is another one), and disconnect the others."""
        cdef Object x
        cdef Neighbour there
        cdef dict around, known
        for a, around in beside.items():
            x = self.objects.get(a)
            known = {} if x is None else x.neighbours
            for b, junction in around.items():
                there = known.get(b)
                if there is None or there.junction is not junction:
                    self.connect(a, b, junction)
        for x in list(self.objects.values()):
            around = beside.get(x.id, {})
            if len(x.neighbours) > len(around):
                for b in list(x.neighbours):
                    if b not in around:
                        self.disconnect(x.id, b)
        return 0

    cdef Object object_of(self, object_id):
        cdef Object found = self.objects.get(object_id)
        if found is None:
            found = Object.__new__(Object)
            found.id, found.neighbours = object_id, {}
            self.describe(found)
            self.objects[object_id] = found
        return found

    cdef int connect(self, a, b, junction) except -1:
        cdef Object one = self.object_of(a), two = self.object_of(b)
        cdef Neighbour there = one.neighbours.get(b), back = two.neighbours.get(a)
        cdef tuple points = junction[0], weights = junction[1]
        cdef tuple point
        cdef Py_ssize_t k
        cdef bint is_new = there is None
        cdef Edge* edge
        if is_new:
            there, back = Neighbour.__new__(Neighbour), Neighbour.__new__(Neighbour)
            there.out_of, there.into, there.place = one, two, -1
            back.out_of, back.into, back.place = two, one, -1
            one.n_sources += two.row >= 0
            two.n_sources += one.row >= 0
        there.junction = back.junction = junction
        there.allocate(len(points))
        back.allocate(len(points))
        for k in range(len(points)):
            point, edge = points[k], &there.edges[k]
            edge.x, edge.y, edge.z = point
            edge.crossing_cost = self.crossing_costs[weights[k]]
            back.edges[k] = edge[0]
        one.is_ball_known = two.is_ball_known = False
        if is_new:
            one.neighbours[b], two.neighbours[a] = there, back
            self.sort_around(one)
            self.sort_around(two)
        for x in (there, back):
            (<Neighbour>x).sort_in()
            if (<Neighbour>x).place >= 0:
                (<Neighbour>x).enclose()
        return 0

    cdef int disconnect(self, a, b) except -1:
        cdef Object one = self.objects.get(a), two = self.objects.get(b)
        cdef Neighbour there, back
        if one is None or two is None:
            return 0
        there, back = one.neighbours.pop(b, None), two.neighbours.pop(a, None)
        if there is None:
            return 0
        one.n_sources -= two.row >= 0
        two.n_sources -= one.row >= 0
        for x in (there, back):
            if (<Neighbour>x).place >= 0:
                (<Neighbour>x).out_of.drop(x)
        for x in (one, two):
            (<Object>x).is_ball_known = False
            if (<Object>x).neighbours:
                self.sort_around(x)
            else:
                del self.objects[(<Object>x).id]
        return 0

    cdef int sort_around(self, Object x) except -1:
        """Sort an object in at its neighbours, which depends on whether it has several neighbours."""
        cdef Neighbour out, back
        if len(x.neighbours) <= 2:
            for out in x.neighbours.values():
                back = out.into.neighbours[x.id]
                back.sort_in()
        return 0

    # The search.

    def cheapest(self, touched, limits=None, among=None):
        cdef Py_ssize_t k, n = len(self.rows), row
        cdef Object x
        cdef Neighbour start
        cdef list starts = []
        cdef double limit = INFINITY
        self.search += 1
        self.n_labels = self.n_targets = 0
        for k in range(n):
            self.found[k], self.target_of[k] = INFINITY, -1
        for object_id, point in touched:
            at = self.rows.get(object_id)
            if at is not None:
                self.found[<Py_ssize_t>at] = 0.0
            x = self.objects.get(object_id)
            if x is not None and x.has_cost:
                start = Neighbour.__new__(Neighbour)
                start.into = x
                start.allocate(1)
                start.edges[0].x, start.edges[0].y, start.edges[0].z = point
                start.edges[0].search = self.search
                starts.append(start)
                self.push(0.0, 0, start, 0)
        if starts:
            for row in range(n) if among is None else among:
                if self.found[row] > 0.0:
                    x = self.objects.get(self.ids[row])
                    if x is not None:
                        if not x.is_ball_known:
                            x.find_ball()
                        if limits is not None:
                            limit = limits[row]
                        self.targets[self.n_targets] = Target(x.x, x.y, x.z, x.radius_m, limit, row)
                        self.target_of[row] = self.n_targets
                        self.n_targets += 1
            self.follow()
        return [self.found[k] for k in range(n)]

    cdef int follow(self) except -1:
        """Expand labels, the cheapest first, until no target is left."""
        cdef Label label
        cdef Neighbour way
        cdef Edge* at
        while self.n_labels and self.n_targets:
            label = self.pop()
            way = <Neighbour>label.neighbour
            at = &way.edges[label.k]
            if label.cost > at.least and label.hops >= at.least_hops:
                continue  # a cheaper label of the same point came first
            if way.into.dominates(self.search, at, label.cost, label.hops):
                continue
            self.drop_targets(label.cost)
            if self.may_reach(at, label.cost):
                self.expand(way, at, label.cost, label.hops)
        return 0

    cdef int expand(self, Neighbour way, Edge* at, double cost, int hops) except -1:
        cdef Object here = way.into, beyond
        cdef Neighbour other
        cdef Py_ssize_t j, k
        cdef double per_m = here.per_m, further, limit
        cdef bint is_last = False
        cdef Target* target
        cdef Beside* beside
        cdef Edge* edge
        if here.search != self.search:
            here.search, here.n_entries = self.search, 0
        here.enter(at, cost, hops)
        limit = self.highest_limit()
        for j in range(here.n_around):
            beside = &here.around[j]
            if beside.row < 0 or self.target_of[beside.row] < 0 or is_beyond(beside, at, cost, per_m, limit):
                continue
            target, other = &self.targets[self.target_of[beside.row]], <Neighbour>beside.neighbour
            for k in range(other.n):
                edge = &other.edges[k]
                further = cost + per_m * apart(at.x, at.y, at.z, edge.x, edge.y, edge.z) + edge.crossing_cost
                if further < self.found[target.row] and further <= target.at_most:
                    self.found[target.row] = target.at_most = further
        limit = self.highest_limit()
        if self.is_limited:
            hops += 1
            if hops >= self.max_hops:
                return 0
            is_last = hops + 1 == self.max_hops
        for j in range(here.n_around):
            beside = &here.around[j]
            if not beside.leads_on or is_beyond(beside, at, cost, per_m, limit):
                continue
            other = <Neighbour>beside.neighbour
            beyond = other.into
            if (is_last and not beyond.n_sources) or (beyond is way.out_of and per_m >= beyond.per_m):
                continue
            for k in range(other.n):
                edge = &other.edges[k]
                further = cost + per_m * apart(at.x, at.y, at.z, edge.x, edge.y, edge.z) + edge.crossing_cost
                if further > limit or further == INFINITY:
                    continue
                if edge.search != self.search:
                    edge.search, edge.least, edge.least_hops = self.search, INFINITY, 2147483647
                if further >= edge.least and hops >= edge.least_hops:
                    continue
                # Checking the bound costs less than a label in the heap that would be pruned later.
                if not self.may_reach(edge, further) or beyond.dominates(self.search, edge, further, hops):
                    continue
                if further <= edge.least and hops <= edge.least_hops:
                    edge.least, edge.least_hops = further, hops
                self.push(further, hops, other, k)
        return 0

    cdef double highest_limit(self) noexcept:
        cdef Py_ssize_t i
        cdef double highest = 0
        for i in range(self.n_targets):
            if self.targets[i].at_most > highest:  # `fmax` is a call for each of thousands of targets
                highest = self.targets[i].at_most
        return highest

    cdef void drop_targets(self, double cost) noexcept:
        """Drop the targets that no path of this cost or more can improve."""
        cdef Py_ssize_t i = 0
        while i < self.n_targets:
            if cost <= self.targets[i].at_most and cost < self.found[self.targets[i].row]:
                i += 1
            else:
                self.n_targets -= 1
                self.target_of[self.targets[i].row] = -1
                if i < self.n_targets:
                    self.targets[i] = self.targets[self.n_targets]
                    self.target_of[self.targets[i].row] = i

    cdef bint may_reach(self, Edge* at, double cost) noexcept:
        cdef Py_ssize_t i
        cdef double metres
        cdef Target* target
        for i in range(self.n_targets):
            target = &self.targets[i]
            metres = apart(at.x, at.y, at.z, target.x, target.y, target.z) - target.radius_m
            if cost + self.least_per_m * metres <= target.at_most * ROUNDED_UP:
                return True
        return False

    # A binary heap of labels. They need no references to their neighbours, since no search updates the network.

    cdef int push(self, double cost, int hops, Neighbour way, Py_ssize_t k) except -1:
        cdef Py_ssize_t i = self.n_labels, parent
        cdef Label* labels
        if i == self.room:
            labels = <Label*>PyMem_Realloc(self.labels, (2 * i + 64) * sizeof(Label))
            if labels == NULL:
                raise MemoryError
            self.labels, self.room = labels, 2 * i + 64
        labels = self.labels
        while i > 0:
            parent = (i - 1) // 2
            if labels[parent].cost <= cost:
                break
            labels[i] = labels[parent]
            i = parent
        labels[i] = Label(cost, hops, k, <void*>way)
        self.n_labels += 1
        return 0

    cdef Label pop(self) noexcept:
        cdef Label* labels = self.labels
        cdef Label first = labels[0], last
        cdef Py_ssize_t i = 0, child, n = self.n_labels - 1
        self.n_labels = n
        last = labels[n]
        while 2 * i + 1 < n:
            child = 2 * i + 1
            if child + 1 < n and labels[child + 1].cost < labels[child].cost:
                child += 1
            if last.cost <= labels[child].cost:
                break
            labels[i] = labels[child]
            i = child
        labels[i] = last
        return first
