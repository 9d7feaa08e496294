"""Events as a master sees them: INTERFACE told | remember FILE | cause FILE | compare FILE | damaged.

told: a unit whose I/O allocation has other sizes than the master's mapping tells so on each channel, while process
data go on: emergency, diagnosis history 10F3, current errors 2003 and 2004, error status 2002:01, 1BFE and 1BFF
among the inputs. It is reset, acknowledged, cleared.
remember: writes the history of a new unit to FILE. cause: causes events before. compare: after a power-off, the
history is the one in FILE.
damaged: a unit that has lost its non-volatile memory stays in INIT and says why.
"""

import contextlib
import json
import pathlib
import signal
import struct
import threading
import time

import bench
import pysoem

HISTORY, OBSERVATIONS, MINOR_FAULTS, ERROR_STATUS, CLEAR_LOG, SYSTEM_TIME = 0x10F3, 0x2003, 0x2004, 0x2002, 0x2100, 0x10F8
NEWEST, ACKNOWLEDGED, NEW, ENABLE_EMERGENCIES, FIRST_MESSAGE, LAST_MESSAGE = 2, 3, 4, 5, 0x06, 0x25
RESET_ERRORS = 2
MINOR_FAULT = 1 << 5
OUT_OF_RANGE = 0x0609_0030

# 39170000, as an emergency message, as a current error, and in the history up to its time stamp.
MISMATCH = 0x3917_0000
EMERGENCY = (0xFF30, 0, 0, 0x0000, 0x3917)
CURRENT_ERROR = struct.pack("<III", MISMATCH, 0x0007_0000, 0)
MESSAGE_HEAD = struct.pack("<IHH", 0xFF30_E800, 0x0012, 0x3917)

NO_MEMORY = 0x0002
UNKNOWN_STATE_REQUESTED = 0x0012
UNKNOWN_STATE = 0x05
# The clock of this computer is the one of the CPU Unit; the rest is for a host that does other things too.
CLOCK_TOLERANCE_NS = 5_000_000_000
# A host that does other things for a while is no master that has gone.
WATCHDOG_MS = 5_000
# Cycles of 1 ms in which an emergency that should not be there would have come.
STILL_CYCLES = 50
# More than the history holds, so that it has gone round.
EVENTS_CAUSED = 35


def main(interface, what, *arguments):
    scenarios = {"told": told, "remember": remember, "cause": cause, "compare": compare, "damaged": damaged}
    scenarios[what](interface, *arguments)


def told(interface):
    with bench.network(interface, 1) as master:
        (slave,) = master.slaves
        emergencies = []
        slave.add_emergency_callback(lambda it: emergencies.append((it.error_code, it.error_reg, it.b1, it.w1, it.w2)))
        bench.on_pre_op_to_safe_op(slave, set_up)
        slave.sdo_write(HISTORY, ENABLE_EMERGENCIES, b"\x01\x00")
        bench.expect(history_flags(slave), [0, 0, 0, 0], "history of a new unit")
        begin_ns = time.time_ns()
        bench.to_op(master)
        with running(master) as process_data:
            Told(slave, process_data, emergencies).walk(begin_ns)
        print(f"39170000 told on every channel, with {process_data.cycles} cycles of process data beside it")


