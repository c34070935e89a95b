"""Reads .vtp, .vtr, .vtu and .pvd files without VTK and prints "name values sum" of their point and cell arrays, or the
files of a series. Knows ASCII and appended raw data, compressed by zlib or not."""
import struct
import sys
import xml.etree.ElementTree as ET
import zlib

FORMATS = {"Float64": "d", "Float32": "f", "Int64": "q", "Int32": "i", "UInt8": "B", "UInt32": "I", "UInt64": "Q"}


def split(content):
    """The markup, and the appended data behind its underscore."""
    at = content.find(b"<AppendedData")
    if at < 0:
        return ET.fromstring(content), b""
    return ET.fromstring(content[:at] + b"</VTKFile>"), content[content.index(b"_", at) + 1 :]


def values(array, root, appended):
    kind = FORMATS[array.get("type")]
    if array.get("format") == "ascii":
        return [float(word) for word in array.text.split()]
    head = {"UInt32": "I", "UInt64": "Q"}[root.get("header_type", "UInt32")]
    width = struct.calcsize(head)
    data = appended[int(array.get("offset")) :]

    def words(count, start=0):
        return struct.unpack_from("<%d%s" % (count, head), data, start)

    if root.get("compressor"):
        blocks = words(1)[0]
        sizes, at, parts = words(blocks, 3 * width), (3 + blocks) * width, []
        for size in sizes:
            parts.append(zlib.decompress(data[at : at + size]))
            at += size
        data = b"".join(parts)
    else:
        data = data[width : width + words(1)[0]]
    return struct.unpack("<%d%s" % (len(data) // struct.calcsize(kind), kind), data)


def main(name):
    with open(name, "rb") as file:
        root, appended = split(file.read())
    for dataset in root.iter("DataSet"):
        print(dataset.get("file"))
    for place in ("PointData", "CellData"):
        for group in root.iter(place):
            for array in group:
                numbers = values(array, root, appended)
                total = 0.0
                for number in numbers:
                    total += number
                print("%s %d %.17g" % (array.get("Name"), len(numbers), total))


main(sys.argv[1])
