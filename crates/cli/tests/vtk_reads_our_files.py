"""Our .vtu files, read and evaluated by VTK itself, and VTK's files, read by us.

usage: vtk_reads_our_files.py PROGRAM FOLDER-OF-MODELS SCRATCH

Exit status 0 all agrees, 1 something differs, 77 there is no VTK.
"""

import json
import random
import re
import subprocess
import sys
from pathlib import Path

try:
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError as error:
    print(f"no VTK: {error}")
    sys.exit(77)

PROGRAM, MODELS, SCRATCH = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])
# In units of the size of the shape.
TOLERANCE = 1e-14
PLACES = 40
rng = random.Random(20240229)


def run(*words):
    done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True)
    assert done.returncode == 0, f"{words}: {done.stderr}"
    return done.stdout


def point():
    return [rng.uniform(-1, 1) for _ in range(3)]


def weight():
    return rng.uniform(0.5, 2.0)


def shape(kind, degree, shape_of, rational):
    """A random shape: its net is nested as `shape_of` says."""

    def nest(sizes, leaf):
        return leaf() if not sizes else [nest(sizes[1:], leaf) for _ in range(sizes[0])]

    made = {"kind": kind, "degree": degree, "control_points": nest(shape_of, point)}
    if rational:
        made["weights"] = nest(shape_of, weight)
    return made


def simplex(dimension, n):
    count = 1
    for i in range(1, dimension + 1):
        count = count * (n + i) // i
    return count


def random_shapes():
    for rational in [False, True]:
        for n in [1, 2, 3, 6]:
            yield shape("curve", n, [n + 1], rational)
        for n in [1, 2, 4, 7]:
            yield shape("triangle", n, [simplex(2, n)], rational)
        for m, n in [(1, 1), (2, 3), (5, 1)]:
            yield shape("patch", [m, n], [m + 1, n + 1], rational)
        for n in [1, 2, 3, 4, 5, 8]:
            yield shape("tetrahedron", n, [simplex(3, n)], rational)
        for l, m, n in [(1, 1, 1), (2, 2, 2), (1, 2, 3), (4, 3, 2), (3, 1, 5)]:
            yield shape("hexahedron", [l, m, n], [l + 1, m + 1, n + 1], rational)
        for n, o in [(1, 1), (2, 1), (1, 3), (3, 2), (5, 4)]:
            yield shape("wedge", [n, o], [simplex(2, n), o + 1], rational)
    # A control point of weight 0 contributes nothing.
    silent = shape("hexahedron", [2, 1, 1], [3, 2, 2], True)
    silent["weights"][1][0][1] = 0.0
    yield silent
    # Of degree 0 along some parameter, which becomes degree 1.
    yield shape("hexahedron", [2, 0, 1], [3, 1, 2], True)
    yield shape("wedge", [0, 2], [1, 3], True)


def places(kind):
    """Random parameters, of as many numbers as the kind takes."""
    if kind == "curve":
        return [rng.random()]
    if kind == "patch":
        return [rng.random(), rng.random()]
    if kind == "triangle":
        cuts = sorted([rng.random(), rng.random()])
        return [cuts[0], cuts[1] - cuts[0]]
    if kind == "tetrahedron":
        cuts = sorted([rng.random() for _ in range(3)])
        return [cuts[0], cuts[1] - cuts[0], cuts[2] - cuts[1]]
    if kind == "wedge":
        cuts = sorted([rng.random(), rng.random()])
        return [cuts[0], cuts[1] - cuts[0], rng.random()]
    return [rng.random() for _ in range(3)]


def read_grid(path):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def numbers(text, name):
    body = re.search(rf'<DataArray[^>]*Name="{name}"[^>]*>(.*?)</DataArray>', text, re.S).group(1)
    return [float(word) for word in body.split()]