class Told:
    """The unit tells of its mismatch, in OP."""

    def __init__(self, slave, process_data, emergencies):
        self.slave, self.process_data, self.emergencies = slave, process_data, emergencies

    def walk(self, begin_ns):
        self.expect_emergency("SAFE-OP")
        self.expect_records(1, begin_ns)
        self.process_data.wait_for(lambda inputs: status_of(inputs) == (1, MINOR_FAULT), "1BFE and 1BFF")

        begin_ns = time.time_ns()
        self.reset()
        self.expect_emergency("reset with the cause in place")
        self.expect_records(2, begin_ns)
        self.acknowledge()
        self.clear()

        self.slave.sdo_write(HISTORY, ENABLE_EMERGENCIES, b"\x00\x00")
        self.reset()
        self.expect_no_emergency()
        bench.expect(history_flags(self.slave), [1, 6, 6, 1], "history after a reset without emergency")
        self.process_data.wait_for(lambda inputs: status_of(inputs) == (1, MINOR_FAULT), "1BFE once more")

    def reset(self):
        self.slave.sdo_write(ERROR_STATUS, RESET_ERRORS, b"\x01")

    def expect_emergency(self, name):
        for _ in self.process_data.frames():
            self.slave.mbx_receive()
            if self.emergencies:
                break
        bench.expect(self.emergencies, [EMERGENCY], f"{name}: emergencies")
        self.emergencies.clear()

    def expect_no_emergency(self):
        for _, _ in zip(range(STILL_CYCLES), self.process_data.frames()):
            self.slave.mbx_receive()
        bench.expect(self.emergencies, [], "emergencies while they are off")

    def expect_records(self, count, begin_ns):
        """`count` records of the mismatch; the newest is not older than `begin_ns`."""
        slave, newest = self.slave, FIRST_MESSAGE + count - 1
        flags = history_flags(slave)
        bench.expect(flags, [count, newest, newest, 1], "10F3:01 to :04")
        message = slave.sdo_read(HISTORY, newest)
        bench.expect(message[:8], MESSAGE_HEAD, f"10F3:{newest:02X}: code, flags, text")
        bench.expect(message[16:], bytes(8), f"10F3:{newest:02X}: parameters")
        bench.expect(slave.sdo_read(HISTORY, newest + 1), bytes(24), "the message behind the newest")
        expect_time(message[8:16], begin_ns, f"time of 10F3:{newest:02X}")
        expect_time(slave.sdo_read(SYSTEM_TIME, 0), begin_ns, "10F8")
        self.expect_current_error()

    def expect_current_error(self):
        slave = self.slave
        bench.expect(slave.sdo_read(ERROR_STATUS, 1), bytes([MINOR_FAULT]), "2002:01")
        bench.expect(slave.sdo_read(OBSERVATIONS, 0), b"\x00", "observations")
        bench.expect(slave.sdo_read(MINOR_FAULTS, 0), b"\x01", "minor faults")
        bench.expect(slave.sdo_read(MINOR_FAULTS, 1), CURRENT_ERROR, "2004:01")

    def acknowledge(self):
        slave = self.slave
        slave.sdo_write(HISTORY, ACKNOWLEDGED, bytes([FIRST_MESSAGE]))
        bench.expect(history_flags(slave), [2, 7, 7, 1], "10F3 after an older message was acknowledged")
        bench.expect(abort_code(slave, HISTORY, ACKNOWLEDGED, b"\x09"), OUT_OF_RANGE, "acknowledging no message")
        slave.sdo_write(HISTORY, ACKNOWLEDGED, bytes([FIRST_MESSAGE + 1]))
        bench.expect(history_flags(slave), [2, 7, 7, 0], "10F3 after the newest message was acknowledged")
        self.process_data.wait_for(lambda inputs: status_of(inputs) == (0, MINOR_FAULT), "1BFE acknowledged")

    def clear(self):
        slave = self.slave
        bench.expect(abort_code(slave, CLEAR_LOG, 0, b"elcm"), OUT_OF_RANGE, "a wrong word in 2100")
        slave.sdo_write(CLEAR_LOG, 0, b"elcl")
        bench.expect(history_flags(slave), [0, 0, 0, 0], "cleared history")
        bench.expect(slave.sdo_read(HISTORY, FIRST_MESSAGE), bytes(24), "message of a cleared history")
        self.expect_current_error()


def remember(interface, file):
    with bench.network(interface, 1) as master:
        bench.expect(history_flags(master.slaves[0]), [0, 0, 0, 0], "history of a new unit")
        store(master.slaves[0], file)


def cause(interface, file):
    with bench.network(interface, 1) as master:
        (slave,) = master.slaves
        for _ in range(EVENTS_CAUSED):
            request(master, UNKNOWN_STATE)
            bench.expect((slave.state, slave.al_status), (0x12, UNKNOWN_STATE_REQUESTED), "a state that is none")
            request(master, pysoem.PREOP_STATE | pysoem.STATE_ACK)
        newest = FIRST_MESSAGE + EVENTS_CAUSED % 32 - 1
        bench.expect(history_flags(slave), [32, newest, newest, 1], "history that has gone round")
        slave.sdo_write(HISTORY, ACKNOWLEDGED, bytes([newest]))
        store(slave, file)


def store(slave, file):
    pathlib.Path(file).write_text(json.dumps(history(slave)))


def compare(interface, file):
    with bench.network(interface, 1) as master:
        (slave,) = master.slaves
        bench.expect(history(slave), json.loads(pathlib.Path(file).read_text()), "history after power-off")
        bench.expect(slave.sdo_read(ERROR_STATUS, 1), b"\x00", "current errors after power-off")
        bench.expect(slave.sdo_read(MINOR_FAULTS, 0), b"\x00", "minor faults after power-off")


