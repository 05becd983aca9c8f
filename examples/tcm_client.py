#!/usr/bin/env python3
"""Listens to Touchline's robots, or tells them something. Written from docs/tcm.md alone.

tcm_client.py listen --bind 127.0.0.1:7499
tcm_client.py send --to 127.0.0.1:7400 --as "computer 0" --text "hello"
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
TYPES = {
    1: ("position", {**HEAD, "position": VEC2, "heading": VEC2, "configuration": (None, CONFIGURATION)}),
    2: ("have-ball", {**HEAD, "have_ball": (False, True), "role": U8}),
    3: ("goalie", {**HEAD, "behaviour": ("leaving", "entering"), "side": ("left", "centre", "right")}),
    5: ("values", {**HEAD, "values": [F32], "wish": (None, U8)}),
    6: ("book", {"distance": U32, "term": U32, "key": U32}),
    7: ("ball report", {"time": U32, "position": VEC2, "age": F32}),
    8: ("text", lambda data: take(data, u32(data)).decode()),
    9: ("LOCK", {"sequence": U32}),
    10: ("ACKLOCK", {"sequence": U32, "holds": (U8, CONFIGURATION)}),
    11: ("SWAP", {"sequence": U32, "order": (U8, [U8])}),
    12: ("ACKSWAP", {"sequence": U32}),
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
    print("ok")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", nargs="?", choices=["listen", "send"], default="listen")
    parser.add_argument("--self-test", action="store_true", help="decode the examples of docs/tcm.md")
    parser.add_argument("--bind", metavar="HOST:PORT", default="127.0.0.1:7499", help="where to listen")
    parser.add_argument("--to", metavar="HOST:PORT", default="127.0.0.1:7400", help="where to send")
    parser.add_argument("--as", dest="source", metavar="WHO", type=peer, default="computer 0")
    parser.add_argument("--for", dest="to_whom", metavar="WHO", type=peer, default="everybody")
    parser.add_argument("--text", default="hello")
    options = parser.parse_args()
    conn = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    host, port = (options.to if options.command == "send" else options.bind).rsplit(":", 1)
    if options.self_test:
        self_test()
    elif options.command == "listen":
        conn.bind((host, int(port)))
        listen(conn)
    else:
        text = options.text.encode()
        rest, length = len(text), b""
        while rest >= 128:
            rest, length = rest >> 7, length + bytes([rest & 127 | 128])
        counter = time.time_ns() // 1_000_000 % (1 << 32)
        for datagram in cut(options.source + b"\6", options.to_whom + b"\6", counter, 8, length + bytes([rest]) + text):
            conn.sendto(datagram, (host, int(port)))


if __name__ == "__main__":
    main()
