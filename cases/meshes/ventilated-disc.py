"""Ventilated disc with a hat and two pads: writes ventilated-disc.msh (needs the Python package gmsh).

    python3 ventilated-disc.py [element size in m, default 0.0245] [file]

Cheeks r 0.125 to 0.175 m at z 0 to 0.010 and 0.025 to 0.035 m, 21 radial ribs with parallel sides between them, 28.70 mm wide;
a hat of a ring r 0.1125 to 0.125 m, a cylinder r 0.105 to 0.1125 m up to z 0.075 m and a plate r 0.040 to 0.105 m with five
holes of radius 10 mm. Two pads r 0.130 to 0.1675 m, 60 to 120 degrees, 15 mm thick, one on each face; disc and pads share no
node. Regions disc, pad_bottom, pad_top; surfaces bolts (bore and holes), disc_bottom, disc_top (friction rings), lining_bottom,
lining_top (pad faces on the disc), back_bottom, back_top.
"""

import math
import sys

import gmsh

SIZE = float(sys.argv[1]) if len(sys.argv) > 1 else 0.0245
FILE = sys.argv[2] if len(sys.argv) > 2 else "ventilated-disc.msh"

gmsh.initialize()
gmsh.option.setNumber("General.Verbosity", 2)
occ = gmsh.model.occ


def ring(inner, outer, low, high):
    height = high - low
    whole = occ.addCylinder(0, 0, low, 0, 0, height, outer)
    hole = occ.addCylinder(0, 0, low, 0, 0, height, inner)
    return occ.cut([(3, whole)], [(3, hole)])[0][0]


def sector(inner, outer, low, high, first, last):
    arcs = []
    for radius in (inner, outer):
        points = [
            occ.addPoint(radius * math.cos(a), radius * math.sin(a), low) for a in (first, last)
        ]
        arcs.append((points, occ.addCircleArc(points[0], occ.addPoint(0, 0, low), points[1])))
    (a, b), inner_arc = arcs[0]
    (c, d), outer_arc = arcs[1]
    sides = [occ.addLine(a, c), occ.addLine(b, d)]
    face = occ.addPlaneSurface([occ.addCurveLoop([sides[0], outer_arc, -sides[1], -inner_arc])])
    bodies = occ.extrude([(2, face)], 0, 0, high - low)
    return next(body for body in bodies if body[0] == 3)


# The disc: cheeks, ribs cut to the radii of the cheeks, and the hat, fused.
parts = [ring(0.125, 0.175, 0.0, 0.010), ring(0.125, 0.175, 0.025, 0.035)]
for rib in range(21):
    angle = math.radians(4.004) + 2 * math.pi * rib / 21
    box = occ.addBox(0.11, -0.01435, 0.010, 0.08, 0.0287, 0.015)
    occ.rotate([(3, box)], 0, 0, 0, 0, 0, 1, angle)
    parts += occ.intersect([(3, box)], [ring(0.125, 0.175, 0.010, 0.025)])[0]
parts.append(ring(0.1125, 0.125, 0.0, 0.010))
parts.append(ring(0.105, 0.1125, 0.0, 0.075))
plate = ring(0.040, 0.105, 0.065, 0.075)
holes = []
for hole in range(5):
    angle = math.radians(18 + 72 * hole)
    x, y = 0.075 * math.cos(angle), 0.075 * math.sin(angle)
    holes.append((3, occ.addCylinder(x, y, 0.06, 0, 0, 0.02, 0.010)))
parts.append(occ.cut([plate], holes)[0][0])
disc = occ.fuse(parts[:1], parts[1:])[0]
assert len(disc) == 1, disc

bottom = sector(0.130, 0.1675, -0.015, 0.0, math.pi / 3, 2 * math.pi / 3)
top = sector(0.130, 0.1675, 0.035, 0.050, math.pi / 3, 2 * math.pi / 3)
occ.synchronize()


def faces(body):
    return [tag for _, tag in gmsh.model.getBoundary([body], oriented=False)]


def flat_at(body, z):
    found = []
    for tag in faces(body):
        box = gmsh.model.getBoundingBox(2, tag)
        if abs(box[2] - z) < 1e-5 and abs(box[5] - z) < 1e-5:
            found.append(tag)
    return found


def friction_ring(z):
    """Of the faces at a height those that reach the rim."""
    return [
        tag for tag in flat_at(disc[0], z) if gmsh.model.getBoundingBox(2, tag)[3] > 0.17
    ]


bolts = []
for tag in faces(disc[0]):
    box = gmsh.model.getBoundingBox(2, tag)
    is_upright = gmsh.model.getType(2, tag) == "Cylinder"
    is_low = abs(box[2] - 0.065) < 1e-4 and abs(box[5] - 0.075) < 1e-4
    if is_upright and is_low and max(abs(v) for v in box[:2] + box[3:5]) < 0.1:
        bolts.append(tag)
assert len(bolts) == 6, bolts

for name, body in [("disc", disc[0]), ("pad_bottom", bottom), ("pad_top", top)]:
    gmsh.model.addPhysicalGroup(3, [body[1]], name=name)
for name, tags in [
    ("bolts", bolts),
    ("disc_bottom", friction_ring(0.0)),
    ("disc_top", friction_ring(0.035)),
    ("lining_bottom", flat_at(bottom, 0.0)),
    ("lining_top", flat_at(top, 0.035)),
    ("back_bottom", flat_at(bottom, -0.015)),
    ("back_top", flat_at(top, 0.050)),
]:
    assert tags, name
    gmsh.model.addPhysicalGroup(2, tags, name=name)

gmsh.option.setNumber("Mesh.MeshSizeMin", SIZE)
gmsh.option.setNumber("Mesh.MeshSizeMax", SIZE)
gmsh.option.setNumber("Mesh.ElementOrder", 2)
gmsh.option.setNumber("Mesh.HighOrderOptimize", 2)
gmsh.option.setNumber("Mesh.HighOrderThresholdMin", 0.2)
gmsh.option.setNumber("Mesh.MshFileVersion", 4.1)
gmsh.option.setNumber("Mesh.Binary", 1)
gmsh.option.setNumber("General.NumThreads", 1)
gmsh.model.mesh.generate(3)

# Coarse elements along a tight arc may fold: their edges are made straight.
for _ in range(5):
    types, tags, nodes = gmsh.model.mesh.getElements(3)
    least, most = (
        gmsh.model.mesh.getElementQualities(tags[0], name) for name in ("minDetJac", "maxDetJac")
    )
    folded = [e for e in range(len(tags[0])) if least[e] < 0.2 * most[e]]
    if not folded:
        break
    print(f"{len(folded)} elements straightened")
    for element in folded:
        own = nodes[0][10 * element : 10 * element + 10]
        at = [gmsh.model.mesh.getNode(node)[0] for node in own]
        edges = [(0, 1), (1, 2), (0, 2), (0, 3), (2, 3), (1, 3)]
        for middle, (start, end) in enumerate(edges, start=4):
            place = (at[start] + at[end]) / 2
            gmsh.model.mesh.setNode(own[middle], place, [])
gmsh.write(FILE)
nodes = len(gmsh.model.mesh.getNodes()[0])
elements = sum(len(tags) for tags in gmsh.model.mesh.getElements(3)[1])
print(f"{nodes} nodes, {elements} tetrahedra")
for name, body in [("disc", disc[0]), ("pad", bottom)]:
    print(name, "volume", occ.getMass(3, body[1]), "m3")
gmsh.finalize()
