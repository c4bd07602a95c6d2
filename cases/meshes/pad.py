"""Writes pad.msh: a disc, and a lining on a steel backplate before its rim; python3 pad.py

python3 pad.py pressed writes pressed-pad.msh, half as fine, with the ends of the backplate as boundaries of their own.
"""
from math import cos, pi, sin
from sys import argv

HUB, RIM, LINING, BACK = 0.045, 0.110, 0.122, 0.130  # radii, m
SPAN = 56 * pi / 180  # the pad's angle
AROUND, PAD = 132, 26  # elements around the disc and along the pad: they do not match
ENDS = argv[1:] == ["pressed"]
if ENDS:
    AROUND, PAD = 96, 18

nodes, lines, quads = [], [], []


def ring(radii, angles, closed, edges, regions):
    """Rows of elements between radii; edges name the first and the last row, regions each layer of elements."""
    rows = []
    for r in radii:
        row = []
        for t in angles:
            nodes.append((r * cos(t), r * sin(t)))
            row.append(len(nodes))
        rows.append(row + row[:1] if closed else row)
    for below, above, region in zip(rows, rows[1:], regions):
        for k in range(len(below) - 1):
            quads.append((region, below[k], above[k], above[k + 1], below[k + 1]))
    for name, row in zip(edges, (rows[0], rows[-1])):
        lines.extend((name, p, q) for p, q in zip(row, row[1:]))


def steps(a, b, count):
    return [a + (b - a) * i / count for i in range(count + 1)]


across = 8 if ENDS else 12
ring(steps(HUB, RIM, across), steps(0, 2 * pi, AROUND)[:-1], True, ("hub", "rim"), ["disc"] * across)
layers = steps(RIM, LINING, 3) + steps(LINING, BACK, 2)[1:]
angles = steps(pi / 2 - SPAN / 2, pi / 2 + SPAN / 2, PAD)
ring(layers, angles, False, ("lining", "back"), ["pad"] * 3 + ["backplate"] * 2)

curves = ["hub", "rim", "lining", "back"]
if ENDS:
    first = len(nodes) - 3 * (PAD + 1) + 1  # the backplate has the last three rows of nodes
    for name, column in (("leading", 0), ("trailing", PAD)):
        ends = [first + row * (PAD + 1) + column for row in range(3)]
        lines.extend((name, p, q) for p, q in zip(ends, ends[1:]))
    curves += ["leading", "trailing"]

tags = {name: tag for tag, name in enumerate(curves + ["disc", "pad", "backplate"], 1)}
with open("pressed-pad.msh" if ENDS else "pad.msh", "w") as out:
    out.write("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n%d\n" % len(tags))
    for name, tag in tags.items():
        out.write('%d %d "%s"\n' % (1 if name in curves else 2, tag, name))
    out.write("$EndPhysicalNames\n$Nodes\n%d\n" % len(nodes))
    for k, (x, y) in enumerate(nodes, 1):
        out.write("%d %.15g %.15g 0\n" % (k, x, y))
    out.write("$EndNodes\n$Elements\n%d\n" % (len(lines) + len(quads)))
    for k, (name, *of) in enumerate(lines + quads, 1):
        kind = 1 if len(of) == 2 else 3
        out.write("%d %d 2 %d %d %s\n" % (k, kind, tags[name], tags[name], " ".join(map(str, of))))
    out.write("$EndElements\n")
