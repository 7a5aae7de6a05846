"""Reads a session of dibhr, schema 2 as FORMAT.md states it, with nothing but Python.
python3 read_session.py SESSION            its tables but for ticks and maps, a JSON object a line
python3 read_session.py SESSION TICKS.csv  also every tick, decoded from tick_data, as dibhr export"""
import csv, json, pathlib, sqlite3, sys

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


db = sqlite3.connect(pathlib.Path(sys.argv[1]).resolve().as_uri() + "?mode=ro", uri=True)
db.row_factory = sqlite3.Row
for table in ("session", "parameters", "source", "media", "pair", "mark", "clock", "cut"):
    print(json.dumps({table: [dict(row) for row in db.execute("SELECT * FROM " + table)]}))
view = db.execute("SELECT sql FROM sqlite_master WHERE name = 'tick'").fetchone()[0]
if len(sys.argv) > 2:
    if db.execute("PRAGMA user_version").fetchone()[0] != 2 or "typeof(d.cx)" not in view:
        sys.exit("its ticks are coded in another way than this reads: take its view, tick")
    csv.writer(open(sys.argv[2], "w", newline=""), lineterminator="\n").writerows([NAMES, *ticks(db)])
