"""Messages go to the CPU Unit and come back: INTERFACE COUNT. The unit runs `builtin:messages`.

The master writes as fast as the unit lets it, reads what comes back meanwhile, and from time to time writes more
than the unit can hold. A write while not ready must be refused and leave the message that waits, a write while
ready must be taken; what comes back must be every message, once, in order. Each message carries its number.
"""

import bench
import pysoem

TO_CPU_UNIT, FROM_CPU_UNIT, MESSAGE = 0x3001, 0x3000, 1
MESSAGE_OCTETS = 200
NOT_READY = 0x0800_0021
# NX Unit Status, the first byte of the inputs.
NX_MESSAGES_ENABLED, NEW_MESSAGE, READY_TO_WRITE = 1 << 0, 1 << 3, 1 << 4
# Messages that can wait while the master reads none: in 3000, in the program, in 5000.
ROOM = 3
# So often, in messages, the master lets all of them come back and then writes more than that.
FLOOD_EVERY = 50
# Exchanges without any progress; each is at least one frame to the unit and back.
PATIENCE = 100_000
# A host that does other things for a while is no master that has gone.
WATCHDOG_MS = 5_000
# Cycles of 1 ms in which a message that should not be there would have come.
STILL_CYCLES = 100


def main(interface, count):
    count = int(count)
    with bench.network(interface, 1) as master:
        (slave,) = master.slaves
        bench.on_pre_op_to_safe_op(slave, lambda it: it.set_watchdog("processdata", WATCHDOG_MS))
        bench.to_op(master)
        refused = exchange_messages(master, slave, count)
    print(f"{count} messages there and back, {refused} writes refused while not ready")


def flags(master, slave):
    bench.expect(bench.exchange(master), master.expected_wkc, "working counter")
    return slave.input[0]


def exchange_messages(master, slave, count):
    """Sends messages 0 to count - 1 and gets each of them back. How many writes were refused."""
    sent = received = refused = idle = 0
    while received < count:
        idle += 1
        if idle > PATIENCE:
            raise bench.Failure(f"no progress: {sent} sent, {received} received, flags {flags(master, slave):#04x}")
        flood_is_due = sent % FLOOD_EVERY == 0
        if flood_is_due and sent == received:
            taken, not_taken = flood(master, slave, sent, count)
            sent, refused, idle = sent + taken, refused + not_taken, 0
        elif sent < count and not flood_is_due and flags(master, slave) & READY_TO_WRITE:
            bench.expect(write(slave, sent), True, f"message {sent} taken, as the unit is ready")
            sent, idle = sent + 1, 0
        if flags(master, slave) & NEW_MESSAGE:
            message = slave.sdo_read(FROM_CPU_UNIT, MESSAGE)
            bench.expect(message, bench.pattern(received, MESSAGE_OCTETS), f"message {received}")
            received, idle = received + 1, 0
    for _ in bench.cycles(STILL_CYCLES):
        seen = flags(master, slave) & (NX_MESSAGES_ENABLED | NEW_MESSAGE | READY_TO_WRITE)
        bench.expect(seen, NX_MESSAGES_ENABLED | READY_TO_WRITE, "flags after the last message")
    return refused


def flood(master, slave, first, count):
    """Writes twice as much as there is room for, without a look at the flag. How many were taken, and refused."""
    taken = refused = 0
    for _ in range(min(2 * ROOM, count - first)):
        flags(master, slave)
        if write(slave, first + taken):
            taken += 1
        else:
            refused += 1
    if not 0 < taken <= ROOM:
        raise bench.Failure(f"{taken} messages taken, there is room for 1 to {ROOM}")
    return taken, refused


def write(slave, number):
    """Whether the unit has taken message `number`."""
    try:
        slave.sdo_write(TO_CPU_UNIT, MESSAGE, bench.pattern(number, MESSAGE_OCTETS))
    except pysoem.SdoError as refusal:
        bench.expect(refusal.abort_code, NOT_READY, "abort code of a write while not ready")
        return False
    return True


bench.run(main)
