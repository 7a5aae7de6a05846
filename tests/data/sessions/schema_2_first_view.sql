-- A session of schema 2 as the dibhr of commit 15d66f3e wrote it (2026-11-20): with the first view `tick`
-- and the first bits of tick_data.state. Written by hand with the statements of its
-- core/session/session_schema.cpp: that version cannot be built any more.
CREATE TABLE session(key TEXT PRIMARY KEY, value TEXT);
CREATE TABLE media(id INTEGER PRIMARY KEY, file TEXT UNIQUE, bytes INTEGER, sha256 TEXT);
CREATE TABLE source(id INTEGER PRIMARY KEY, first_tick INTEGER, media INTEGER, colour INTEGER,
  depth INTEGER, fill_holes INTEGER, remove_spikes INTEGER, smooth_steps INTEGER);
CREATE TABLE parameters(version INTEGER PRIMARY KEY, first_tick INTEGER, algorithm TEXT,
  relief_px REAL, roughness_px REAL, static_friction REAL, dynamic_friction REAL,
  stiffness_newton_per_mm REAL, damping_newton_s_per_m REAL, pixel_pitch_mm REAL,
  max_force_newton REAL, max_change_newton_per_ms REAL, ramp_s REAL, max_tick_s REAL,
  max_goal_speed_mm_per_ms REAL, force_enabled INTEGER, bump INTEGER);
CREATE TABLE pair(id INTEGER PRIMARY KEY, source INTEGER, from_frame INTEGER, to_frame INTEGER,
  from_s, to_s, span_s);
CREATE TABLE clock(t_ns INTEGER PRIMARY KEY, utc_s REAL, dropped INTEGER, high_water INTEGER);
CREATE TABLE mark(id INTEGER PRIMARY KEY, t REAL, tag TEXT, text TEXT);
CREATE TABLE cut(code INTEGER PRIMARY KEY, name TEXT);
CREATE TABLE tick_column(name TEXT, unit TEXT, meaning TEXT);
CREATE TABLE tick_data(tick INTEGER PRIMARY KEY, t, dt, lateness, ns, state, pair, blend, settings INTEGER, moves, i, j, gx, gy, gz, px, py, pz, fx, fy, fz, cx, cy, cz, ox, oy, oz);
CREATE VIEW tick AS SELECT CAST(CASE typeof(d.t) WHEN 'integer' THEN d.t / 1000000000.000000 ELSE d.t END AS REAL) AS t,
  CAST(d.gx AS REAL) AS gx,
  CAST(d.gy AS REAL) AS gy,
  CAST(d.gz AS REAL) AS gz,
  CAST(coalesce(d.px, d.gx) AS REAL) AS px,
  CAST(coalesce(d.py, d.gy) AS REAL) AS py,
  CAST(coalesce(d.pz, d.gz) AS REAL) AS pz,
  CAST(coalesce(d.fx, s.stiffness_newton_per_mm * s.pixel_pitch_mm * (coalesce(d.px, d.gx) - d.gx)) AS REAL) AS fx,
  CAST(coalesce(d.fy, s.stiffness_newton_per_mm * s.pixel_pitch_mm * (coalesce(d.py, d.gy) - d.gy)) AS REAL) AS fy,
  CAST(coalesce(d.fz, s.stiffness_newton_per_mm * s.pixel_pitch_mm * (coalesce(d.pz, d.gz) - d.gz)) AS REAL) AS fz,
  CAST(coalesce(d.cx, coalesce(d.fx, s.stiffness_newton_per_mm * s.pixel_pitch_mm * (coalesce(d.px, d.gx) - d.gx))) AS REAL) AS cx,
  CAST(coalesce(d.cy, coalesce(d.fy, s.stiffness_newton_per_mm * s.pixel_pitch_mm * (coalesce(d.py, d.gy) - d.gy))) AS REAL) AS cy,
  CAST(coalesce(d.cz, coalesce(d.fz, s.stiffness_newton_per_mm * s.pixel_pitch_mm * (coalesce(d.pz, d.gz) - d.gz))) AS REAL) AS cz,
  CAST(d.state >> 0 & 1 AS INTEGER) AS contact,
  CAST(CASE d.state >> 1 & 3 WHEN 0 THEN 'none' WHEN 1 THEN 'triangle' WHEN 2 THEN 'edge' WHEN 3 THEN 'vertex' END AS TEXT) AS primitive,
  CAST(d.i AS INTEGER) AS i,
  CAST(d.j AS INTEGER) AS j,
  CAST(d.moves AS INTEGER) AS moves,
  CAST(d.ns AS INTEGER) AS ns,
  d.tick AS tick,
  CAST((SELECT c.utc_s - c.t_ns / 1e9 FROM clock c WHERE c.t_ns <= CASE typeof(d.t) WHEN 'integer' THEN d.t ELSE d.t * 1e9 END ORDER BY c.t_ns DESC LIMIT 1) + (CASE typeof(d.t) WHEN 'integer' THEN d.t / 1000000000.000000 ELSE d.t END) AS REAL) AS utc_s,
  CAST(q.from_s + d.blend * q.span_s AS REAL) AS video_s,
  CAST(d.blend AS REAL) AS blend,
  q.from_frame AS frame,
  q.to_frame AS to_frame,
  q.id AS pair,
  q.source AS source,
  d.settings AS settings,
  CAST(CASE typeof(d.dt) WHEN 'integer' THEN d.dt / 1000000000.000000 ELSE d.dt END AS REAL) AS dt_s,
  CAST(CASE typeof(d.lateness) WHEN 'integer' THEN d.lateness / 1000.000000 ELSE d.lateness END AS REAL) AS lateness_us,
  CAST(d.state >> 12 & 255 AS INTEGER) AS buttons,
  CAST(d.state >> 3 & 7 AS INTEGER) AS cut,
  CAST(d.state >> 6 & 1 AS INTEGER) AS surface,
  CAST(d.state >> 7 & 1 AS INTEGER) AS ready,
  CAST(d.state >> 11 & 1 AS INTEGER) AS stand_in,
  CAST(d.state >> 8 & 1 AS INTEGER) AS restart,
  CAST(d.state >> 9 & 1 AS INTEGER) AS lets_go,
  CAST(d.state >> 10 & 1 AS INTEGER) AS refused,
  CAST(coalesce(d.ox, 0.0) AS REAL) AS ox,
  CAST(coalesce(d.oy, 0.0) AS REAL) AS oy,
  CAST(coalesce(d.oz, 0.0) AS REAL) AS oz
