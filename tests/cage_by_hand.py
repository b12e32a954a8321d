"""A riveted cage half once more, by a path of its own: meshes of gmsh, plain isoparametric elements, direct contact.

      x ^   ________________________
        |  |  web            | seat |       One half pitch of one half: theta = 0 is the plane through the rivet's axis, theta = pi/Z that
        |  |_____            |__    |       through the pocket's axis.  At rest of impacts both are planes of symmetry, and so is the split
        |   pocket \\   bar     |___|       x = 0 between the two halves: pads touch a rigid plane there, the rivet's section stays in it.
        +-----------\\=========-----+
      theta = pi/Z        pad    theta = 0

Places are (x, y, z): x along the axis, y outward through the rivet, z along the circle there.  SI units.  Nothing of
rivet_model is used; `g` is a Geometry, of which only the dimensions are read.

- Half: quadratic tetrahedra.  Rivet: quadratic hexahedra, a meridian mesh of gmsh turned about the rivet's axis.
- Contact without friction: pressures are sums of hats that are nowhere negative; gaps, weighted with the same hats, are
  nowhere negative either.
- A rivet's half is a point mass at its seat: its centrifugal force acts on the half there, and it vibrates with the
  mean of the seat.
"""

import math
from typing import NamedTuple

import gmsh
import numpy as np
from scipy.sparse import block_diag, bmat, coo_matrix, csc_matrix, diags
from scipy.sparse.linalg import LinearOperator, eigsh, splu


class Material(NamedTuple):
    """Young's modulus [Pa], Poisson's ratio, density [kg/m3]."""

    E: float
    nu: float
    rho: float


# Elements -------------------------------------------------------------------------------------------------------------


def lagrange(x):
    """Quadratic polynomials that are 1 at 0, 1/2, 1 of [0, 1], and their slopes [3, n]."""
    return np.stack([(1 - x) * (1 - 2 * x), 4 * x * (1 - x), x * (2 * x - 1)]), np.stack(
        [4 * x - 3, 4 - 8 * x, 4 * x - 1]
    )


def tetrahedron(points):
    """Shape functions [10, n] and gradients [10, 3, n] of the tetrahedron of gmsh's order at points [3, n] of the unit
    one.
    """
    L = np.vstack([1 - points.sum(axis=0), points])
    dL = np.vstack([-np.ones(3), np.eye(3)])
    edges = [(0, 1), (1, 2), (0, 2), (0, 3), (2, 3), (1, 3)]
    N = np.stack([L[i] * (2 * L[i] - 1) for i in range(4)] + [4 * L[i] * L[j] for i, j in edges])
    corner = [dL[i][:, None] * (4 * L[i] - 1) for i in range(4)]
    return N, np.stack(corner + [4 * (dL[i][:, None] * L[j] + dL[j][:, None] * L[i]) for i, j in edges])


def triangle(points):
    """Shape functions [6, n] and gradients [6, 2, n] of gmsh's triangle at points [2, n]."""
    L = np.vstack([1 - points.sum(axis=0), points])
    dL = np.vstack([-np.ones(2), np.eye(2)])
    edges = [(0, 1), (1, 2), (0, 2)]
    N = np.stack([L[i] * (2 * L[i] - 1) for i in range(3)] + [4 * L[i] * L[j] for i, j in edges])
    corner = [dL[i][:, None] * (4 * L[i] - 1) for i in range(3)]
    return N, np.stack(corner + [4 * (dL[i][:, None] * L[j] + dL[j][:, None] * L[i]) for i, j in edges])


def hexahedron(points):
    """Shape functions [27, n] and gradients [27, 3, n] at points [3, n] of the unit cube; node (i, j, k) is 9 i + 3 j +
    k.
    """
    (a, da), (b, db), (c, dc) = (lagrange(x) for x in points)
    n = points.shape[1]
    N = np.einsum("in,jn,kn->ijkn", a, b, c).reshape(27, n)
    slopes = [np.einsum("in,jn,kn->ijkn", *f).reshape(27, n) for f in ((da, b, c), (a, db, c), (a, b, dc))]
    return N, np.stack(slopes, axis=1)


def cube_rule(n):
    """Gauss points [3, n^3] of the unit cube and weights."""
    x, w = np.polynomial.legendre.leggauss(n)
    x, w = (x + 1) / 2, w / 2
    points = np.stack(np.meshgrid(x, x, x, indexing="ij")).reshape(3, -1)
    return points, np.einsum("i,j,k->ijk", w, w, w).ravel()


def tetrahedron_rule(n):
    """Gauss points of the cube collapsed to the unit tetrahedron, and weights: exact to degree 2 n - 3."""
    (a, b, c), w = cube_rule(n)
    return np.stack([a, b * (1 - a), c * (1 - a) * (1 - b)]), w * (1 - a) ** 2 * (1 - b)


