"""How a file is spoilt: seeded changes of bytes, tokens, lines, numbers, keys, depth, and of parts of JSON."""

import json
import re

TOKEN = re.compile(rb"[A-Za-z_][\w.-]*|[+-]?\d+(?:\.\d+)?(?:[eE][+-]?\d+)?|\s+|.", re.DOTALL)
NUMBER = re.compile(rb"[+-]?\d+(?:\.\d+)?(?:[eE][+-]?\d+)?")
KEY = re.compile(rb'"?[A-Za-z_][\w-]*"?(?=\s*:)')
NUMBERS = [
    b"0", b"-0", b"-1", b"1e308", b"-1e308", b"1e-320", b"1e400", b"1e99999999999", b"1" + b"0" * 400, b"9" * 5000,
    b"0x" + b"f" * 300, b"0o17", b"0b1", b"1_0", b"-_", b"nan", b"NaN", b".nan", b"inf", b"Infinity", b"-.inf", b"null",
    b"true", b"1e9", b"1e-9", b"1e-30", b"2147483648", b"18446744073709551616", b"0.1", b"1.", b".5", b"1,5", b"1:30",
    b"2001-01-01", b"2001-99-99", "٣".encode(), "²".encode(), b"1e5", b"", b'""', b"[]", b"{}", b'"1"', b"001",
]  # fmt: skip
ODD = [
    b"\0", b"\xff", b"\xef\xbb\xbf", b"\xff\xfe", b"\xed\xa0\x80", b"\\ud800", b'"\\ud800"', b'"\\uDFFF\\ud800"', b'"\\UFFFFFFFF"',
    b"\\0", b"\r", b"\t", b"\x85", "\u2028".encode(), "\U0001f600".encode(), b"&a ", b"*a", b"&a *a", b"<<: *a", b"<<: [*a, *a]", b"!!int ",
    b"!!python/object:os.system ", b"!!binary ", b"!!set ", b"! ", b"%YAML 1.1\n---\n", b"%TAG ! x\n", b"---\n", b"...\n", b"- ", b"? ", b"| ",
    b"> ", b"|9\n", b"#", b"'", b'"', b"{", b"}", b"[", b"]", b":", b",", b";", b"@", b"`", b"=", b"/dev/zero", b"../", b"a[b[1].c", b".", b"[1]",
]  # fmt: skip
DEPTHS = (3, 40, 60, 900, 3000, 30_000)
CHANGES = (1, 1, 1, 2, 4)  # of one file
LARGEST = 100_000  # bytes that a file grows to
REPEATS = (2, 10, 1000)


def mutate(rng, content: bytes, others: list[bytes]) -> bytes:
    """One file after some changes; `rng` is a random.Random, `others` are files that parts are taken from."""
    ways, weights = list(MUTATIONS), list(MUTATIONS.values())
    for _ in range(rng.choice(CHANGES)):
        (way,) = rng.choices(ways, weights)
        content = way(rng, content, others)[:LARGEST]
    return content


def _place(rng, content: bytes) -> int:
    return rng.randint(0, len(content))


def flip(rng, content, _):
    """Some bytes become others."""
    spoilt = bytearray(content)
    for _ in range(rng.randint(1, 4) if content else 0):
        spoilt[rng.randrange(len(spoilt))] = rng.randrange(256)
    return bytes(spoilt)


def splice(rng, content, others):
    """Tokens of another file stand for some of this one."""
    mine, theirs = TOKEN.findall(content), TOKEN.findall(rng.choice(others))
    start, length = rng.randint(0, len(mine)), rng.randint(0, 8)
    begin = rng.randint(0, len(theirs))
    mine[start : start + length] = theirs[begin : begin + rng.randint(1, 8)]
    return b"".join(mine)


def replace_number(rng, content, _):
    """A number becomes an extreme one, or what is none."""
    found = list(NUMBER.finditer(content))
    if not found:
        return content
    match = rng.choice(found)
    return content[: match.start()] + rng.choice(NUMBERS) + content[match.end() :]


def change_lines(rng, content, _):
    """Lines are left out, said again, or change places."""
    lines = content.splitlines(keepends=True) or [b""]
    place, other = rng.randrange(len(lines)), rng.randrange(len(lines))
    way = rng.randrange(3)
    if way == 0:
        lines[place : place + rng.randint(1, 3)] = []
    elif way == 1:
        lines[place:place] = lines[other : other + 1] * rng.choice(REPEATS)
    else:
        lines[place], lines[other] = lines[other], lines[place]
    return b"".join(lines)


def delete(rng, content, _):
    """A part, or the end, is left out."""
    start = _place(rng, content)
    end = len(content) if rng.random() < 0.3 else start + rng.randint(1, 30)
    return content[:start] + content[end:]


def nest(rng, content, _):
    """Brackets, closed or not, about what stands somewhere."""
    start = _place(rng, content)
    end, depth = min(len(content), start + rng.randint(0, 10)), rng.choice(DEPTHS)
    opening, closing = rng.choice([(b"[", b"]"), (b"{a: ", b"}"), (b'{"a": ', b"}"), (b"- ", b"")])
    inner = content[start:end]
    return (
        content[:start]
        + opening * depth
        + inner
        + (closing * depth if rng.random() < 0.7 else b"")
        + content[end:]
    )


def swap_keys(rng, content, others):
    """A key gets the name of another one, of this file or another."""
    found, names = list(KEY.finditer(content)), KEY.findall(rng.choice([content, *others]))
    if not found or not names:
        return content
    match = rng.choice(found)
    return content[: match.start()] + rng.choice(names) + content[match.end() :]


def insert(rng, content, _):
    """Odd characters and words, once or many times."""
    start = _place(rng, content)
    return content[:start] + rng.choice(ODD) * rng.choice((1, 1, 1, *REPEATS)) + content[start:]


def encode(rng, content, _):
    """The text in another encoding."""
    return content.decode("latin-1").encode(rng.choice(["utf-16", "utf-32", "utf-8-sig", "utf-16-le"]))


def swap_parts(rng, content, others):
    """Of two parts of a JSON file one stands in the place of the other; token splices in other files."""
    try:
        document = json.loads(content)
    except (ValueError, RecursionError):
        return splice(rng, content, others)
    places = list(_places(document))
    if not places:
        return content
    (holder, key), (other, name) = rng.choice(places), rng.choice(places)
    text = json.dumps(other[name])
    holder[key] = json.loads(text) if rng.random() < 0.8 else None
    return json.dumps(document).encode()


def _places(data):
    """(holder, key) of every value in plain data."""
    for key in data if isinstance(data, dict) else range(len(data)) if isinstance(data, list) else ():
        yield data, key
        yield from _places(data[key])


MUTATIONS = {  # and how often each is chosen: most inputs get past the parser
    flip: 4,
    splice: 6,
    replace_number: 12,
    change_lines: 4,
    delete: 3,
    nest: 2,
    swap_keys: 6,
    insert: 4,
    swap_parts: 10,
    encode: 1,
}