FROM tick_data d LEFT JOIN pair q ON q.id = d.pair LEFT JOIN parameters s ON s.version = d.settings;
INSERT INTO tick_column VALUES('t','s','monotonic time since the loop began');
INSERT INTO tick_column VALUES('gx','px','goal, x (column)');
INSERT INTO tick_column VALUES('gy','px','goal, y (row)');
INSERT INTO tick_column VALUES('gz','px','goal, z (elevation towards the viewer)');
INSERT INTO tick_column VALUES('px','px','proxy, x');
INSERT INTO tick_column VALUES('py','px','proxy, y');
INSERT INTO tick_column VALUES('pz','px','proxy, z');
INSERT INTO tick_column VALUES('fx','N','spring force before the safety stage, x');
INSERT INTO tick_column VALUES('fy','N','spring force before the safety stage, y');
INSERT INTO tick_column VALUES('fz','N','spring force before the safety stage, z');
INSERT INTO tick_column VALUES('cx','N','force sent to the device, x');
INSERT INTO tick_column VALUES('cy','N','force sent to the device, y');
INSERT INTO tick_column VALUES('cz','N','force sent to the device, z');
INSERT INTO tick_column VALUES('contact','','1 while the proxy touches the surface');
INSERT INTO tick_column VALUES('primitive','','what the proxy rests on: none, triangle, edge or vertex');
INSERT INTO tick_column VALUES('i','','the primitive''s column, -1 for none');
INSERT INTO tick_column VALUES('j','','the primitive''s row, -1 for none');
INSERT INTO tick_column VALUES('moves','','primitives visited in the update');
INSERT INTO tick_column VALUES('ns','ns','time of the update');
INSERT INTO tick_column VALUES('tick','','number of the tick in its loop');
INSERT INTO tick_column VALUES('utc_s','s','wall time since 1970-01-01 00:00 UTC');
INSERT INTO tick_column VALUES('video_s','s','presentation time in the video of what was touched; NULL without a surface');
INSERT INTO tick_column VALUES('blend','','0: depth frame `frame`, 1: `to_frame`');
INSERT INTO tick_column VALUES('frame','','number of the depth frame in its file, from 0');
INSERT INTO tick_column VALUES('to_frame','','number of the frame it blends into');
INSERT INTO tick_column VALUES('pair','','the two frames: id in table pair');
INSERT INTO tick_column VALUES('source','','files and cleaning of the frames: id in table source');
INSERT INTO tick_column VALUES('settings','','version in table parameters');
INSERT INTO tick_column VALUES('dt_s','s','since the tick before began');
INSERT INTO tick_column VALUES('lateness_us','us','how long after its deadline the tick began');
INSERT INTO tick_column VALUES('buttons','','bit 0: the device''s main button');
INSERT INTO tick_column VALUES('cut','','why the force was cut: code in table cut');
INSERT INTO tick_column VALUES('surface','','1: there was a surface; without, nothing is updated and no force sent');
INSERT INTO tick_column VALUES('ready','','1: the device was attached and homed');
INSERT INTO tick_column VALUES('stand_in','','1: the mouse moved the hand, for a device that was not ready');
INSERT INTO tick_column VALUES('restart','','1: the force began from zero again');
INSERT INTO tick_column VALUES('lets_go','','1: the hand was lifted or replaced, and a contact was let go first');
INSERT INTO tick_column VALUES('refused','','1: the hand''s place was no number; the goal is the one before');
INSERT INTO tick_column VALUES('ox','N','what the device itself adds, x');
INSERT INTO tick_column VALUES('oy','N','what the device itself adds, y');
INSERT INTO tick_column VALUES('oz','N','what the device itself adds, z');
INSERT INTO cut VALUES(0,'');
INSERT INTO cut VALUES(1,'not finite');
INSERT INTO cut VALUES(2,'force off');
INSERT INTO cut VALUES(3,'device not ready');
INSERT INTO cut VALUES(4,'late tick');
INSERT INTO cut VALUES(5,'goal jumped');
PRAGMA application_id = 1684562288;
PRAGMA user_version = 2;
INSERT OR REPLACE INTO session VALUES ('started', '2026-11-20T12:00:00Z');
INSERT OR REPLACE INTO session VALUES ('device', 'falcon');
INSERT OR REPLACE INTO session VALUES ('schema_version', '2');
INSERT OR REPLACE INTO session VALUES ('units', 'pixels of the depth image, newtons, seconds; see table tick_column');
INSERT OR REPLACE INTO session VALUES ('row_count', '3');
INSERT OR REPLACE INTO session VALUES ('dropped_count', '0');
INSERT OR REPLACE INTO session VALUES ('complete', '1');
INSERT INTO media VALUES (1, '/films/color.mp4', 10, 'aa'), (2, '/films/depth.mp4', 20, 'bb');
INSERT INTO source VALUES (1, 1, 1, 1, 2, 1, 0, 1);
INSERT INTO parameters VALUES (1, 1, 'pga', 200.0, 0.0, 0.3, 0.2, 0.5, 0.0, 0.25, 4.0, 1.0, 0.3, 0.05, 2.0, 1, NULL);
INSERT INTO pair VALUES (1, 1, 3, 4, 0.1, 0.125, 0.025);
INSERT INTO clock VALUES (1000000, 1795000000.5, 0, 2);
INSERT INTO mark VALUES (1, 0.002, 'M1', 'here');
INSERT INTO tick_data VALUES (1, 1000000, 1000000, 2500, 700, 4547, 1, 0.25, 1, 3, 10, 12, 10.5, 12.25, -4, NULL, NULL, 100, NULL, NULL, NULL, NULL, NULL, 3.5, NULL, NULL, NULL);
INSERT INTO tick_data VALUES (2, 2000000, 1000000, 1500, 300, 88, 1, 0.5, 1, 0, -1, -1, 11.5, 12.25, 120, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, 0.5, NULL, NULL);
INSERT INTO tick_data VALUES (3, 0.0030000000001, 0.0010000000001, 1000500, 0, 2176, NULL, 0, 1, 0, -1, -1, 11.5, 12.25, 120, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL);
