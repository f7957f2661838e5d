"""Reads the .vtp and .pvd files of a run: raw appended data, zlib blocks, UInt64 headers. Returns numpy arrays."""
import os
import re
import struct
import zlib

import numpy as np

TYPES = {"Float64": "<f8", "Float32": "<f4", "Int64": "<i8", "Int32": "<i4", "UInt8": "u1"}


def attributes(tag):
    return dict(re.findall(r'(\w+)="([^"]*)"', tag))


def block_data(data, start):
    """number of blocks, bytes of a block, bytes of a shorter last block or 0, compressed bytes of each; then the blocks."""
    count, _, _ = struct.unpack_from("<3Q", data, start)
    sizes = struct.unpack_from("<%dQ" % count, data, start + 24)
    at, parts = start + 24 + 8 * count, []
    for size in sizes:
        parts.append(zlib.decompress(data[at:at + size]))
        at += size
    return b"".join(parts)


def read_vtp(path):
    """({section: {name: array}}, ...): Points, PointData, CellData, Lines, Verts."""
    with open(path, "rb") as stream:
        data = stream.read()
    marker = data.index(b"<AppendedData")
    start = data.index(b"_", data.index(b">", marker)) + 1
    head = data[:marker].decode()
    file = attributes(re.search(r"<VTKFile[^>]*>", head).group())
    if file.get("header_type") != "UInt64" or file.get("byte_order") != "LittleEndian" or "ZLib" not in file.get("compressor", ""):
        raise ValueError("%s: not little-endian zlib with UInt64 headers" % path)
    arrays = {}
    for section in ("PointData", "CellData", "Points", "Lines", "Verts"):
        body = re.search(r"<%s[ >].*?</%s>|<%s>.*?</%s>" % ((section,) * 4), head, re.S)
        for tag in re.findall(r"<DataArray[^>]*>", body.group() if body else ""):
            a = attributes(tag)
            if a.get("format") != "appended":
                continue
            values = np.frombuffer(block_data(data, start + int(a["offset"])), TYPES[a["type"]])
            components = int(a.get("NumberOfComponents", 1))
            arrays.setdefault(section, {})[a.get("Name", section)] = values.reshape(-1, components) if components > 1 else values
    return arrays


def read_series(path):
    """[(time, file)] of a .pvd."""
    with open(path) as stream:
        text = stream.read()
    folder = os.path.dirname(path)
    result = []
    for tag in re.findall(r"<DataSet[^>]*>", text):
        a = attributes(tag)
        result.append((float(a["timestep"]), os.path.join(folder, a["file"])))
    return result
