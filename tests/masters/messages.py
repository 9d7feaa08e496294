"""Messages go to the CPU Unit and come back: INTERFACE COUNT. The unit runs `builtin:messages`.

The master writes as fast as the unit lets it, and from time to time more than the unit can hold. A write while not
ready must be refused and leave the message that waits; what comes back must be every message, once, in order.
"""

import bench
import pysoem

TO_CPU_UNIT, FROM_CPU_UNIT, MESSAGE = 0x3001, 0x3000, 1
MESSAGE_OCTETS = 200
NOT_READY = 0x0800_0021
# NX Unit Status, the first octet of the inputs.
NX_MESSAGES_ENABLED, NEW_MESSAGE, READY_TO_WRITE = 1 << 0, 1 << 3, 1 << 4
# Messages that can wait while the master reads none: in 3000, in the program, in 5000.
ROOM = 3
# So often, in messages, the master writes more than that.
FLOOD_EVERY = 50
# Exchanges without any progress; each is at least one frame to the unit and back.
PATIENCE = 20_000


def main(interface, count):
    count = int(count)
    with bench.network(interface, 1) as master:
        (slave,) = master.slaves
        bench.on_pre_op_to_safe_op(slave, lambda _: None)
        bench.to_op(master)
        refused = exchange_messages(master, slave, count)
    print(f"{count} messages there and back, {refused} writes refused while not ready")


def flags(master, slave):
    bench.expect(bench.exchange(master), master.expected_wkc, "working counter")
    return slave.input[0]


def exchange_messages(master, slave, count):
    sent = received = refused = idle = 0
    while received < count:
        idle += 1
        if idle > PATIENCE:
            raise bench.Failure(f"no progress: {sent} sent, {received} received, flags {flags(master, slave):#04x}")
        if sent == received and sent % FLOOD_EVERY == 0:
            accepted = flood(master, slave, sent, count)
            refused += 2 * ROOM - accepted
            sent += accepted
        elif sent < count and flags(master, slave) & READY_TO_WRITE and write(slave, sent):
            sent, idle = sent + 1, 0
        if flags(master, slave) & NEW_MESSAGE:
            message = slave.sdo_read(FROM_CPU_UNIT, MESSAGE)
            bench.expect(message, bench.pattern(received, MESSAGE_OCTETS), f"message {received}")
            received, idle = received + 1, 0
    seen = flags(master, slave)
    bench.expect(seen & NX_MESSAGES_ENABLED, NX_MESSAGES_ENABLED, "NX Message Communications Enabled")
    bench.expect(seen & NEW_MESSAGE, 0, "New Message Data Available after the last one")
    return refused


def flood(master, slave, first, count):
    """Writes twice as much as there is room for, without a look at the flag. How many the unit has taken."""
    accepted = 0
    for _ in range(2 * ROOM):
        flags(master, slave)
        accepted += first + accepted < count and write(slave, first + accepted)
    if not accepted or accepted > ROOM:
        raise bench.Failure(f"{accepted} messages taken, there is room for 1 to {ROOM}")
    return accepted


def write(slave, number):
    """Whether the unit has taken message `number`."""
    try:
        slave.sdo_write(TO_CPU_UNIT, MESSAGE, bench.pattern(number, MESSAGE_OCTETS))
    except pysoem.SdoError as refusal:
        bench.expect(refusal.abort_code, NOT_READY, "abort code of a write while not ready")
        return False
    return True


bench.run(main)
