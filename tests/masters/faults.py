"""Faults of frames between the master and its units: INTERFACE UNITS.

A line `fault SENTENCE` on standard output asks the test for a fault of the line; its answer comes on standard input when
the fault is at work. The master must see each fault, see no data that are old or torn, and recover.
"""

import time

import bench
import pysoem

# A frame that does not come back is not awaited for long: the watchdog of the units would expire.
LOST_US = 5_000
# Longer than a late frame waits on the line.
LATE_S = 0.5
INVALID_FRAMES = 0x0300
FORWARDED_ERRORS = 0x0308
SIZE = 180
NO_FRAME = -1


def main(interface, units):
    units = int(units)
    with bench.network(interface, units) as master:
        for slave in master.slaves:
            bench.on_pre_op_to_safe_op(slave, lambda _: None)
        bench.to_op(master)
        line = Line(master)
        line.exchange_until_all_have_come_back()
        losses(line)
        late_frames(line)
        counters(line)
        bit_errors(line)
        bench.expect(master.state_check(pysoem.OP_STATE, bench.STATE_TIMEOUT_US), pysoem.OP_STATE, "state of all units")
        # Without process data from here on: the units do not stay in OP.
        mailboxes(line)
    print(f"{line.cycle} cycles, {units} units: lost, late, doubled and damaged frames, and a mailbox that loses them")


class Line:
    """Cycles with patterns. What comes back through the CPU Units is never older than before."""

    def __init__(self, master):
        self.master, self.cycle, self.newest = master, 0, [0] * len(master.slaves)
        # Cycles whose outputs the units get after those of later ones.
        self.late = set()
        # SOEM knows an answer by its index, of which there are 16: a late one can pass as that of a new frame.
        self.outdated = 0

    def exchange(self, counter=None, timeout_us=bench.FRAME_TIMEOUT_US):
        """One cycle with this working counter: without one, that of a cycle without faults."""
        master = self.master
        counter = master.expected_wkc if counter is None else counter
        self.cycle += 1
        for place, slave in enumerate(master.slaves):
            slave.output = bench.pattern(self.seed(place, self.cycle), SIZE)
        master.send_processdata()
        bench.expect(master.receive_processdata(timeout_us), counter, f"working counter in cycle {self.cycle}")
        if counter == master.expected_wkc:
            self.newest = [self.newer(place) for place in range(len(master.slaves))]

    def newer(self, place):
        """The cycle whose pattern has come back; 0 before the first."""
        image = bench.data_sets(self.master.slaves[place])
        if not any(image) and not self.newest[place]:
            return 0
        seed = bench.seed_of(image)
        if seed is None:
            raise bench.Failure(f"unit {place}: torn image in cycle {self.cycle}: {image.hex(' ')}")
        cycle = seed - self.seed(place, 0)
        if cycle in self.late or cycle <= self.outdated:
            return self.newest[place]
        if not self.newest[place] <= cycle <= self.cycle:
            raise bench.Failure(f"unit {place}: image of cycle {cycle} after {self.newest[place]}, in cycle {self.cycle}")
        return cycle

    @staticmethod
    def seed(place, cycle):
        return place * 1_000_000 + cycle

    def exchange_until_all_have_come_back(self):
        """Cycles without faults, until every unit has returned a pattern of one of them."""
        first = self.cycle
        for _ in bench.cycles(bench.ECHO_CYCLES):
            self.exchange()
            if min(self.newest) > first:
                return
        raise bench.Failure(f"nothing came back after cycle {first}: {self.newest}")


def fault(sentence):
    print(f"fault {sentence}", flush=True)
    bench.expect(input(), "at work", sentence)


def losses(line):
    for sentence in ("lose the next 3 process data frames", "lose the answers of the next 3 process data frames"):
        fault(sentence)
        for _ in range(3):
            line.exchange(NO_FRAME, LOST_US)
        line.exchange_until_all_have_come_back()


def late_frames(line):
    for way in ("", " on the way back"):
        fault(f"delay the next 3 process data frames{way} by 20ms")
        for _ in range(3):
            line.exchange()
        # Later than the master waits: the answers of these cycles come in the middle of others.
        fault(f"delay the next 3 process data frames{way} by {LATE_S}s")
        for _ in range(3):
            line.exchange(NO_FRAME, LOST_US)
            if not way:
                line.late.add(line.cycle)
        line.outdated = line.cycle
        end = time.monotonic() + 2 * LATE_S
        while time.monotonic() < end:
            line.exchange()
        line.outdated = 0
        line.exchange_until_all_have_come_back()
    fault("duplicate the next 3 process data frames on the way back")
    for _ in range(3):
        line.exchange()
    line.exchange_until_all_have_come_back()


def counters(line):
    fault("lower the working counter of the next 3 process data frames by 2")
    for _ in range(3):
        line.exchange(line.master.expected_wkc - 2)
    line.exchange_until_all_have_come_back()


def bit_errors(line):
    """A damaged frame is counted by the unit behind the cable, as invalid, and by no other one."""
    before = [errors(slave) for slave in line.master.slaves]
    fault("corrupt the next 3 process data frames on cable 2")
    for _ in range(3):
        line.exchange(NO_FRAME, LOST_US)
    line.exchange_until_all_have_come_back()
    counted = [
        tuple(after - old for after, old in zip(errors(slave), before))
        for slave, before in zip(line.master.slaves, before)
    ]
    bench.expect(counted[:2], [(0, 0), (3, 0)], "invalid and forwarded frames of the first two units")
    bench.expect(set(counted[2:]), {(0, 3)}, "of the units behind them")


def errors(slave):
    """Invalid frames and forwarded errors at the port to the master."""
    return slave._fprd(INVALID_FRAMES, 1)[0], slave._fprd(FORWARDED_ERRORS, 1)[0]


def mailboxes(line):
    """An SDO whose frames are lost is right or fails; when it is repeated, it is right in the end."""
    for sentence in ("lose the next 3 mailbox frames", "lose the answers of the next 3 mailbox frames"):
        fault(sentence)
        for slave in line.master.slaves:
            bench.expect(product_code(slave), bench.PRODUCT_CODE.to_bytes(4, "little"), f"product code by SDO: {sentence}")


def product_code(slave):
    for _ in range(10):
        try:
            return slave.sdo_read(0x1018, 2)
        except bench.REFUSALS:
            continue
    raise bench.Failure("an SDO fails ten times")


bench.run(main)
