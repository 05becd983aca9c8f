#!/usr/bin/env python3
"""Listens to Touchline's robots, tells them something, or fetches a picture. Written from docs/tcm.md alone.

tcm_client.py listen --bind 127.0.0.1:7499
tcm_client.py send --to 127.0.0.1:7400 --as "computer 0" --text "hello"
tcm_client.py image --to 127.0.0.1:7500 --for "home 1" --file picture.ppm
tcm_client.py --self-test
"""

import argparse
import io
import re
import socket
import struct
import time

HEADER = struct.Struct("<3sB4s4sIIHHHH")
MODULES = ["world model", "claims", "goalie", "role swap", "policy", "ball booking", "ChaosManager", "remote robots"]
TEAMS = ["home", "away"]
VERSION = 2
PIECE, LONGEST, UNFINISHED, PATIENCE = 1400 - HEADER.size, 1 << 20, 64, 1.0  # bytes, bytes, messages, s


def names(address):
    """An address's peer and module as people write them."""
    kind, team, number, module = address
    if kind > 3 or (kind in (1, 3) and team) or (kind in (2, 3) and number):
        raise ValueError("nobody's address")
    side = TEAMS[team] if team < 2 else f"team {team}"
    peer = [f"{side} {number}", f"computer {number}", side, "everybody"][kind]
    return peer, MODULES[module] if module < len(MODULES) else f"module {module}"


def peer(name):
    """The three bytes of a peer."""
    word, *numbers = re.sub("^home", "team 0", re.sub("^away", "team 1", name.lower())).replace(":", " ").split()
    numbers = tuple(map(int, numbers))
    kinds = {("team", 2): (0, *numbers), ("computer", 1): (1, 0, *numbers), ("team", 1): (2, *numbers, 0)}
    return bytes({**kinds, ("everybody", 0): (3, 0, 0)}.get((word, len(numbers)), [-1]))


def cut(source, destination, counter, data_type, data):
    pieces = [data[at : at + PIECE] for at in range(0, len(data), PIECE)] or [b""]
    for index, piece in enumerate(pieces):
        about = (counter, len(data), data_type, index, len(pieces), len(piece))
        yield HEADER.pack(b"TCM", VERSION, source, destination, *about) + piece


def read(datagram):
    """The source, the counter, what all fragments of the message have in common, the index and the piece."""
    head, piece = datagram[: HEADER.size], datagram[HEADER.size :]
    if len(head) < HEADER.size or head[:4] != bytes([*b"TCM", VERSION]):
        raise ValueError("not of the TCM, or of another version")
    _, _, source, destination, counter, total, data_type, index, count, length = HEADER.unpack(head)
    addresses = names(source) and names(destination) and source[0] < 2
    if not (addresses and index < count and length == len(piece) and total <= LONGEST):
        raise ValueError("the header contradicts itself, or the message is too long")
    others, last_one = count - 1, index == count - 1
    step = (total - length) // others if others and last_one else length
    last = total - step * others
    if length != (last if last_one else step) or (others and not 1 <= last <= step):
        raise ValueError("the piece does not fit the message")
    return source, counter, (source[3], destination, data_type, total, count, step), index, piece


class Assembly:
    """Puts messages together; the newest wins. One that is over is remembered for a while, without pieces."""

    def __init__(self):
        self.messages = {}

    def accept(self, datagram, now=0.0):
        """Source, destination, data type and data of the message that this completes, or None."""
        source, counter, shape, index, piece = read(datagram)
        key, count = (source[:3], counter), shape[4]
        self.messages = {old: entry for old, entry in self.messages.items() if now - entry[1] < PATIENCE}
        known, since, pieces = self.messages.get(key, (shape, now, {}))
        if known != shape or (pieces and pieces.get(index, piece) != piece):
            del self.messages[key]
            since, pieces = now, {}
        if count == 1 or pieces is None:
            return (source, *shape[1:3], piece) if count == 1 else None
        pieces[index] = piece
        over = len(pieces) == count
        self.messages[key] = (shape, now, None) if over else (shape, since, pieces)
        if len(self.messages) > UNFINISHED:
            del self.messages[next(iter(self.messages))]
        return (source, *shape[1:3], b"".join(pieces[place] for place in range(count))) if over else None


def take(data, length):
    taken = data.read(length)
    if len(taken) == length:
        return taken
    raise ValueError("the data end too early")


def u32(data):
    value = 0
    for place in range(5):
        byte = take(data, 1)[0]
        value |= (byte & 127) << (7 * place)
        if byte < 128 and value < 1 << 32:
            return value
    raise ValueError("no number")