def compare(model):
    """The largest distance between VTK's points and ours, in units of the shapes' sizes."""
    path = SCRATCH / (model.stem + ".vtu")
    run("convert", model, path)
    grid = read_grid(path)
    text = path.read_text()
    assert vtk_to_numpy(grid.GetPoints().GetData()).ravel().tolist() == numbers(text, "Points"), "bits of points"
    weights = vtk_to_numpy(grid.GetPointData().GetRationalWeights()).ravel().tolist()
    assert weights == numbers(text, "RationalWeights"), "bits of weights"
    infos = [json.loads(line) for line in run("info", path, "--json").splitlines()]
    assert grid.GetNumberOfCells() == len(infos)
    worst = 0.0
    for index, info in enumerate(infos):
        chosen = [places(info["kind"]) for _ in range(PLACES)]
        params = SCRATCH / "params.txt"
        params.write_text("".join(",".join(map(repr, place)) + "\n" for place in chosen))
        # Of the file that VTK reads, too: its parameters run over [0, 1].
        answers = run("eval", path, "--shape", index, "--params", params, "--json").splitlines()
        cell = grid.GetCell(index)
        bounds = cell.GetBounds()
        size = sum((bounds[2 * axis + 1] - bounds[2 * axis]) ** 2 for axis in range(3)) ** 0.5
        for place, answer in zip(chosen, answers):
            found, sub = [0.0] * 3, vtk.reference(0)
            basis = [0.0] * cell.GetNumberOfPoints()
            cell.EvaluateLocation(sub, (place + [0.0, 0.0])[:3], found, basis)
            ours = json.loads(answer)["point"]
            distance = sum((a - b) ** 2 for a, b in zip(found, ours)) ** 0.5 / size
            worst = max(worst, distance)
            assert distance <= TOLERANCE, f"{model}, cell {index} at {place}: {ours}, VTK {found}"
    return worst, len(infos)


def encodings(model):
    """VTK writes what it read of ours, in every way that it can; we read it, and write the same bytes again."""
    ours = SCRATCH / (model.stem + ".vtu")
    run("convert", model, ours)
    grid, count = read_grid(ours), 0
    for mode, encoded in [("Ascii", 0), ("Binary", 0), ("Appended", 0), ("Appended", 1)]:
        for compressor in [None, vtk.vtkZLibDataCompressor()]:
            for header in ["SetHeaderTypeToUInt32", "SetHeaderTypeToUInt64"]:
                for order in ["SetByteOrderToLittleEndian", "SetByteOrderToBigEndian"]:
                    writer = vtk.vtkXMLUnstructuredGridWriter()
                    theirs, back = SCRATCH / "theirs.vtu", SCRATCH / "back.vtu"
                    writer.SetFileName(str(theirs))
                    writer.SetInputData(grid)
                    getattr(writer, f"SetDataModeTo{mode}")()
                    writer.SetEncodeAppendedData(encoded)
                    writer.SetCompressor(compressor)
                    writer.SetBlockSize(1024)
                    getattr(writer, header)()
                    getattr(writer, order)()
                    assert writer.Write() == 1
                    run("convert", theirs, back)
                    what = f"{mode} {encoded} {compressor is not None} {header} {order}"
                    assert back.read_bytes() == ours.read_bytes(), what
                    count += 1
    return count


def old_versions(model):
    """Files of a version before 2.1 are read with the order of nodes that VTK takes them to have."""
    ours = SCRATCH / (model.stem + ".vtu")
    run("convert", model, ours)
    old, back = SCRATCH / "old.vtu", SCRATCH / "old_back.vtu"
    old.write_text(ours.read_text().replace('version="2.2"', 'version="2.0"'))
    run("convert", old, back)
    seen, ours_seen = read_grid(old), read_grid(back)
    assert ours.read_bytes() != back.read_bytes(), "no edge was exchanged"
    for index in range(seen.GetNumberOfCells()):
        a, b = seen.GetCell(index).GetPoints(), ours_seen.GetCell(index).GetPoints()
        for node in range(a.GetNumberOfPoints()):
            assert a.GetPoint(node) == b.GetPoint(node), f"cell {index}, node {node}"


def main():
    print("VTK", vtk.VTK_VERSION)
    random_model = SCRATCH / "random.json"
    random_model.write_text(json.dumps({"casteljau": 1, "shapes": list(random_shapes())}))
    worst, count = compare(random_model)
    for model in sorted(MODELS.glob("*.json")):
        kinds = {shape["kind"] for shape in json.loads(model.read_text())["shapes"]}
        if "gb_patch" not in kinds:
            largest, cells = compare(model)
            worst, count = max(worst, largest), count + cells
    print(f"{count} cells evaluated by VTK at {PLACES} places each: at most {worst:.1e} of the size away")
    print(f"{encodings(random_model)} encodings of VTK read back to the same bytes")
    old_versions(random_model)
    print("files before version 2.1 are read as VTK reads them")


main()
