"""A PLC runtime outside, by pymodbus: PORT. It works while modbus_master.py exchanges process data."""

import time

import bench
from pymodbus.client import ModbusTcpClient

ILLEGAL_DATA_ADDRESS = 2
PATIENCE_S = 20
UNIT = 1

# Registers of the map: entry UINTs n begins at (n - 1) * 15; 10000 is added to force outputs, 20000 for inputs.
COUNT, FORCED_OUTPUT, WRITTEN_OUTPUT, ANSWER, FORCED_INPUT = 0, 1, 2, 15, 18
ORDER, DONE = 60, 61
OUTPUTS, INPUTS = 10_000, 20_000
SENT, FORCED, FORCED_BY_INPUT = 0x2222, 0xF0F0, 0x7777
M_TO_C_VALID, IO_DATA_ACTIVE = 1, 16


def main(port):
    client = ModbusTcpClient("127.0.0.1", port=int(port))
    if not client.connect():
        raise bench.Failure("no connection")
    with client:
        wait(lambda: all(valid(client)), "valid data from the master")
        reads_what_the_master_sends(client)
        refused_outside_of_the_map(client)
        writes_what_no_program_writes(client)
        forced_values_survive(client)
        order(client, 3)
        ok(client.write_register(DONE, 1, device_id=UNIT))


def reads_what_the_master_sends(client):
    wait(lambda: inputs(client, FORCED_INPUT)[0] == SENT, "the master's data")
    before = inputs(client, COUNT)[0]
    wait(lambda: inputs(client, COUNT)[0] not in (0, before), "the master's next data")


def refused_outside_of_the_map(client):
    for refused in (
        client.read_input_registers(OUTPUTS, device_id=UNIT),
        client.read_input_registers(59, count=2, device_id=UNIT),
        client.read_holding_registers(90, device_id=UNIT),
        client.write_register(90, 1, device_id=UNIT),
        client.read_coils(0, device_id=UNIT),
    ):
        bench.expect((refused.isError(), refused.exception_code), (True, ILLEGAL_DATA_ADDRESS), "exception")


def writes_what_no_program_writes(client):
    order(client, 1)
    written = list(range(100, 113))
    ok(client.write_registers(ORDER + 2, written, device_id=UNIT))
    bench.expect(outputs(client, ORDER + 2, len(written)), written, "what was written, at once")


def forced_values_survive(client):
    """The master holds these against order 2, which is written with them in the same task period or not at all."""
    ok(client.write_register(WRITTEN_OUTPUT, 0xAAAA, device_id=UNIT))
    wait(lambda: outputs(client, WRITTEN_OUTPUT, 1) == [SENT], "the user program to write over it")
    stop_judging(client)
    ok(client.write_register(OUTPUTS + FORCED_OUTPUT, FORCED, device_id=UNIT))
    ok(client.write_register(INPUTS + FORCED_INPUT, FORCED_BY_INPUT, device_id=UNIT))
    wait(lambda: outputs(client, FORCED_INPUT, 1) == [FORCED_BY_INPUT], "the user program to copy what is forced")
    order(client, 2)
    judge(client)
    bench.expect(outputs(client, FORCED_OUTPUT, 1), [FORCED], "a forced output under a running program")
    flags = ok(client.read_coils(OUTPUTS, count=3, device_id=UNIT)).bits[:3]
    bench.expect(flags, [False, True, False], "what is forced")
    stop_judging(client)
    ok(client.write_coil(OUTPUTS + FORCED_OUTPUT, False, device_id=UNIT))
    ok(client.write_coil(INPUTS + FORCED_INPUT, False, device_id=UNIT))
    wait(lambda: outputs(client, FORCED_OUTPUT, 1) == [SENT], "the user program to write what was forced")
    wait(lambda: outputs(client, FORCED_INPUT, 1) == [SENT], "the master's data again")
    order(client, 1)
    judge(client)


def stop_judging(client):
    """The master judges no cycle in which the count is 0."""
    ok(client.write_register(OUTPUTS + COUNT, 0, device_id=UNIT))


def judge(client):
    ok(client.write_coil(OUTPUTS + COUNT, False, device_id=UNIT))
    counted = outputs(client, COUNT, 1)
    wait(lambda: outputs(client, COUNT, 1) not in ([0], counted), "the count to go on")


def order(client, number):
    ok(client.write_register(ORDER, number, device_id=UNIT))
    wait(lambda: inputs(client, ANSWER)[0] >= number, f"the master to see order {number}")


def valid(client):
    bits = ok(client.read_discrete_inputs(0, count=18, device_id=UNIT)).bits
    return bits[M_TO_C_VALID], bits[IO_DATA_ACTIVE]


def inputs(client, address, count=1):
    return ok(client.read_input_registers(address, count=count, device_id=UNIT)).registers


def outputs(client, address, count):
    return ok(client.read_holding_registers(address, count=count, device_id=UNIT)).registers


def ok(response):
    if response.isError():
        raise bench.Failure(f"refused: {response}")
    return response


def wait(is_so, what):
    end = time.monotonic() + PATIENCE_S
    while not is_so():
        if time.monotonic() > end:
            raise bench.Failure(f"waited for {what}")


bench.run(main)
