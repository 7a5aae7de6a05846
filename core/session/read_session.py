#!/usr/bin/env python3
"""Reads a session file of dibhr (schema 2, as FORMAT.md states it) with nothing but Python.

read_session.py SESSION           what is in it, as JSON
read_session.py SESSION TICKS.csv and every tick, decoded from tick_data, as `dibhr export` writes it
"""
import csv, json, pathlib, sqlite3, sys

AXES = "xyz"
PRIMITIVES = ["none", "triangle", "edge", "vertex"]


def seconds(cell, per_unit=1e9):  # whole nanoseconds, or else a real in the unit itself
    return cell / per_unit if isinstance(cell, int) else cell


def ticks(db):
    parameters = {row["version"]: row for row in db.execute("SELECT * FROM parameters")}
    pairs = {row["id"]: row for row in db.execute("SELECT * FROM pair")}
    clocks = [tuple(row) for row in db.execute("SELECT t_ns, utc_s FROM clock ORDER BY t_ns")]
    clock, before = 0, None
    for d in db.execute("SELECT * FROM tick_data ORDER BY tick"):
        held, pair = parameters.get(d["settings"]), pairs.get(d["pair"])
        bits = lambda shift, mask=1: d["state"] >> shift & mask
        cut, t = bits(17, 7), seconds(d["t"])
        t_ns = d["t"] if isinstance(d["t"], int) else d["t"] * 1e9
        while clock + 1 < len(clocks) and clocks[clock + 1][0] <= t_ns:
            clock += 1
        known = clocks and clocks[clock][0] <= t_ns
        proxy = [d["g" + a] if d["p" + a] is None else d["p" + a] for a in AXES]
        rigid = held and held["stiffness_newton_per_mm"] * held["pixel_pitch_mm"]
        spring = [d["f" + a] if d["f" + a] is not None else
                  rigid and rigid * (p - d["g" + a]) for a, p in zip(AXES, proxy)]
        own = [d["o" + a] or 0.0 for a in AXES]
        wanted = [f if f is None else f + o for f, o in zip(spring, own)]
        sent = [(0.0 if cut else w) if d["c" + a] is None else d["c" + a] for a, w in zip(AXES, wanted)]
        for k in range(2):  # shortened by a limit: off the wanted direction in parts of 2^-60 N
            if isinstance(d["c" + AXES[k]], int):
                sent[k] = wanted[k] * (float(sent[2]) / wanted[2]) + d["c" + AXES[k]] / 2.0**60
        dt = seconds(d["dt"]) if d["dt"] is not None else \
            (d["t"] - before["t"]) / 1e9 if before and before["tick"] == d["tick"] - 1 else None
        before = d
        yield dict(zip(
            "t gx gy gz px py pz fx fy fz cx cy cz contact primitive i j moves ns tick utc_s video_s "
            "blend frame to_frame pair source settings dt_s lateness_us buttons cut surface ready "
            "stand_in restart lets_go refused ox oy oz".split(),
            [t, *(d["g" + a] for a in AXES), *proxy, *spring, *sent, bits(0), PRIMITIVES[bits(1, 3)],
             *(int(p) if d[n] is None else d[n] for n, p in zip("ij", proxy)), d["moves"], d["ns"],
             d["tick"], clocks[clock][1] - clocks[clock][0] / 1e9 + t if known else None,
             pair and pair["from_s"] + d["blend"] * pair["span_s"], d["blend"],
             *(pair and pair[name] for name in ("from_frame", "to_frame", "id", "source")),
             d["settings"], dt, seconds(d["lateness"], 1e3), bits(3, 255), cut, 1 - bits(11),
             1 - bits(12), bits(13), bits(14), bits(15), bits(16), *own]))


if __name__ == "__main__":
    db = sqlite3.connect(pathlib.Path(sys.argv[1]).resolve().as_uri() + "?mode=ro", uri=True)
    db.row_factory = sqlite3.Row
    for table in ("session", "parameters", "source", "media", "pair", "mark", "clock", "cut"):
        print(json.dumps({table: [dict(row) for row in db.execute("SELECT * FROM " + table)]}))
    if len(sys.argv) > 2:
        with open(sys.argv[2], "w", newline="") as file:
            for number, row in enumerate(ticks(db)):
                rows = csv.writer(file, lineterminator="\n")
                rows.writerows([row.keys()] * (number == 0) + [row.values()])