def value(kind, data):
    """From the front of the data: of a dict its fields, of a list many of its one kind, of a tuple a variant."""
    if isinstance(kind, dict):
        return {name: value(inner, data) for name, inner in kind.items()}
    if isinstance(kind, list):
        return [value(kind[0], data) for _ in range(u32(data))]
    if isinstance(kind, tuple):
        return value(kind[u32(data)], data)
    return kind(data) if callable(kind) else kind


U8, U32, F32 = lambda data: take(data, 1)[0], u32, lambda data: struct.unpack("<f", take(data, 4))[0]
VEC2, HEAD = {"x": F32, "y": F32}, {"time": U32, "robot": U8}
CONFIGURATION = {"epoch": U32, "initiator": U8, "roles": [U8]}
BYTES, BOOL = lambda data: take(data, u32(data)), (False, True)
STRING, POSE, GAZE = lambda data: BYTES(data).decode(), {**VEC2, "heading": F32}, {"pan": F32, "tilt": F32}
STEERING = ("stop", {"heading": F32, "facing": F32, "speed": F32}, {"turn": F32})
PIXELS = {"hits": U32, "missed": U32, "false_alarms": U32}
COLOURS = ("orange", "yellow", "sky blue", "pink", "red", "dark blue", "white", "green")
DEBUG = {
    **{"number": U32, "tick": U32, "pose": POSE, "is_localised": BOOL},
    "ball": (None, {"position": VEC2, "velocity": VEC2, "age": F32}),
    **{"role": STRING, "acting_as": STRING, "states": [STRING], "steering": STEERING},
    **{"kick": ("nothing", "hold", U32), "head": {"pan": F32, "speed": F32}, "is_driven": BOOL},
    "quality": (None, {**{colour: PIXELS for colour in COLOURS}, "pictures": U32}),
}
TYPES = {
    1: ("position", {**HEAD, "position": VEC2, "heading": VEC2, "configuration": (None, CONFIGURATION)}),
    2: ("have-ball", {**HEAD, "have_ball": (False, True), "role": U8}),
    3: ("goalie", {**HEAD, "behaviour": ("leaving", "entering"), "side": ("left", "centre", "right")}),
    5: ("values", {**HEAD, "values": [F32], "wish": (None, U8)}),
    6: ("book", {"distance": U32, "term": U32, "key": U32}),
    7: ("ball report", {"time": U32, "position": VEC2, "age": F32}),
    8: ("text", STRING),
    9: ("LOCK", {"sequence": U32}),
    10: ("ACKLOCK", {"sequence": U32, "holds": (U8, CONFIGURATION)}),
    11: ("SWAP", {"sequence": U32, "order": (U8, [U8])}),
    12: ("ACKSWAP", {"sequence": U32}),
    22: ("image", {"number": U32, "tick": U32, "width": U32, "height": U32, "gaze": GAZE, "pixels": BYTES}),
    24: ("debug data", DEBUG),
    29: ("answer", {"number": U32, "outcome": ("accepted", {"what": STRING, "why": STRING})}),
}


def decode(data_type, data):
    """The type's name and its value; the bytes if it is none of ours."""
    name, kind = TYPES.get(data_type, (f"type {data_type}", lambda rest: rest.read().hex(" ")))
    rest = io.BytesIO(data)
    decoded = value(kind, rest)
    if not rest.read():
        return name, decoded
    raise ValueError("something follows the data")


def listen(conn):
    assembly = Assembly()
    while True:
        datagram, sender = conn.recvfrom(65536)
        try:
            message = assembly.accept(datagram, time.monotonic())
            if message:
                (source, module), (to, _) = names(message[0]), names(message[1])
                print(f"{source} ({module}) to {to}:", *decode(*message[2:]), flush=True)
        except (ValueError, IndexError) as error:
            print(f"from {sender[0]}:{sender[1]}: {error}", flush=True)


def varint(number):
    return bytes([number]) if number < 128 else bytes([number & 127 | 128]) + varint(number >> 7)


def ppm(picture):
    """The bytes of a PPM file: Y, U and V of each pixel as red, green and blue."""
    rgb, pixels = bytearray(), picture["pixels"]
    for y, u, v in zip(pixels[::3], pixels[1::3], pixels[2::3]):
        u, v = u - 128, v - 128
        for colour in (y + 1.402 * v, y - 0.344136 * u - 0.714136 * v, y + 1.772 * u):
            rgb.append(min(255, max(0, round(colour))))
    return b"P6\n%d %d\n255\n" % (picture["width"], picture["height"]) + rgb