def damaged(interface):
    pysoem.settings.timeouts.ret = bench.FRAME_TIMEOUT_US
    master = pysoem.Master()
    master.open(interface)
    try:
        bench.expect(master.config_init(), 1, "slaves on the line")
        for state in (pysoem.PREOP_STATE, pysoem.PREOP_STATE | pysoem.STATE_ACK, pysoem.OP_STATE | pysoem.STATE_ACK):
            request(master, state)
            slave = master.slaves[0]
            bench.expect((slave.state, slave.al_status), (0x11, NO_MEMORY), f"after a request for {state:#04x}")
    finally:
        master.close()


def request(master, state):
    """Asks for a state, answered before the next frame, and reads what AL status says then."""
    slave = master.slaves[0]
    slave.state = state
    slave.write_state()
    master.read_state()


def set_up(slave):
    """1BFF behind 1BFE, so that the inputs end with new messages and error status; a patient watchdog."""
    pdos = (0x1A00, 0x1A01, 0x1BFE, 0x1BFF)
    slave.sdo_write(0x1C13, 0, b"\x00")
    for sub, pdo in enumerate(pdos, start=1):
        slave.sdo_write(0x1C13, sub, struct.pack("<H", pdo))
    slave.sdo_write(0x1C13, 0, bytes([len(pdos)]))
    slave.set_watchdog("processdata", WATCHDOG_MS)


def status_of(inputs):
    """New Messages Available and Sysmac Error Status."""
    return inputs[-2], inputs[-1]


def history_flags(slave):
    """10F3:01 to :04."""
    return [slave.sdo_read(HISTORY, sub)[0] for sub in (1, NEWEST, ACKNOWLEDGED, NEW)]


def history(slave):
    """Everything of 10F3 that outlives power-off."""
    flags = [slave.sdo_read(HISTORY, sub).hex() for sub in (1, NEWEST, NEW)]
    return flags + [slave.sdo_read(HISTORY, sub).hex() for sub in range(FIRST_MESSAGE, LAST_MESSAGE + 1)]


def abort_code(slave, index, sub, value):
    try:
        slave.sdo_write(index, sub, value)
    except pysoem.SdoError as refusal:
        return refusal.abort_code
    return None


def expect_time(value, begin_ns, name):
    seen, now_ns = int.from_bytes(value, "little"), time.time_ns()
    if not begin_ns - CLOCK_TOLERANCE_NS <= seen <= now_ns + CLOCK_TOLERANCE_NS:
        raise bench.Failure(f"{name}: {seen} ns, the master's clock said {begin_ns} to {now_ns}")


class ProcessData(threading.Thread):
    """Process data each millisecond, whatever the main thread does in the mailbox meanwhile."""

    def __init__(self, master):
        super().__init__(name="process data")
        self.master, self.inputs, self.cycles, self.failure = master, b"", 0, None
        self.ended = False
        self.passed = threading.Condition()

    def run(self):
        # Without end; the timer of `bench.cycles` is the whole program's.
        for _ in bench.cycles(1_000_000):
            working_counter = bench.exchange(self.master)
            with self.passed:
                if working_counter != self.master.expected_wkc:
                    self.failure = f"working counter {working_counter} in cycle {self.cycles}"
                self.inputs = bytes(self.master.slaves[0].input)
                self.cycles += 1
                self.passed.notify_all()
                if self.ended or self.failure:
                    return

    def frames(self):
        """Yields the inputs once for each of the next cycles, while the exchange goes well."""
        for _ in range(bench.ECHO_CYCLES):
            with self.passed:
                cycle = self.cycles
                if not self.passed.wait_for(lambda: self.cycles > cycle or self.failure, bench.STATE_TIMEOUT_US / 1e6):
                    raise bench.Failure("process data stand still")
                if self.failure:
                    raise bench.Failure(self.failure)
                inputs = self.inputs
            yield inputs

    def wait_for(self, is_wanted, name):
        for inputs in self.frames():
            if is_wanted(inputs):
                return
        raise bench.Failure(f"{name}: inputs end with {bench.show(self.inputs[-2:])}")


@contextlib.contextmanager
def running(master):
    """Process data beside what the body does. They must have gone on until its end."""
    master.always_release_gil = True
    # The timer's signal has to wait for the thread that asks for it, not end the program in this one.
    signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGALRM})
    process_data = ProcessData(master)
    process_data.start()
    try:
        yield process_data
        for _ in process_data.frames():
            break
    finally:
        with process_data.passed:
            process_data.ended = True
        process_data.join()
    master.read_state()
    bench.expect(master.slaves[0].state, pysoem.OP_STATE, "state at the end")


bench.run(main)
