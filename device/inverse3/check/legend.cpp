// The legend of the record: the meaning of every name, its unit, and how it was measured.
#include <array>

#include "device/inverse3/check/context.hpp"

namespace dibhr::inverse3 {

namespace {

struct Meaning {
    const char* step;
    const char* name;
    const char* meaning;
};

constexpr std::array kMeanings{
    // The head.
    Meaning{"record", "format", "what this file is"},
    Meaning{"record", "format_version", "of the file's layout; names are added, never renamed"},
    Meaning{"record", "begun_utc", "when the check began, UTC"},
    Meaning{"record", "begun_local", "the same moment on this machine's clock, with its zone"},
    Meaning{"record", "device_id", "of the device that is checked, as the service names it"},
    Meaning{"record", "program", "name and version of the program that measured"},
    Meaning{"record", "program_sha256", "of the program's file: tells one build from another"},
    Meaning{"record", "thread_priority", "what the system granted to the measuring thread"},
    Meaning{"record", "machine", "system, kernel, processor, and how many of them, as Linux says"},
    Meaning{"record", "simulated",
            "true: the service is dibhr's own simulation, and nothing was measured on a device"},
    Meaning{"record", "service_port", "port of the WebSocket"},
    Meaning{"record", "older_port", "port that is asked for /version, too"},
    Meaning{"record", "dialect_setting", "how the settings want a force spelled"},
    Meaning{"record", "preset_asked",
            "preset that the session asked for, as the viewer does; null: a service before 3.5, "
            "which was asked for none"},
    Meaning{"record", "preset", "preset as the service reported it after that; null: not reported"},
    Meaning{"record", "basis", "axes as the service reported them after that; null: not reported"},
    Meaning{"record", "steps", "what was measured, step by step"},
    Meaning{"record", "step", "name of a step, under which this legend has its names"},
    Meaning{"record", "end",
            "how the step ended: done, skipped, let go (a key, under force), quit, failed, not "
            "begun"},
    Meaning{"record", "seconds", "how long the step took, with the person's time [s]"},
    Meaning{"record", "remark", "why it failed"},
    Meaning{"record", "measured", "what the step measured"},
    Meaning{"record", "findings", "answers in words to what README.md leaves open; null: open"},
    Meaning{"record", "settings", "lines that follow for the settings file, table [inverse3]"},
    Meaning{"record", "legend", "this"},

    Meaning{"service", "version", "of the service, from its /version; empty: not reported"},
    Meaning{"service", "version_answer", "the whole answer of /version, the service's own words"},
    Meaning{"service", "type", "of the device, the service's own word"},
    Meaning{"service", "handedness", "of the device, the service's own word"},
    Meaning{"service", "preset_before", "preset in the inventory, before dibhr asked for one"},
    Meaning{"service", "preset_complaint", "what the service complained of when asked for it"},
    Meaning{"service", "preset", "preset read back after that; null: not reported"},
    Meaning{"service", "basis", "axes read back after that; null: not reported"},
    Meaning{"service", "inventory_sent_at_once",
            "the first whole state came within 0.5 s of connecting; else it was asked for"},
    Meaning{"service", "inventory", "the first whole state, the service's own words"},
    Meaning{"service", "introduced",
            "the whole state after the session was named and the preset set, its own words"},
    Meaning{"service", "kept",
            "what the service keeps for all programs, by device, over HTTP, its own words cut "
            "after 120 letters; \"not answered\": it did not within 0.3 s"},

    Meaning{"rate", "exchanges",
            "messages that asked for the pose, without force and without a pause, each sent when "
            "the last was answered"},
    Meaning{"rate", "exchanges_per_s", "their number a second; with force it may be another [1/s]"},
    Meaning{"rate", "round_trip_ms_p50", "half took at most so long, from send to answer [ms]"},
    Meaning{"rate", "round_trip_ms_p95", "95 % took at most so long [ms]"},
    Meaning{"rate", "round_trip_ms_p99", "99 % took at most so long [ms]"},
    Meaning{"rate", "round_trip_ms_max", "the longest one [ms]"},
    Meaning{"rate", "round_trip_histogram", "how many took how long"},
    Meaning{"rate", "up_to_ms", "upper end of a range, which begins at the last one [ms]"},
    Meaning{"rate", "count", "how many were in it"},

    Meaning{"moving", "ended_by_enter", "the person said when; else the step went on by itself"},
    Meaning{"moving", "positions", "how many were reported, new or not"},
    Meaning{"moving", "changes_while_moving",
            "positions that differ from the last by more than 1e-6 mm, less than 100 ms after "
            "another such"},
    Meaning{"moving", "moving_s", "sum of the times between them [s]"},
    Meaning{"moving", "new_positions_per_s",
            "1 over the median time between two changes while it moved [1/s]"},
    Meaning{"moving", "change_interval_ms", "that time [ms]: 5, 50 and 95 % are shorter"},
    Meaning{"moving", "p05", "5 % are less"},
    Meaning{"moving", "p50", "half are less"},
    Meaning{"moving", "p95", "95 % are less"},
    Meaning{"moving", "smallest_step_mm", "the least step_mm_p05 of the three axes [mm]"},
    Meaning{
        "moving", "steps",
        "differences above 1e-6 mm between one reported position and the next, along x, y and z"},
    Meaning{"moving", "count", "how many"},
    Meaning{"moving", "different", "how many different ones, rounded to 1e-6 mm, of up to 200000"},
    Meaning{"moving", "step_mm_p05", "5 % are shorter [mm]"},
    Meaning{"moving", "step_mm_p50", "half are shorter [mm]"},
    Meaning{"moving", "lowest_mm", "least coordinate that was told, each axis for itself [mm]"},
    Meaning{"moving", "highest_mm", "largest coordinate that was told [mm]"},
    Meaning{"moving", "x", "to the right, of the service's frame in that preset"},
    Meaning{"moving", "y", "forward"},
    Meaning{"moving", "z", "up"},
    Meaning{"moving", "preset", "of the frame, as read back; null: not reported"},
    Meaning{"moving", "basis", "of the frame, as read back; null: not reported"},

    Meaning{"dialect", "vector", "a force spelled \"vector\""},
    Meaning{"dialect", "values", "the same force spelled \"values\""},
    Meaning{"dialect", "sent_newton", "the force at the end of its rise [N]"},
    Meaning{"dialect", "told_newton", "current_cursor_force in the last answer to it [N]"},
    Meaning{"dialect", "position_begin_mm", "told with the first answer [mm]"},
    Meaning{"dialect", "position_end_mm", "told with the last answer [mm]"},
    Meaning{"dialect", "x", "to the right"},
    Meaning{"dialect", "y", "forward"},
    Meaning{"dialect", "z", "up"},
    Meaning{"dialect", "held_s", "for how long the whole force was sent [s]"},
    Meaning{"dialect", "told_back", "at least 5 % of it was told"},
    Meaning{"dialect", "felt", "the person's word, after it"},
    Meaning{"dialect", "complaint", "the service's, or why there was no answer"},
    Meaning{"dialect", "in_use",
            "the status in_use before any force, at the end of one, and after"},
    Meaning{"dialect", "before", "before the first force"},
    Meaning{"dialect", "during", "in the last answer to a force"},
    Meaning{"dialect", "after", "after the last one"},

    Meaning{"silence", "dialect", "how the force was spelled"},
    Meaning{"silence", "silences", "a push of 0.5 N each, and then no message"},
    Meaning{"silence", "silence_ms", "the silence that was meant [ms]"},
    Meaning{"silence", "gap_ms",
            "the true one, from sending the last force to sending the message without force that "
            "reads it [ms]"},
    Meaning{"silence", "force_before_newton", "length of the force told before it [N]"},
    Meaning{"silence", "force_newton",
            "length of the force told in the answer to that message, which may itself end it [N]"},
    Meaning{"silence", "still_there_after_ms",
            "longest gap with at least 5 % of 0.5 N; null: none"},
    Meaning{"silence", "gone_after_ms", "shortest gap with less; null: none"},

    Meaning{"closing", "dialect", "how the force was spelled"},
    Meaning{"closing", "closings",
            "a push of 0.5 N each, then the connection is closed with neither zero nor goodbye"},
    Meaning{"closing", "closed_ms", "for how long there was to be none [ms]"},
    Meaning{"closing", "gap_ms",
            "from sending the last force to the first state of the next connection [ms]"},
    Meaning{"closing", "told_unasked", "that state came by itself; else it was asked for"},
    Meaning{"closing", "force_newton", "length of the force that it told [N]"},
    Meaning{"closing", "still_there_after_ms",
            "longest gap with at least 5 % of 0.5 N; null: none"},
    Meaning{"closing", "gone_after_ms", "shortest gap with less; null: none"},
    Meaning{"closing", "pushed_s", "from the first force to the connection's end, each time [s]"},
    Meaning{"closing", "felt_s", "how long it pulled the last time, by the person's count [s]"},

    Meaning{"force", "pushes", "one force downwards each, on a kitchen scale"},
    Meaning{"force", "wanted_newton", "its strength [N]"},
    Meaning{"force", "let_go", "a key ended it early: grams may then be of less than all of it"},
    Meaning{"force", "sent_newton", "the force at the end of its rise [N]"},
    Meaning{"force", "told_newton", "current_cursor_force in the last answer to it [N]"},
    Meaning{"force", "position_begin_mm", "told with the first answer [mm]"},
    Meaning{"force", "position_end_mm", "told with the last answer [mm]"},
    Meaning{"force", "x", "to the right"},
    Meaning{"force", "y", "forward"},
    Meaning{"force", "z", "up"},
    Meaning{"force", "held_s", "for how long the whole force was sent [s]"},
    Meaning{"force", "grams",
            "the scale's reading at the end of the force, typed from memory when it had gone [g]"},
    Meaning{"force", "newton", "grams times 9.80665 m/s2 [N]"},
    Meaning{"force", "share", "newton over wanted_newton; 1: as strong as was wanted"},

    Meaning{"unplugged", "said_out", "the person said, by an Enter, that the cable was out"},
    Meaning{"unplugged", "gone_s", "longest time without an entry of the device [s]"},
    Meaning{"unplugged", "gone_after_enter_s",
            "from that Enter to the first answer without the entry, negative: before it [s]; null: "
            "one of them never came"},
    Meaning{"unplugged", "frozen_s",
            "how long the position had been the same one when it changed or its entry went, of the "
            "stay that the Enter fell into, or the last one before the entry went [s]; null: none"},
    Meaning{"unplugged", "told_no_power", "the entry told it meanwhile"},
    Meaning{"unplugged", "told_not_calibrated", "the entry told it meanwhile"},
    Meaning{"unplugged", "told_not_ready", "the entry told it meanwhile"},
    Meaning{"unplugged", "is_back", "there was an entry at the end"},
    Meaning{"unplugged", "ended_by", "what the service did instead of answering; empty: nothing"},
    Meaning{"unplugged", "at_the_end", "names of the devices at the end"},
};

}  // namespace

Json check_legend() {
    Json legend;
    for (const Meaning& one : kMeanings) legend[one.step][one.name] = one.meaning;
    return legend;
}

}  // namespace dibhr::inverse3
