"""Units in a line go to OP and exchange for N cycles: INTERFACE UNITS EXAMPLE CYCLES [overlap].

Every cycle writes a new pattern to every unit, each unit its own. What comes back through the CPU Unit must
be a whole pattern of that unit, never an older one than before, with the right working counter each time.
"""

import struct

import bench

# The allocation examples of the manual, 6-3-4: entries of 15 UINT arrays, 10 BYTE arrays, UDINT.
EXAMPLES = {
    "factory": (6, 0, 0),
    "uint-maximum": (40, 0, 0),
    "mixed": (10, 10, 30),
}
ENTRY_BYTES = (30, 10, 4)
ENTRY_BASES = ((0x7000_00F0, 0x6000_00F0), (0x7001_0050, 0x6001_0050), (0x7002_0020, 0x6002_0020))

PATTERNS_OF_A_UNIT = 1_000_000


def main(interface, units, example, cycles, *options):
    units, entries, overlap = int(units), EXAMPLES[example], "overlap" in options
    size = sum(count * width for count, width in zip(entries, ENTRY_BYTES))
    with bench.network(interface, units) as master:
        for slave in master.slaves:
            configure = (lambda _: None) if example == "factory" else (lambda it: write_mapping(it, entries))
            bench.on_pre_op_to_safe_op(slave, configure)
        bench.to_op(master, overlap)
        bench.expect(master.expected_wkc, 3 * units, "expected working counter")
        for slave in master.slaves:
            bench.expect(len(slave.output), size, "output bytes")
            bench.expect(len(slave.input), bench.STATUS_BYTES + size + bench.NEW_MESSAGES_BYTES, "input bytes")
        slowest = exchange_patterns(master, size, int(cycles), overlap)
        print(f"{cycles} cycles, {units} units of {size} bytes, slowest echo {slowest} cycles")


def write_mapping(slave, entries):
    """The master's way: number 0, then the entries, then their number; mappings first, assignment after."""
    rx, tx = [], [0x1A00]
    for number, (count, (rx_base, tx_base)) in enumerate(zip(entries, ENTRY_BASES), start=1):
        if count == 0:
            continue
        for base, index, assigned in ((rx_base, 0x1600 + number, rx), (tx_base, 0x1A00 + number, tx)):
            write_list(slave, index, [base | sub << 8 for sub in range(1, count + 1)], "<I")
            assigned.append(index)
    write_list(slave, 0x1C12, rx, "<H")
    write_list(slave, 0x1C13, [*tx, 0x1BFE], "<H")


def write_list(slave, index, values, form):
    slave.sdo_write(index, 0, b"\x00")
    for sub, value in enumerate(values, start=1):
        slave.sdo_write(index, sub, struct.pack(form, value))
    slave.sdo_write(index, 0, bytes([len(values)]))


def exchange_patterns(master, size, cycles, overlap):
    """Returns how many cycles the slowest echo took."""
    newest = [0] * len(master.slaves)
    slowest, first_echo = 0, None
    for cycle in bench.cycles(cycles):
        for place, slave in enumerate(master.slaves):
            slave.output = bench.pattern(place * PATTERNS_OF_A_UNIT + cycle + 1, size)
        bench.expect(bench.exchange(master, overlap), master.expected_wkc, f"working counter in cycle {cycle}")
        for place, slave in enumerate(master.slaves):
            newest[place] = newer(bench.data_sets(slave), place, newest[place], cycle)
        if all(newest):
            first_echo = cycle if first_echo is None else first_echo
            slowest = max(slowest, cycle + 1 - min(newest))
    if first_echo is None or slowest > bench.ECHO_CYCLES:
        raise bench.Failure(f"values come back too late: first in cycle {first_echo}, slowest {slowest} cycles")
    return slowest


def newer(image, place, before, cycle):
    """The number of the cycle in which `image` was written, counted from 1; 0 while nothing has come back."""
    if not any(image):
        bench.expect(before, 0, f"unit {place}: zeros after cycle {before} in cycle {cycle}")
        return 0
    seed = bench.seed_of(image)
    if seed is None:
        raise bench.Failure(f"unit {place}: torn or foreign image in cycle {cycle}: {image.hex(' ')}")
    written = seed - place * PATTERNS_OF_A_UNIT
    if not before <= written <= cycle + 1:
        raise bench.Failure(f"unit {place}: image of cycle {written} after {before}, in cycle {cycle}")
    return written


bench.run(main)
