"""The compiled twin of the kernel in `slide`."""


def lying(tuple position_m, base_face, tuple at_m, top_face, int up_axis):
    cdef int flat = 3 - up_axis
    cdef double u = position_m[0], v = position_m[flat], h = position_m[up_axis]
    cdef double over_u = at_m[0], over_v = at_m[flat], over = at_m[up_axis]
    cdef double top_m, fall_m, cu, cv, nu, nv, offset, pu, pv, sole_height, top_height, radius
    cdef bint is_inside = True
    # Named tuples: base face and top face of `stance`, by their places.
    points, sole_height, (cu, cv), radius, _ = <tuple>base_face
    _, top_height, edges, _, _ = <tuple>top_face
    top_m = over + top_height
    fall_m = h + sole_height - top_m
    cu, cv = cu + (u - over_u), cv + (v - over_v)
    for edge in <tuple>edges:
        nu, nv, offset = <tuple>edge
        if nu * cu + nv * cv - offset < radius:
            is_inside = False
            break
    h = (h + sole_height + top_m) / 2
    places = []
    for point in <tuple>points:
        pu, pv = <tuple>point
        places.append((u + pu, h, v + pv) if up_axis == 1 else (u + pu, v + pv, h))
    return fall_m, top_m, is_inside, tuple(places)
