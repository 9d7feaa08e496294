"""A user program in Structured Text behind a real master: INTERFACE PROGRAM.

PROGRAM is a copy of copy_and_count.st that this script may change: the command loads it anew.
"""

import pathlib
import struct

import bench

ENTRY_BYTES = 30
LOOP = 2 * ENTRY_BYTES  # the first UINT of UINTs 03
CYCLES = 1000


def main(interface, program):
    with bench.network(interface, 1) as master:
        bench.to_op(master)
        slave = master.slaves[0]
        copies(master, slave)
        goes_on_while_the_program_loops(master, slave)
        takes_a_changed_program(master, slave, pathlib.Path(program))


def copies(master, slave):
    """What the master sends comes back whole, through the program."""
    newest = 0
    for cycle in bench.cycles(CYCLES):
        slave.output = bench.pattern(cycle + 1, ENTRY_BYTES) + bytes(len(slave.output) - ENTRY_BYTES)
        cycle_is_answered(master)
        seed = bench.seed_of(bench.data_sets(slave)[:ENTRY_BYTES])
        if seed is None or seed < newest:
            bench.expect(any(bench.data_sets(slave)[:ENTRY_BYTES]), False, f"an image that was never sent, in cycle {cycle}")
        newest = seed or newest
    if newest <= CYCLES - bench.ECHO_CYCLES:
        raise bench.Failure(f"the program copies too late: {newest} of {CYCLES}")


def goes_on_while_the_program_loops(master, slave):
    """Every frame is answered while the program uses up its statements, scan after scan; then it counts on."""
    output = bytearray(len(slave.output))
    output[LOOP] = 1
    slave.output = bytes(output)
    for _ in bench.cycles(CYCLES):
        cycle_is_answered(master)
    slave.output = bytes(len(output))
    before = scans(slave)
    wait_until(master, lambda: (scans(slave) - before) & 0xFFFF > 20, "the program scans again")


def takes_a_changed_program(master, slave, program):
    """A wrong program is left aside, a right one loaded; the exchange knows nothing of it."""
    text = program.read_text()
    program.write_text(text.replace(":= Scans + 1;", ":= Scans + Misspelt;"))
    before = scans(slave)
    wait_until(master, lambda: (scans(slave) - before) & 0xFFFF > 500, "the old program goes on")
    program.write_text(text.replace("[0] := Scans;", "[0] := 16#ABCD;"))
    wait_until(master, lambda: scans(slave) == 0xABCD, "the changed program runs")


def scans(slave):
    return struct.unpack_from("<H", bench.data_sets(slave), ENTRY_BYTES)[0]


def wait_until(master, is_so, what):
    for _ in bench.cycles(5000):
        cycle_is_answered(master)
        if is_so():
            return
    raise bench.Failure(f"{what}: not within 5000 cycles")


def cycle_is_answered(master):
    bench.expect(bench.exchange(master), master.expected_wkc, "working counter")


bench.run(main)
