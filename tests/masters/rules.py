"""The setting rules as a master meets them: INTERFACE pdo | io UNITS | partial.

pdo: each PDO rule is broken once, the unit stays in PRE-OP with the AL status code of the rule; corrected, it
goes to OP and exchanges. io: units whose I/O allocation breaks a rule go to OP, and nothing is exchanged.
partial: a unit with 6 I/O entries and one with 4 go to OP and exchange four.

The CPU Units copy what they get, so that it comes back.
"""

import struct

import bench
import pysoem

STATE_ACKNOWLEDGE = 0x10
INVALID_INPUT_MAPPING = 0x0024
INVALID_OUTPUT_MAPPING = 0x0025

ENTRY_BYTES = 30
FACTORY_BYTES = 6 * ENTRY_BYTES
# Data … Valid, both directions, in NX Unit Status: bits 1 and 2 of 1A00.
VALID = 0b110
# Cycles of 1 ms in which what must not happen would have happened: an I/O response takes some 10.
STILL_CYCLES = 200


def entries(base, *subs):
    return [base | sub << 8 for sub in subs]


def outputs(*subs):
    return 0x1601, entries(0x7000_00F0, *subs)


def inputs(*subs):
    return 0x1A01, entries(0x6000_00F0, *subs)


ASSIGNED_OUTPUTS = (0x1C12, [0x1601])
ASSIGNED_INPUTS = (0x1C13, [0x1A00, 0x1A01, 0x1BFE])
FACTORY = (outputs(*range(1, 7)), inputs(*range(1, 7)), ASSIGNED_OUTPUTS, ASSIGNED_INPUTS)

# What is broken, and the AL status code by direction; writing FACTORY corrects it.
PDO_CASES = (
    ("without 1A00", [(0x1C13, [0x1A01, 0x1BFE])], INVALID_INPUT_MAPPING),
    ("a TxPDO in 1C12", [(0x1C12, [0x1601, 0x1A00])], INVALID_OUTPUT_MAPPING),
    ("an RxPDO in 1C13", [(0x1C13, [0x1A00, 0x1A01, 0x1601])], INVALID_INPUT_MAPPING),
    ("SyncManager order M to C", [(0x1C12, [0x1603, 0x1601])], INVALID_OUTPUT_MAPPING),
    ("SyncManager order C to M", [(0x1C13, [0x1A00, 0x1BFE, 0x1A01])], INVALID_INPUT_MAPPING),
    ("type M to C", [(0x1601, entries(0x7000_00F0, 1) + entries(0x7001_0050, 1))], INVALID_OUTPUT_MAPPING),
    ("type C to M", [(0x1A01, entries(0x6000_00F0, 1) + entries(0x6001_0050, 1))], INVALID_INPUT_MAPPING),
    ("an input M to C", [(0x1601, entries(0x6000_00F0, 1))], INVALID_OUTPUT_MAPPING),
    ("an output C to M", [(0x1A01, entries(0x7000_00F0, 1))], INVALID_INPUT_MAPPING),
    ("order M to C", [outputs(1, 3, 2, 4)], INVALID_OUTPUT_MAPPING),
    ("order C to M", [inputs(1, 3, 2, 4)], INVALID_INPUT_MAPPING),
    (
        "total M to C",
        [outputs(*range(1, 41)), (0x1603, entries(0x7002_0020, 1)), (0x1C12, [0x1601, 0x1603])],
        INVALID_OUTPUT_MAPPING,
    ),
    (
        "total C to M",
        [inputs(*range(1, 41)), (0x1A03, entries(0x6002_0020, 1)), (0x1C13, [0x1A00, 0x1A01, 0x1A03, 0x1BFE])],
        INVALID_INPUT_MAPPING,
    ),
)

# What the master maps, outputs and inputs, on a unit with 6 I/O entries and on one with 4: each time exactly
# four entries are on both sides of the whole way there and back.
PARTIAL_CASES = (((4, 6), (6, 6)), ((6, 4), (4, 6)))
EXCHANGED = 4