def fetch_image(conn, source, robot, match, patience):
    """Asks for pictures twice a second until one is whole. A match has pictures, data and orders at three ports in a row."""
    assembly, begin, asked = Assembly(), time.monotonic(), 0.0
    conn.settimeout(0.1)
    while (now := time.monotonic()) < begin + patience:
        if now > asked + 0.5:
            asked, counter = now, time.time_ns() // 1_000_000 % (1 << 32)
            wanted = varint(counter) + struct.pack("<ff", 10.0, 0.0)
            for datagram in cut(source + b"\6", robot + b"\6", counter, 21, wanted):
                conn.sendto(datagram, (match[0], match[1] + 2))
        try:
            message = assembly.accept(conn.recv(65536), now)
        except (TimeoutError, ConnectionError):
            continue
        name, data = decode(*message[2:]) if message else (None, None)
        if name == "answer" and data["outcome"] != "accepted":
            raise SystemExit(f"refused: {data['outcome']['why']}")
        if name == "image":
            return data
    raise SystemExit(f"no whole picture has come from {match[0]}:{match[1]} within {patience} s")


def self_test():
    """The examples of docs/tcm.md."""
    text = bytes.fromhex("54434D02 01000006 00010206 07000000 06000000 0800 0000 0100 0600 0568656C6C6F")
    head = "54434D02 00000300 02000000 02010000 14000000 0100"
    first = bytes.fromhex(head + "0000 0200 1000 DC0B 03 0000C03F 000080BE 0000803F 00")
    second = bytes.fromhex(head + "0100 0200 0400 000000 00")
    position = dict(time=1500, robot=3, position=dict(x=1.5, y=-0.25), heading=dict(x=1.0, y=0.0), configuration=None)
    assembly = Assembly()
    assert [text] == list(cut(peer("computer 0") + b"\6", peer("away 2") + b"\6", 7, 8, b"\5hello"))
    assert decode(*assembly.accept(text)[2:]) == ("text", "hello") and assembly.accept(second) is None
    source, to, *data = assembly.accept(first)
    assert (names(source)[0], names(to)[0], decode(*data)) == ("home 3", "home", ("position", position))
    assert assembly.accept(first) is None
    image = decode(22, bytes.fromhex("01 AC02 02 01 0000003F 000080BE 06 010203 040506"))
    picture = dict(number=1, tick=300, width=2, height=1, gaze=dict(pan=0.5, tilt=-0.25), pixels=bytes(range(1, 7)))
    assert image == ("image", picture) and varint(300) == b"\xac\2"
    assert ppm({**picture, "pixels": bytes([90, 128, 128, 255, 128, 128])}) == b"P6\n2 1\n255\nZZZ\xff\xff\xff"
    assert decode(29, bytes.fromhex("AC02 00"))[1] == dict(number=300, outcome="accepted")
    assert decode(29, b"\1\1\x08strategy\2no")[1]["outcome"] == dict(what="strategy", why="no")
    print("ok")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", nargs="?", choices=["listen", "send", "image"], default="listen")
    parser.add_argument("--self-test", action="store_true", help="decode the examples of docs/tcm.md")
    parser.add_argument("--bind", metavar="HOST:PORT", default="127.0.0.1:7499", help="where to listen")
    parser.add_argument("--to", metavar="HOST:PORT", default="127.0.0.1:7400", help="where to send")
    parser.add_argument("--as", dest="source", metavar="WHO", type=peer, default="computer 0")
    parser.add_argument("--for", dest="to_whom", metavar="WHO", type=peer, default="everybody")
    parser.add_argument("--text", default="hello")
    parser.add_argument("--file", default="picture.ppm", help="where to write a picture, as PPM")
    parser.add_argument("--timeout", metavar="SECONDS", type=float, default=5.0, help="how long to wait for one")
    options = parser.parse_args()
    conn = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    host, port = (options.bind if options.command == "listen" else options.to).rsplit(":", 1)
    if options.self_test:
        self_test()
    elif options.command == "listen":
        conn.bind((host, int(port)))
        listen(conn)
    elif options.command == "image":
        match, robot = (host, int(port)), options.to_whom
        picture = fetch_image(conn, options.source, robot, match, options.timeout)
        with open(options.file, "wb") as file:
            file.write(ppm(picture))
    else:
        text = options.text.encode()
        counter = time.time_ns() // 1_000_000 % (1 << 32)
        for datagram in cut(options.source + b"\6", options.to_whom + b"\6", counter, 8, varint(len(text)) + text):
            conn.sendto(datagram, (host, int(port)))


if __name__ == "__main__":
    main()
