"""What the master scripts share: pysoem brought up step by step, a strict 1 ms cycle, and readable failures.

Each script is started by crates/ectwin-cli/tests/masters/main.rs with the name of the master's interface and ends
with exit code 0, or prints what was wrong and ends with 1.
"""

import contextlib
import signal
import sys

import pysoem

VENDOR_ID = 0x0000_0083
PRODUCT_CODE = 0x0000_017C
STATUS_BYTES = 2  # 1A00, in front of the data sets
NEW_MESSAGES_BYTES = 1  # 1BFE, behind them

STATE_TIMEOUT_US = 5_000_000
# A frame that comes late, because the host was busy, is no frame that was answered wrongly.
FRAME_TIMEOUT_US = 1_000_000
# Cycles until a value must have come back; T_master + 3 T_slave + 2 T_cpu is 12 ms at most, and the rest is
# for a host that does other things too.
ECHO_CYCLES = 500


REFUSALS = (pysoem.SdoError, pysoem.ConfigMapError, pysoem.MailboxError, pysoem.PacketError, pysoem.WkcError)


class Failure(Exception):
    """The unit did not do what a unit does."""


def expect(seen, wanted, what):
    """Fails when `seen` is not `wanted`."""
    if seen != wanted:
        raise Failure(f"{what}: wanted {show(wanted)}, saw {show(seen)}")


def show(value):
    if isinstance(value, (bytes, bytearray)):
        return bytes(value).hex(" ")
    return hex(value) if isinstance(value, int) else repr(value)


@contextlib.contextmanager
def network(interface, units):
    """The master on `interface` with `units` slaves found, in PRE-OP. Back to INIT at the end."""
    pysoem.settings.timeouts.ret = FRAME_TIMEOUT_US
    master = pysoem.Master()
    master.open(interface)
    try:
        expect(master.config_init(), units, "slaves on the line")
        expect(master.state_check(pysoem.PREOP_STATE, STATE_TIMEOUT_US), pysoem.PREOP_STATE, "state of all slaves")
        for slave in master.slaves:
            expect((slave.man, slave.id), (VENDOR_ID, PRODUCT_CODE), "vendor and product")
        yield master
        request(master, pysoem.INIT_STATE)
    finally:
        master.close()


def request(master, state):
    """Asks all slaves for `state` and waits until they are there."""
    master.state = state
    master.write_state()
    if master.state_check(state, STATE_TIMEOUT_US) != state:
        master.read_state()
        seen = [f"state {slave.state:#04x}, AL status code {slave.al_status:#06x}" for slave in master.slaves]
        raise Failure(f"state {state:#04x} not reached: {seen}")


def on_pre_op_to_safe_op(slave, configure):
    """Has `configure(slave)` called between PRE-OP and SAFE-OP, and the startup command of the ESI after it."""

    def startup(_position):
        configure(slave)
        slave.sdo_write(0x2002, 2, b"\x01")

    slave.config_func = startup


def to_op(master, overlap=False):
    """Maps the process data and goes PRE-OP, SAFE-OP, OP with process data running."""
    (master.config_overlap_map if overlap else master.config_map)()
    if master.state_check(pysoem.SAFEOP_STATE, STATE_TIMEOUT_US) != pysoem.SAFEOP_STATE:
        master.read_state()
        seen = [f"state {slave.state:#04x}, AL status code {slave.al_status:#06x}" for slave in master.slaves]
        raise Failure(f"SAFE-OP not reached: {seen}")
    exchange(master, overlap)
    request(master, pysoem.OP_STATE)


def exchange(master, overlap=False):
    """One cycle of process data. Returns the working counter."""
    (master.send_overlap_processdata if overlap else master.send_processdata)()
    return master.receive_processdata(FRAME_TIMEOUT_US)


def cycles(count, period_s=0.001):
    """Yields 0 to count - 1, one per period, by a timer that does not drift."""
    signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGALRM})
    signal.setitimer(signal.ITIMER_REAL, period_s, period_s)
    try:
        for cycle in range(count):
            signal.sigwait({signal.SIGALRM})
            yield cycle
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)


def pattern(seed, length):
    """An image in which every byte depends on `seed` and on its position, so that an inconsistent one is detected."""
    first = seed.to_bytes(4, "little")
    body = bytes((seed * 31 + place * 7) & 0xFF for place in range(4, length))
    return (first + body)[:length]


def seed_of(image):
    """The seed of a pattern, or None when the image is not one: torn, or shifted."""
    seed = int.from_bytes(image[:4], "little")
    return seed if image == pattern(seed, len(image)) else None


def data_sets(slave):
    """The data sets of a slave's inputs, without the status around them."""
    return bytes(slave.input)[STATUS_BYTES:-NEW_MESSAGES_BYTES]


def run(scenario):
    """Runs `scenario(interface, *arguments)` and turns what it says into an exit code."""
    try:
        scenario(*sys.argv[1:])
    except (Failure, *REFUSALS) as failure:
        print(f"failed: {failure!r}", flush=True)
        sys.exit(1)
    print("passed", flush=True)