def main(interface, what, *arguments):
    {"pdo": pdo_rules, "io": io_rules, "partial": partial_exchange}[what](interface, *arguments)


def pdo_rules(interface):
    for case, (name, broken, al_status_code) in enumerate(PDO_CASES):
        with bench.network(interface, 1) as master:
            set_up(master.slaves[0], broken)
            master.config_map()
            refused(master, al_status_code, name)
        with bench.network(interface, 1) as master:
            set_up(master.slaves[0], FACTORY)
            bench.to_op(master)
            hold(master, case, [(VALID, image(case, FACTORY_BYTES))], name)
        print(f"{name}: {al_status_code:#06x}, then OP")


def io_rules(interface, units):
    units = int(units)
    with bench.network(interface, units) as master:
        bench.to_op(master)
        hold(master, 0, [(0, bytes(FACTORY_BYTES))] * units, "I/O entry rules")
        expect_op(master)


def partial_exchange(interface):
    for case, mapped in enumerate(PARTIAL_CASES):
        with bench.network(interface, 2) as master:
            for slave, (out, back) in zip(master.slaves, mapped):
                set_up(slave, (outputs(*range(1, out + 1)), inputs(*range(1, back + 1))))
            bench.to_op(master)
            arrived = image(case, EXCHANGED * ENTRY_BYTES)
            wanted = [(VALID, arrived.ljust(back * ENTRY_BYTES, b"\x00")) for _, back in mapped]
            hold(master, case, wanted, f"PDO entries {mapped}")
            expect_op(master)


def set_up(slave, settings):
    bench.on_pre_op_to_safe_op(slave, lambda it: [write_list(it, *setting) for setting in settings])


def write_list(slave, index, values):
    """The master's way: number 0, then the elements, then their number."""
    form = "<H" if index in (0x1C12, 0x1C13) else "<I"
    slave.sdo_write(index, 0, b"\x00")
    for sub, value in enumerate(values, start=1):
        slave.sdo_write(index, sub, struct.pack(form, value))
    slave.sdo_write(index, 0, bytes([len(values)]))


def refused(master, al_status_code, name):
    """SAFE-OP, which mapping has asked for, is refused: PRE-OP with the error, which is then acknowledged."""
    slave, error = master.slaves[0], pysoem.PREOP_STATE | pysoem.STATE_ERROR
    bench.expect((state_after(master, pysoem.PREOP_STATE), slave.al_status), (error, al_status_code), name)
    slave.state = pysoem.PREOP_STATE | pysoem.STATE_ACK
    slave.write_state()
    bench.expect(state_after(master, error), pysoem.PREOP_STATE, f"{name}: acknowledged")


def state_after(master, state):
    """The state, error included, that follows `state`; what SOEM waits for are states without error."""
    for _ in bench.cycles(bench.STATE_TIMEOUT_US // 1000):
        master.read_state()
        if master.slaves[0].state != state:
            break
    return master.slaves[0].state


def hold(master, case, wanted, name):
    """Sends the data of `case` until each slave answers valid bits and data as wanted, and stays with it."""
    still = 0
    for cycle in bench.cycles(bench.ECHO_CYCLES + STILL_CYCLES):
        for slave in master.slaves:
            slave.output = image(case, len(slave.output))
        bench.expect(bench.exchange(master), master.expected_wkc, f"{name}: working counter in cycle {cycle}")
        seen = [(slave.input[0] & VALID, bench.data_sets(slave)) for slave in master.slaves]
        if seen == wanted:
            still += 1
        elif still or cycle >= bench.ECHO_CYCLES:
            bench.expect(seen, wanted, f"{name}: in cycle {cycle}")
    if still < STILL_CYCLES:
        raise bench.Failure(f"{name}: held for {still} cycles only")


def image(case, length):
    """Data without a zero, and other data than that of another case: the CPU Units still have it."""
    return bytes((place + 29 * case) % 250 + 1 for place in range(length))


def expect_op(master):
    bench.expect(master.state_check(pysoem.OP_STATE, bench.STATE_TIMEOUT_US), pysoem.OP_STATE, "state of all slaves")


bench.run(main)
