"""The master's half of a test with modbus_client.py: INTERFACE. Process data run until the client says that it is done.

The unit has four entries UINTs from the master and six to it; the user program copies 1 to 4. So the client's values
in entry 5 stay, and are the orders that the two work by.
"""

import struct

import bench

OUTPUT_ENTRIES, INPUT_ENTRIES, ELEMENTS = 4, 6, 15
# Elements by place in the image; the copy program brings outputs back at the same places.
COUNT, FORCED_OUTPUT, WRITTEN_OUTPUT, ANSWER, FORCED_INPUT = 0, 1, 2, 15, 18
ORDER, DONE = 60, 61
SENT = 0x2222
FORCED, FORCED_BY_INPUT = 0xF0F0, 0x7777
CYCLES_MOST = 30_000


def main(interface):
    with bench.network(interface, 1) as master:
        slave = master.slaves[0]
        bench.on_pre_op_to_safe_op(slave, map_entries)
        bench.to_op(master)
        orders = set()
        for cycle in bench.cycles(CYCLES_MOST):
            inputs = one_cycle(master, slave, cycle, orders)
            if inputs[DONE]:
                break
        else:
            raise bench.Failure("the client is not done")
        bench.expect(orders, {0, 1, 2, 3}, "orders that were seen")


def map_entries(slave):
    for index, base, count in ((0x1601, 0x7000_00F0, OUTPUT_ENTRIES), (0x1A01, 0x6000_00F0, INPUT_ENTRIES)):
        slave.sdo_write(index, 0, b"\x00")
        for sub in range(1, count + 1):
            slave.sdo_write(index, sub, struct.pack("<I", base | sub << 8))
        slave.sdo_write(index, 0, bytes([count]))


def one_cycle(master, slave, cycle, orders):
    """Sends, receives, and holds what came against the order that came with it."""
    outputs = [SENT] * (OUTPUT_ENTRIES * ELEMENTS)
    outputs[COUNT] = cycle & 0xFFFF
    # The client reads how far the master is.
    outputs[ANSWER] = max(orders, default=0)
    slave.output = struct.pack(f"<{len(outputs)}H", *outputs)
    bench.expect(bench.exchange(master), master.expected_wkc, f"working counter in cycle {cycle}")
    data = bench.data_sets(slave)
    inputs = struct.unpack(f"<{len(data) // 2}H", data)
    order = inputs[ORDER]
    orders.add(order)
    if 0 not in inputs[:3]:
        # What the client writes where the user program writes is never seen here.
        bench.expect(inputs[WRITTEN_OUTPUT], SENT, f"an output that is not forced, in cycle {cycle}")
        bench.expect(inputs[FORCED_OUTPUT], FORCED if order == 2 else SENT, f"a forced output, order {order}")
        bench.expect(inputs[FORCED_INPUT], FORCED_BY_INPUT if order == 2 else SENT, f"a forced input, order {order}")
    return inputs


bench.run(main)
