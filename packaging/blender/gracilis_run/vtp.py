"""Reads the surfaces of run folders (.vtp: appended, LZ4 or not compressed) with NumPy alone."""

import re
import struct

import numpy

types = {"Float32": "f4", "Float64": "f8", "Int8": "i1", "UInt8": "u1", "Int32": "i4", "UInt32": "u4", "Int64": "i8", "UInt64": "u8"}


def unpack_lz4(packed, size):
    """One block of LZ4: runs of literals, each followed by a copy from what came before."""
    out = bytearray()
    at = 0

    def length(nibble):
        nonlocal at
        total = nibble
        while nibble == 15:
            total += packed[at]
            at += 1
            if packed[at - 1] != 255:
                break
        return total

    while at < len(packed):
        token = packed[at]
        at += 1
        literals = length(token >> 4)
        out += packed[at:at + literals]
        at += literals
        if at >= len(packed):
            break
        distance = packed[at] | packed[at + 1] << 8
        at += 2
        count = length(token & 15) + 4
        begin = len(out) - distance
        if distance <= 0 or begin < 0:
            raise ValueError("not LZ4")
        piece = out[begin:begin + count]
        while len(piece) < count:  # a copy may run into what it writes
            piece += piece[:count - len(piece)]
        out += piece
    if len(out) != size:
        raise ValueError("not LZ4")
    return bytes(out)


def unpack(data, at, word, compressed):
    """The bytes of one array."""
    if not compressed:
        size, = struct.unpack_from(word, data, at)
        at += struct.calcsize(word)
        return data[at:at + size]
    step = struct.calcsize(word)
    blocks, whole, last = struct.unpack_from("<3" + word[1:], data, at)
    sizes = struct.unpack_from(f"<{blocks}" + word[1:], data, at + 3 * step)
    at += (3 + blocks) * step
    parts = []
    for i, size in enumerate(sizes):
        parts.append(unpack_lz4(data[at:at + size], last if i == blocks - 1 and last else whole))
        at += size
    return b"".join(parts)


def read_surface(path):
    """Points (n, 3) in metres, triangles (m, 3), and the names of the arrays that vertices have."""
    data = open(path, "rb").read()
    begin = data.index(b"<AppendedData")
    head, data = data[:begin].decode(), data[data.index(b"_", begin) + 1:]
    word = "<Q" if 'header_type="UInt64"' in head else "<I"
    compressed = "compressor=" in head
    if compressed and "vtkLZ4DataCompressor" not in head:
        raise ValueError(f"{path}: compressed by something else than LZ4")

    def array(text):
        offset = int(re.search(r'offset="(\d+)"', text)[1])
        return numpy.frombuffer(unpack(data, offset, word, compressed), "<" + types[re.search(r'type="(\w+)"', text)[1]])

    points = array(re.search(r"<Points>(.*?)</Points>", head, re.S)[1]).reshape(-1, 3)
    polys = re.search(r"<Polys>(.*?)</Polys>", head, re.S)[1]
    corners = array(re.search(r'<DataArray[^>]*Name="connectivity"[^>]*>', polys)[0])
    vertex_data = re.search(r"<PointData(.*?)</PointData>", head, re.S)
    names = re.findall(r'Name="([^"]*)"', vertex_data[1]) if vertex_data else []
    return points, corners.reshape(-1, 3), names