def four_points():
    """Points [3, 4] of the unit tetrahedron and weights: exact to degree 2, which stiffness of quadratic tetrahedra
    with straight sides has.
    """
    near = (5.0 - math.sqrt(5.0)) / 20.0
    return near + (1.0 - 4.0 * near) * np.vstack([np.zeros(3), np.eye(3)]).T, np.full(4, 1.0 / 24.0)


def triangle_rule(parts):
    """Points [2, 3 parts^2] of the unit triangle cut into parts^2, three in each, and weights: exact to degree 2 in
    each part.
    """
    own, points = np.array([[1, 1], [4, 1], [1, 4]]) / 6, []
    for i in range(parts):
        for j in range(parts - i):
            points.append((own + [i, j]) / parts)
            if i + j < parts - 1:
                points.append(([i + 1, j + 1] - own) / parts)
    points = np.concatenate(points).T
    return points, np.full(points.shape[1], 0.5 / points.shape[1])


class Solid:
    """Nodes [n, 3] with elements of one shape: stiffness, inertia, stress."""

    def __init__(self, nodes, elements, shape, rule, fine_rule):
        self.nodes, self.elements, self.shape, self.rule, self.fine_rule = nodes, elements, shape, rule, fine_rule

    def points(self, rule):
        """At the points of a rule: places [e, q, 3], volumes [e, q], shape functions [i, q], gradients in space [e, i,
        3, q].
        """
        points, weights = rule
        N, dN = self.shape(points)
        X = self.nodes[self.elements]
        J = np.einsum("eia,ibq->eqab", X, dN)
        volume = np.linalg.det(J) * weights
        assert volume.min() > 0.0, "an element is turned inside out"
        return np.einsum("eia,iq->eqa", X, N), volume, N, np.einsum("ibq,eqba->eiaq", dN, np.linalg.inv(J))

    def assemble(self, blocks):
        """Matrix [3 n, 3 n] of element blocks [e, i, a, j, b]."""
        dofs = (3 * self.elements[:, :, None] + np.arange(3)).reshape(len(self.elements), -1)
        size = dofs.shape[1]
        rows, columns = np.repeat(dofs, size, axis=1).ravel(), np.tile(dofs, (1, size)).ravel()
        return coo_matrix((blocks.ravel(), (rows, columns)), shape=(3 * len(self.nodes),) * 2).tocsc()

    def stiffness(self, E, nu):
        """Matrix of linear elasticity: lambda div u div v + 2 mu e(u) : e(v) [N/m]."""
        lam, mu = E * nu / (1 + nu) / (1 - 2 * nu), E / 2 / (1 + nu)
        blocks = []
        for e in np.array_split(np.arange(len(self.elements)), max(1, len(self.elements) // 500)):
            part = Solid(self.nodes, self.elements[e], self.shape, None, None)
            _, volume, _, d = part.points(self.rule)
            n = d.shape[1]
            flat = (d * np.sqrt(volume)[:, None, None, :]).reshape(len(e), 3 * n, -1)
            outer = (flat @ flat.transpose(0, 2, 1)).reshape(len(e), n, 3, n, 3)
            trace = np.einsum("eiaja->eij", outer)
            blocks.append(
                lam * outer + mu * outer.transpose(0, 1, 4, 3, 2) + mu * np.einsum("eij,ab->eiajb", trace, np.eye(3))
            )
        return self.assemble(np.concatenate(blocks))

    def inertia(self, rho):
        """Mass matrix [kg]."""
        _, volume, N, _ = self.points(self.fine_rule)
        return self.assemble(
            np.einsum("eij,ab->eiajb", rho * np.einsum("eq,iq,jq->eij", volume, N, N, optimize=True), np.eye(3))
        )

    def moments(self):
        """Volume, first moments [3] and second moments [3, 3] about the origin."""
        X, volume, _, _ = self.points(self.fine_rule)
        return volume.sum(), np.einsum("eq,eqa->a", volume, X), np.einsum("eq,eqa,eqb->ab", volume, X, X)

    def stress(self, u, local, E, nu):
        """Principal stresses [e, q, 3] at local points [3, q] of all elements, u [n, 3]."""
        _, _, _, d = self.points((local, np.ones(local.shape[1])))
        grad = np.einsum("eia,eibq->eqab", u[self.elements], d)
        strain = (grad + grad.swapaxes(-1, -2)) / 2
        trace = np.trace(strain, axis1=-2, axis2=-1)[..., None, None]
        return np.linalg.eigvalsh(E / (1 + nu) * (strain + nu / (1 - 2 * nu) * trace * np.eye(3)))


def factor(K):
    """Solver of K u = f for a symmetric positive definite K."""
    return splu(K.tocsc(), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})


# Meshes ---------------------------------------------------------------------------------------------------------------


class Half(NamedTuple):
    """Mesh of one half pitch of a half: solid, facets [m, 6] of pad and seat."""

    solid: Solid
    pad: np.ndarray
    seat: np.ndarray


def pad_half_length(g):
    """The pad's half length along the circle [m]: patch_radius, or 0.1 mm less than the half bar at the bore."""
    r, p = g.cage_inner_diameter / 2, (g.ball_diameter + g.pocket_clearance) / 2
    return min(g.patch_radius, r * math.sin(math.pi / g.Z - math.asin(p / r)) - 0.1e-3)


def session(function):
    """Runs a function that meshes in a session of gmsh, silent and with one thread."""

    def run(*args):
        gmsh.initialize(interruptible=False)
        try:
            for name, value in (("General.Terminal", 0), ("General.NumThreads", 1)):
                gmsh.option.setNumber(name, value)
            for name in ("MeshSizeFromPoints", "MeshSizeExtendFromBoundary", "MeshSizeFromCurvature"):
                gmsh.option.setNumber(f"Mesh.{name}", 0)
            return function(*args)
        finally:
            gmsh.finalize()

    return run


def used(tags, coordinates, *element_lists):
    """Nodes [n, 3] in m of the first list of elements (tags) and all lists as indices into them; gmsh has mm."""
    kept = np.unique(element_lists[0])
    index = np.zeros(int(tags.max()) + 1, dtype=int)
    index[kept] = np.arange(len(kept))
    place = np.empty((int(tags.max()) + 1, 3))
    place[tags] = coordinates.reshape(-1, 3)
    return place[kept] * 1e-3, *(index[e] for e in element_lists)


@session
def half_mesh(g, size, seat_size=None):
    """One half pitch of a half, theta = 0 to pi/Z.

    size: of the elements over the ordinary ones, 0.14 of the ring's radial width; seat_size: of those at the seat over
    a quarter of its width.
    """
    seat_size = seat_size or size
    occ, mm = gmsh.model.occ, 1e3
    r_i, r_o, R, w = (
        mm * v for v in (g.cage_inner_diameter / 2, g.cage_outer_diameter / 2, g.d_m / 2, g.cage_half_width)
    )
    shank, head, seat, pocket = (
        mm / 2 * v for v in (g.shank_diameter, g.head_diameter, g.seat_diameter, g.ball_diameter + g.pocket_clearance)
    )
    flange, depth, edge, relief = (
        mm * g.flange_thickness,
        mm * g.relief_depth,
        mm * g.edge_break,
        shank + mm * g.relief_radius,
    )
    pad, angle, far = mm * pad_half_length(g), math.pi / g.Z, 2 * r_o

    corners = [occ.addPoint(x, r, 0) for x, r in ((0, r_i), (w, r_i), (w, r_o), (0, r_o))]
    face = occ.addPlaneSurface(
        [occ.addCurveLoop([occ.addLine(*ends) for ends in zip(corners, corners[1:] + corners[:1], strict=True)])]
    )
    ring = [e for e in occ.revolve([(2, face)], 0, 0, 0, 1, 0, 0, angle) if e[0] == 3]
    tools = [
        (3, occ.addCylinder(0, 0, 0, 0, far * math.cos(angle), far * math.sin(angle), pocket)),
        (3, occ.addCylinder(-1, R, 0, 1 + flange, 0, 0, shank)),
        (3, occ.addCylinder(flange - depth, R, 0, depth, 0, 0, relief)),
        (3, occ.addCylinder(flange, R, 0, w, 0, 0, seat)),
        (3, occ.addCone(0, R, 0, edge, 0, 0, shank + edge, shank)),
    ]
    body, _ = occ.cut(ring, tools)
    at_pad = occ.addRectangle(0, 0, 0, pad, far)
    occ.rotate([(2, at_pad)], 0, 0, 0, 0, 1, 0, -math.pi / 2)
    at_seat = occ.addDisk(flange, R, 0, head, head, zAxis=[1, 0, 0], xAxis=[0, 1, 0])
    body, _ = occ.fragment(body, [(2, at_pad), (2, at_seat)])
    occ.synchronize()
    volumes = gmsh.model.getEntities(3)
    assert len(volumes) == 1
    skin = {tag for _, tag in gmsh.model.getBoundary(volumes, oriented=False)}
    gmsh.model.removeEntities([(2, tag) for _, tag in gmsh.model.getEntities(2) if tag not in skin], True)

    pads, seats = [], []
    for tag in skin:
        low_x, _, _, high_x, _, high_z = gmsh.model.getBoundingBox(2, tag)
        if high_x < 1e-3 and high_z < pad + 1e-3:
            pads.append(tag)
        if low_x > flange - 1e-3 and high_x < flange + 1e-3 and high_z < head + 1e-3:
            seats.append(tag)
    assert len(seats) == 1 and len(pads) >= 1, (pads, seats)

    width, field = head - relief, gmsh.model.mesh.field
    # a fine place each: from x low to high and radius r_low to r_high about the rivet's axis, elements growing with the
    # distance
    sizes = []
    for low, high, r_low, r_high, fine in (
        (flange, flange, relief, head, width / 4 * seat_size),
        (0, flange, shank, relief, 0.4 * shank * size),
    ):
        radius = f"Sqrt((y-{R})^2+z^2)"
        beside, along = f"Max(Max({r_low} - {radius}, {radius} - {r_high}), 0)", f"Max(Max({low} - x, x - {high}), 0)"
        tag = field.add("MathEval")
        field.setString(tag, "F", f"{fine} + 0.35 * Sqrt(({beside})^2 + ({along})^2)")
        sizes.append(tag)
    near_pad = field.add("MathEval")
    field.setString(near_pad, "F", f"{0.09 * (r_o - r_i) * size} + 0.3 * Max(z - {pad}, 0) + 0.3 * x")
    at_most = field.add("MathEval")
    field.setString(at_most, "F", f"{0.14 * (r_o - r_i) * size}")
    least = field.add("Min")
    field.setNumbers(least, "FieldsList", [*sizes, near_pad, at_most])
    field.setAsBackgroundMesh(least)
    gmsh.model.mesh.generate(3)
    gmsh.model.mesh.setOrder(2)
    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    elements = gmsh.model.mesh.getElementsByType(11)[1].reshape(-1, 10)
    facets = [
        np.concatenate([gmsh.model.mesh.getElementsByType(9, tag)[1].reshape(-1, 6) for tag in group])
        for group in (pads, seats)
    ]
    nodes, elements, *facets = used(tags, coordinates, elements, *facets)
    return Half(Solid(nodes, elements, tetrahedron, four_points(), tetrahedron_rule(4)), *facets)


@session
def rivet_mesh(g, fillet_elements, layers):
    """Half of a rivet above the split, z >= 0: a meridian mesh whose fillet has so many quadratic elements, turned in
    so many layers.
    """
    geo, mm = gmsh.model.geo, 1e3
    shank, head, radius = mm * g.shank_diameter / 2, mm * g.head_diameter / 2, mm * g.fillet_radius
    relief = shank + mm * g.relief_radius
    flange, top = mm * g.flange_thickness, mm * (g.flange_thickness + g.head_height)
    fine = radius * math.pi / 2 / fillet_elements
    place = [
        (0, 0),
        (shank, 0),
        (shank, flange - radius),
        (shank + radius, flange),
        (relief, flange),
        (head, flange),
        (head, top),
        (0, top),
    ]
    p = [geo.addPoint(r, x, 0) for r, x in place]
    centre = geo.addPoint(shank + radius, flange - radius, 0)
    lines = [geo.addCircleArc(p[2], centre, p[3]) if i == 2 else geo.addLine(p[i], p[(i + 1) % 8]) for i in range(8)]
    geo.addPlaneSurface([geo.addCurveLoop(lines)])
    geo.synchronize()
    coarse = 1.6 * head / fillet_elements
    field = gmsh.model.mesh.field
    tag = field.add("MathEval")
    far = f"Max(Sqrt((x-{shank + 0.3 * radius})^2+(y-{flange - 0.3 * radius})^2) - {radius}, 0)"
    field.setString(tag, "F", f"2 * Min({fine} + 0.3 * {far}, {coarse})")  # of quadrilaterals that are cut into four
    field.setAsBackgroundMesh(tag)
    for name, value in (
        ("Algorithm", 8),
        ("RecombineAll", 1),
        ("RecombinationAlgorithm", 1),
        ("SubdivisionAlgorithm", 1),
    ):
        gmsh.option.setNumber(f"Mesh.{name}", value)
    gmsh.model.mesh.generate(2)
    gmsh.model.mesh.setOrder(2)
    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    quads = gmsh.model.mesh.getElementsByType(10)[1].reshape(-1, 9)[:, [0, 4, 1, 7, 8, 5, 3, 6, 2]]  # rows of three
    assert len(gmsh.model.mesh.getElementsByType(9)[1]) == 0
    plane, quads = used(tags, coordinates, quads)
    return turned(g, plane[:, 0], plane[:, 1], quads, layers)


def turned(g, r, x, quads, layers):
    """Half of a body of revolution from nodes (r, x) and quadrilaterals [m, 9] of its meridian plane; on the axis nodes
    of all angles are one.
    """
    R, count = g.d_m / 2, 2 * layers + 1
    r, angle = np.where(r < 1e-9, 0.0, r), np.linspace(0.0, math.pi, count)
    number = np.empty((len(r), count), dtype=int)
    axis = r == 0.0
    number[axis] = np.arange(np.count_nonzero(axis))[:, None]
    number[~axis] = np.count_nonzero(axis) + np.arange(np.count_nonzero(~axis) * count).reshape(-1, count)
    nodes = np.empty((number.max() + 1, 3))
    nodes[number.ravel()] = np.stack(
        [np.repeat(x, count), R + np.outer(r, np.cos(angle)).ravel(), np.outer(r, np.sin(angle)).ravel()], axis=1
    )
    elements = np.concatenate([number[quads][:, :, 2 * k : 2 * k + 3].reshape(len(quads), 27) for k in range(layers)])
    solid = Solid(nodes, elements, hexahedron, cube_rule(3), cube_rule(4))
    if np.linalg.det(np.einsum("ia,ib->ab", nodes[elements[0]], hexahedron(np.full((3, 1), 0.5))[1][:, :, 0])) < 0.0:
        solid.elements = elements.reshape(-1, 3, 3, 3).transpose(0, 2, 1, 3).reshape(-1, 27)
    return solid


# Contact at rest of impacts -------------------------------------------------------------------------------------------


def supported(solid, Z):
    """Matrix [3 n, free] of the displacements of a sector between its planes of symmetry theta = 0 and pi/Z (Z = 1: the
    plane z = 0 alone).

    Also the places [free, 3] of what is free, and its axes [free]: 0 is x.
    """
    n, angle = solid.nodes, math.pi / Z
    kept = np.ones((len(n), 3), dtype=bool)
    tiny = 1e-6 * np.ptp(n[:, 0])
    kept[np.abs(n[:, 2]) < tiny, 2] = False
    turn = np.tile(np.eye(3), (len(n), 1, 1))
    if Z > 1:
        side = np.abs(n[:, 2] * math.cos(angle) - n[:, 1] * math.sin(angle)) < tiny
        turn[side] = [[1, 0, 0], [0, math.cos(angle), -math.sin(angle)], [0, math.sin(angle), math.cos(angle)]]
        kept[side, 2] = False
    columns = block_diag(list(turn), format="csc")
    return (
        columns[:, np.flatnonzero(kept.ravel())],
        np.repeat(n, 3, axis=0)[kept.ravel()],
        np.tile(np.arange(3), len(n))[kept.ravel()],
    )


def facet_points(nodes, facets, parts=3):
    """Shape functions [i, q], places [f, q, 3] and areas [f, q] on flat facets x = constant: triangles [f, 6] or
    quadrilaterals [f, 9].
    """
    if facets.shape[1] == 6:
        points, weights = triangle_rule(parts)
        N, dN = triangle(points)
    else:
        x, w = np.polynomial.legendre.leggauss(2)
        x = ((np.arange(parts)[:, None] + (x + 1) / 2) / parts).ravel()
        w = np.tile(w / 2 / parts, parts)
        (a, da), (b, db) = lagrange(np.repeat(x, len(x))), lagrange(np.tile(x, len(x)))
        weights = np.repeat(w, len(x)) * np.tile(w, len(x))
        N = np.einsum("iq,jq->ijq", a, b).reshape(9, -1)
        dN = np.stack([np.einsum("iq,jq->ijq", *f).reshape(9, -1) for f in ((da, b), (a, db))], axis=1)
    X = nodes[facets]
    J = np.einsum("fia,ibq->fqab", X[:, :, 1:], dN)
    return N, np.einsum("fia,iq->fqa", X, N), np.abs(np.linalg.det(J)) * weights


def polar_hats(places, R, low, high, shape):
    """Hats over radius and angle of the seat's half ring at places [..., 3]: values [n_hats, ...]; shape: intervals
    (radius, angle).
    """

    def hats(t, n):
        return np.maximum(0.0, 1.0 - np.abs(t[None] * n - np.arange(n + 1).reshape(-1, *[1] * t.ndim)))

    y, z = places[..., 1] - R, places[..., 2]
    radius = np.clip((np.hypot(y, z) - low) / (high - low), 0.0, 1.0)
    return np.einsum("i...,j...->ij...", hats(radius, shape[0]), hats(np.arctan2(z, y) / math.pi, shape[1])).reshape(
        -1, *radius.shape
    )


def rows_of_x(nodes, facets, N, values, area):
    """Matrix [n_hats, 3 n]: integral of hat times u_x; values [n_hats, f, q]."""
    blocks = np.einsum("hfq,iq,fq->hfi", values, N, area, optimize=True)
    h = np.repeat(np.arange(len(values)), facets.size)
    return coo_matrix(
        (blocks.ravel(), (h, np.tile(3 * facets.ravel(), len(values)))), shape=(len(values), 3 * len(nodes))
    ).tocsr()


class Body:
    """A body with hats of contact: flexibility between them, displacements by any loads; x is held at one point or
    plane.
    """

    def __init__(self, solid, Z, material, held_x, rows):
        self.solid, self.rows = solid, rows
        self.Q, places, axis = supported(solid, Z)
        free = ~((axis == 0) & held_x(places))
        self.Q = self.Q[:, np.flatnonzero(free)]
        self.factor = factor(self.Q.T @ solid.stiffness(material.E, material.nu) @ self.Q)
        self.by_hats = self.solve((rows.T).toarray())
        self.G = rows @ self.by_hats

    def solve(self, f):
        """Displacements [3 n, ...] by nodal forces [3 n, ...]."""
        return self.Q @ self.factor.solve(self.Q.T @ f)


def pressures(G, gap, C):
    """Pressures p >= 0 and shift s with gaps G p + gap + C s >= 0, complementary, and C.p = 0: block principal pivoting
    (Judice, Pires 1994).
    """
    n, active, least, patience = len(gap), np.ones(len(gap), dtype=bool), len(gap) + 1, 10
    scale_p, scale_g = 1e-9 * np.abs(gap).max() / np.abs(np.diag(G)).mean(), 1e-9 * np.abs(gap).max()
    for _ in range(20 * n):
        a = np.flatnonzero(active)
        system = np.block([[G[np.ix_(a, a)], C[a, None]], [C[None, a], np.zeros((1, 1))]])
        size = np.append(1.0 / np.sqrt(np.diag(G)[a]), np.sqrt(np.diag(G).mean()) / np.abs(C[a]).mean())
        size[-1] = 1.0 / np.linalg.norm(C[a] * size[:-1])
        found = size * np.linalg.solve(system * np.outer(size, size), size * np.append(-gap[a], 0.0))
        p = np.zeros(n)
        p[a] = found[:-1]
        g = G @ p + gap + C * found[-1]
        wrong = np.where(active, p < -scale_p, g < -scale_g)
        count = np.count_nonzero(wrong)
        if count == 0:
            return p, found[-1]
        if count < least:
            least, patience = count, 10
        elif patience > 0:
            patience -= 1
        else:
            wrong[: np.flatnonzero(wrong)[-1]] = False
        active = active ^ wrong
    raise RuntimeError("contact was not found")


class State(NamedTuple):
    """Tension of the rivet [N], bending moment of its shank about the circle's tangent [N m], head stress [Pa], pressed
    share of the pad.
    """

    T: float
    m_t: float
    head: float
    pressed: float


class Cage:
    """Cage of two equal halves turning at rest of impacts: half pitch of a half, half of a rivet above the split."""

    def __init__(self, g, material, rivet_material, half=None, rivet=None, hats=(3, 8)):
        self.g, self.material, self.rivet_material = g, material, rivet_material
        self.half, self.rivet = half or half_mesh(g, 1.0), rivet or rivet_mesh(g, 8, 8)
        R, low, high = g.d_m / 2, g.shank_diameter / 2 + g.relief_radius, g.head_diameter / 2
        nodes, pad, seat = self.half.solid.nodes, self.half.pad, self.half.seat
        N, _, area = facet_points(nodes, pad)
        points, _ = triangle_rule(3)
        corner = np.vstack([1 - points.sum(axis=0), points])  # linear hats of the triangles' corners
        vertices, which = np.unique(pad[:, :3], return_inverse=True)
        blocks = np.einsum("cq,iq,fq->fci", corner, N, area)
        which = which.reshape(-1, 3)
        at = np.broadcast_to(which[:, :, None], blocks.shape), np.broadcast_to(3 * pad[:, None, :], blocks.shape)
        on_pad = coo_matrix(
            (blocks.ravel(), (at[0].ravel(), at[1].ravel())), shape=(len(vertices), 3 * len(nodes))
        ).tocsr()
        N, X, area = facet_points(nodes, seat)
        on_seat = rows_of_x(nodes, seat, N, polar_hats(X, R, low, high, hats), area)
        self.n_pad = len(vertices)
        far = np.argmax(nodes[:, 0] + nodes[:, 1])
        self.body = Body(
            self.half.solid,
            g.Z,
            material,
            lambda at: np.all(at == nodes[far], axis=1),
            bmat([[on_pad], [-on_seat]], format="csr"),
        )

        on_half, nodes_r, self.below = self.body.rows, self.rivet.nodes, below_head(self.rivet, g)
        N, X, area = facet_points(nodes_r, self.below)
        rows = rows_of_x(nodes_r, self.below, N, polar_hats(X, R, low, high, hats), area)
        self.pin = Body(self.rivet, 1, rivet_material, lambda at: at[:, 0] < 1e-9, rows)
        self.lever = rows @ np.column_stack([nodes_r[:, 1] - R, *np.zeros((2, len(nodes_r)))]).ravel()
        self.area = rows @ np.tile([1.0, 0.0, 0.0], len(nodes_r))
        self.C = on_half @ np.tile([1.0, 0.0, 0.0], len(nodes))
        self.G = self.body.G.copy()
        self.G[self.n_pad :, self.n_pad :] += self.pin.G
        self.spin_gap = on_half @ self.body.solve(self.centrifugal())
        preload_gap = np.append(np.zeros(self.n_pad), -self.area)
        self.preload_gap = preload_gap / self.tension(pressures(self.G, preload_gap, self.C)[0])  # of 1 N at standstill
        self.fillet = Fillet(self.rivet, g)

    def centrifugal(self):
        """Nodal forces on the half at 1 rad/s [N]: rho r outward, the rivet's half at its seat."""
        g, solid = self.g, self.half.solid
        X, volume, N, _ = solid.points(solid.fine_rule)
        force = np.zeros_like(solid.nodes)
        for axis in (1, 2):
            np.add.at(
                force[:, axis], solid.elements, self.material.rho * np.einsum("eq,eq,iq->ei", volume, X[..., axis], N)
            )
        force[:, 1] += self.rivet_mass() / 2 * g.d_m / 2 * self.seat_mean()
        return force.ravel()

    def rivet_mass(self):
        """Mass of one rivet above the split [kg]."""
        return 2 * self.rivet_material.rho * self.rivet.moments()[0]

    def seat_mean(self):
        """Weights of the nodes' displacements in the mean of the seat below the head [n]."""
        N, _, area = facet_points(self.half.solid.nodes, self.half.seat)
        weights = np.zeros(len(self.half.solid.nodes))
        np.add.at(weights, self.half.seat, np.einsum("iq,fq->fi", N, area))
        return weights / weights.sum()

    def tension(self, p):
        return 2.0 * self.area @ p[self.n_pad :]

    def at_rest(self, P, omega):
        """State with preload P [N] at the cage's speed omega [rad/s]."""
        p, _ = pressures(self.G, P * self.preload_gap + omega**2 * self.spin_gap, self.C)
        u = (self.pin.by_hats @ p[self.n_pad :]).reshape(-1, 3)
        pressed = self.C[: self.n_pad][p[: self.n_pad] > 0].sum() / self.C[: self.n_pad].sum()
        return State(
            self.tension(p), 2.0 * self.lever @ p[self.n_pad :], self.fillet.largest(u, self.rivet_material), pressed
        )


# that turn with the angle
FACES = [np.arange(27).reshape(3, 3, 3)[key].ravel() for key in ((0,), (2,), (slice(None), 0), (slice(None), 2))]


def below_head(rivet, g):
    """Facets [m, 9] of the ring on which the head sits."""
    nodes = rivet.nodes
    r = np.hypot(nodes[:, 1] - g.d_m / 2, nodes[:, 2])
    tiny = 1e-6 * g.head_diameter
    inside = (r < g.head_diameter / 2 + tiny) & (r > g.shank_diameter / 2 + g.relief_radius - tiny)
    inside &= np.abs(nodes[:, 0] - g.flange_thickness) < tiny
    facets = np.concatenate([rivet.elements[:, face] for face in FACES])
    return facets[inside[facets].all(axis=1)]


class Fillet:
    """Where the fillet's surface is in a rivet's mesh."""

    def __init__(self, rivet, g):
        self.rivet, nodes = rivet, rivet.nodes
        r = np.hypot(nodes[:, 1] - g.d_m / 2, nodes[:, 2]) - g.shank_diameter / 2 - g.fillet_radius
        x = nodes[:, 0] - g.flange_thickness + g.fillet_radius
        tiny = 1e-3 * g.fillet_radius
        on = (np.abs(np.hypot(r, x) - g.fillet_radius) < tiny) & (r < tiny) & (x > -tiny)
        self.parts = [(face, np.flatnonzero(on[rivet.elements[:, face]].all(axis=1))) for face in FACES]
        assert sum(len(e) for _, e in self.parts) > 0

    def largest(self, u, material):
        """Largest principal stress [Pa] over the fillet's nodes, each the mean of its elements."""
        total, count = np.zeros(len(self.rivet.nodes)), np.zeros(len(self.rivet.nodes))
        i, j, k = np.unravel_index(np.arange(27), (3, 3, 3))
        local = np.stack([i, j, k]) / 2.0
        for face, elements in self.parts:
            if len(elements):
                part = Solid(self.rivet.nodes, self.rivet.elements[elements], hexahedron, None, None)
                stress = part.stress(u, local[:, face], material.E, material.nu)[..., -1]
                np.add.at(total, part.elements[:, face], stress)
                np.add.at(count, part.elements[:, face], 1.0)
        return (total[count > 0] / count[count > 0]).max()


# A free half ----------------------------------------------------------------------------------------------------------


def inertia(g, material, rivet_material, half, rivet):
    """Mass, x_c, J_p, J_t of a half with its half of the rivets [kg, m, kg m2], by the volumes of the meshes."""
    # two mirrored parts in a pitch
    parts = [(2 * material.rho, *half.solid.moments()), (2 * rivet_material.rho, *rivet.moments())]
    m, first, second = (g.Z * sum(part[0] * part[i] for part in parts) for i in (1, 2, 3))
    x_c, J_p = first[0] / m, second[1, 1] + second[2, 2]
    return m, x_c, J_p, J_p / 2 + second[0, 0] - m * x_c**2


def frequencies(g, material, rivet_mass, half, waves, count):
    """Lowest `count` frequencies [Hz] of a free half with each number of waves around it: {n: array}, rigid motions
    left out.

    Mirroring in the plane of the rivet parts a displacement into e, even, and i o, odd.  A wave e + i o gains the phase
    phi = 2 pi n/Z in a pitch, so in the plane of the pocket e sin(phi/2) = o cos(phi/2) along x and r, e cos(phi/2) =
    -o sin(phi/2) along t: real fields on one half pitch.
    """
    solid, nodes, Z = half.solid, half.solid.nodes, g.Z
    K, M = solid.stiffness(material.E, material.nu), solid.inertia(material.rho)
    s = np.zeros(len(nodes))
    N, _, area = facet_points(nodes, half.seat)
    np.add.at(s, half.seat, np.einsum("iq,fq->fi", N, area))
    s /= s.sum()
    mean = [csc_matrix(np.kron(s, np.eye(3)[a])[:, None]) for a in range(3)]
    on_seat = [rivet_mass / 2 * mean[a] @ mean[a].T for a in range(3)]
    K2, M2 = block_diag([K, K], format="csc"), block_diag([M + on_seat[0] + on_seat[1], M + on_seat[2]], format="csc")

    tiny, angle, n3 = 1e-6 * np.ptp(nodes[:, 0]), math.pi / Z, 3 * len(nodes)
    at_rivet, at_pocket = (
        np.abs(nodes[:, 2]) < tiny,
        np.abs(nodes[:, 2] * math.cos(angle) - nodes[:, 1] * math.sin(angle)) < tiny,
    )
    free = np.ones((2, len(nodes), 3), dtype=bool)
    free[0, at_rivet, 2] = free[1, at_rivet, 0] = free[1, at_rivet, 1] = False
    free[:, at_pocket] = False
    inner = diags(np.ones(2 * n3), format="csc")[:, np.flatnonzero(free.ravel())]
    # rows x, r, t
    axes = np.array([[1, 0, 0], [0, math.cos(angle), math.sin(angle)], [0, -math.sin(angle), math.cos(angle)]])
    place, found = np.flatnonzero(at_pocket), {}
    for n in waves:
        c, d = math.cos(math.pi * n / Z), math.sin(math.pi * n / Z)
        blocks = np.concatenate([axes * [[c], [c], [-d]], axes * [[d], [d], [c]]], axis=1)  # [x r t, (even, odd) space]
        rows = np.concatenate([3 * place[:, None] + np.arange(3), n3 + 3 * place[:, None] + np.arange(3)], axis=1)
        shared = coo_matrix(
            (
                np.tile(blocks.ravel(), len(place)),
                (np.repeat(rows[:, None, :], 3, axis=1).ravel(), np.repeat(np.arange(3 * len(place)), 6)),
            ),
            shape=(2 * n3, 3 * len(place)),
        )
        T = bmat([[inner, shared]], format="csc")
        K_n, M_n = (T.T @ K2 @ T).tocsc(), (T.T @ M2 @ T).tocsc()
        shift = -((2 * math.pi * 500.0) ** 2)
        inverse = factor(K_n - shift * M_n)
        rigid = 2 if n < 2 else 0  # x and the turn about x; two of the translations and tilts
        operator = LinearOperator(K_n.shape, inverse.solve, dtype=float)
        square = np.sort(
            eigsh(
                K_n,
                count + rigid,
                M_n,
                sigma=shift,
                OPinv=operator,
                v0=np.ones(K_n.shape[0]),
                return_eigenvectors=False,
            )
        )
        assert np.all(np.abs(square[:rigid]) < -1e-4 * shift) and square[rigid] > -1e-2 * shift
        found[n] = np.sqrt(square[rigid:]) / (2 * math.pi)
    return found
