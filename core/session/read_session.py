"""Reads a session of dibhr, schemas 2 to 4 as FORMAT.md states them, with nothing but Python (and, for the
surface, libzstd, which every distribution has).
python3 read_session.py SESSION              its tables but for ticks, maps and surface, an object of JSON a line
python3 read_session.py SESSION T.csv        also every tick, decoded from tick_data, as dibhr export
python3 read_session.py SESSION T.csv L.csv  also the level under each proxy, "nan" where none is stored"""
import csv, ctypes, ctypes.util, functools, json, pathlib, sqlite3, struct, sys

NAMES = ("t gx gy gz px py pz fx fy fz cx cy cz contact primitive i j moves ns tick utc_s video_s "
         "blend frame to_frame pair source settings dt_s lateness_us buttons cut surface ready "
         "stand_in restart lets_go refused ox oy oz").split()


def time(cell, per_unit=1e9):  # whole nanoseconds, or else a real in the unit itself
    return cell / per_unit if isinstance(cell, int) else cell


def ticks(db):
    parameters = {row["version"]: row for row in db.execute("SELECT * FROM parameters")}
    pairs = {row["id"]: row for row in db.execute("SELECT * FROM pair")}
    clocks = [tuple(row) for row in db.execute("SELECT t_ns, utc_s FROM clock ORDER BY t_ns")]
    clock, before = -1, None
    for d in db.execute("SELECT * FROM tick_data ORDER BY tick"):
        bits = lambda shift, mask=1: d["state"] >> shift & mask
        three = lambda letter, other: [b if d[letter + a] is None else d[letter + a]
                                       for a, b in zip("xyz", other)]
        held, pair, t, cut = parameters.get(d["settings"]), pairs.get(d["pair"]), time(d["t"]), bits(17, 7)
        t_ns = d["t"] if isinstance(d["t"], int) else d["t"] * 1e9
        while clock + 1 < len(clocks) and clocks[clock + 1][0] <= t_ns:
            clock += 1
        goal, own = three("g", [None] * 3), three("o", [0.0] * 3)
        proxy = three("p", goal)
        rigid = held["stiffness_newton_per_mm"] * held["pixel_pitch_mm"] if held else None
        spring = three("f", [held and rigid * (p - g) for p, g in zip(proxy, goal)])
        wanted = [None if f is None else f + o for f, o in zip(spring, own)]
        sent = three("c", [0.0] * 3 if cut else wanted)
        for k in (0, 1):  # shortened by a limit: so far off the wanted direction, in 2^-60 N
            if isinstance(d["c" + "xy"[k]], int):
                sent[k] = wanted[k] * (float(sent[2]) / wanted[2]) + d["c" + "xy"[k]] / 2.0**60
        dt = time(d["dt"])
        if dt is None and before and before["tick"] == d["tick"] - 1:
            dt = (d["t"] - before["t"]) / 1e9
        before = d
        yield [t, *goal, *proxy, *spring, *sent, bits(0),
               ("none", "triangle", "edge", "vertex")[bits(1, 3)],
               *(int(p) if d[n] is None else d[n] for n, p in zip("ij", proxy)),
               d["moves"], d["ns"], d["tick"],
               clocks[clock][1] - clocks[clock][0] / 1e9 + t if clock >= 0 else None,
               pair and pair["from_s"] + d["blend"] * pair["span_s"], d["blend"],
               *(pair and pair[n] for n in ("from_frame", "to_frame", "id", "source")),
               d["settings"], dt, time(d["lateness"], 1e3), bits(3, 255), cut, 1 - bits(11),
               1 - bits(12), bits(13), bits(14), bits(15), bits(16), *own]


def tile(code):  # 256 floats; `code` is a byte and a frame of zstd
    zstd = ctypes.CDLL(ctypes.util.find_library("zstd"))
    planes, wide = ctypes.create_string_buffer(1024), 4 if code[0] else 2
    if zstd.ZSTD_decompress(planes, ctypes.c_size_t(1024), code[1:], ctypes.c_size_t(len(code) - 1)) != 256 * wide:
        raise ValueError("a damaged tile")
    words = []
    for k in range(256):
        folded = int.from_bytes(planes.raw[k:256 * wide:256], "little")
        left, above = (words[k - 1] if k % 16 else None), (words[k - 16] if k > 15 else None)
        if left is None or above is None:
            expected = left if left is not None else above or 0
        else:  # the plane through the three, held between these two
            expected = sorted((left, above, left + above - words[k - 17]))[1]
        words.append((expected + (~(folded >> 1) if folded & 1 else folded >> 1)) % 256**wide)
    if wide == 2:
        return [float(word) for word in words]
    bits = [word - 2**31 if word >> 31 else 2**32 - 1 - word for word in words]
    return struct.unpack("256f", struct.pack("256I", *bits))


class Surface:
    """What the ticks felt, without bumps and painted heights."""

    def __init__(self, db):
        self.parts, self.sizes = {}, {}
        for pair, levels in db.execute("SELECT pair, levels FROM surface ORDER BY pair, part"):
            self.parts.setdefault(pair, []).append(levels)
        for grid, columns, rows in db.execute("SELECT * FROM grid"):
            self.sizes[grid] = columns, rows
        query = "SELECT t.code FROM grid_tile p JOIN tile t ON t.id = p.tile WHERE p.grid = ? AND p.place = ?"

        @functools.lru_cache(4096)
        def tile_at(grid, place):
            row = db.execute(query, (grid, place)).fetchone()
            return tile(row[0]) if row else [float("nan")] * 256

        self.tile_at = tile_at

    def level(self, pair, blend, i, j):  # of the pixel in column i and row j, or the nearest in the image
        parts = self.parts.get(pair)
        if not parts:
            return float("nan")
        columns, rows = self.sizes[parts[0]]
        i, j = min(max(i, 0), columns - 1), min(max(j, 0), rows - 1)
        place = j // 16 * -(-columns // 16) + i // 16
        at = lambda grid: self.tile_at(grid, place)[j % 16 * 16 + i % 16]
        t = min(max(blend, 0.0), 1.0) * (len(parts) - 1)
        k = max(min(int(t), len(parts) - 2), 0)
        level = at(parts[k])
        return level if len(parts) == 1 else level + (t - k) * (at(parts[k + 1]) - level)


db = sqlite3.connect(pathlib.Path(sys.argv[1]).resolve().as_uri() + "?mode=ro", uri=True)
db.row_factory = sqlite3.Row
for table in ("session", "parameters", "source", "media", "pair", "mark", "clock", "cut"):
    print(json.dumps({table: [dict(row) for row in db.execute("SELECT * FROM " + table)]}))
view = db.execute("SELECT sql FROM sqlite_master WHERE name = 'tick'").fetchone()[0]
if len(sys.argv) > 2:
    schema = db.execute("PRAGMA user_version").fetchone()[0]
    if schema not in (2, 3, 4) or "typeof(d.cx)" not in view:
        sys.exit("its ticks are coded in another way than this reads: take its view, tick")
    csv.writer(open(sys.argv[2], "w", newline=""), lineterminator="\n").writerows([NAMES, *ticks(db)])
if len(sys.argv) > 3:
    felt = Surface(db)
    with open(sys.argv[3], "w", newline="") as levels:
        rows = csv.writer(levels, lineterminator="\n")
        rows.writerow(("tick", "i", "j", "level"))
        for t in db.execute("SELECT * FROM tick WHERE pair IS NOT NULL"):
            i, j = int(t["px"]), int(t["py"])
            rows.writerow((t["tick"], i, j, felt.level(t["pair"], t["blend"], i, j)))
