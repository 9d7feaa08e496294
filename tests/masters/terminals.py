"""A line of terminals and an NX-ECT101: INTERFACE.

Coupler, 8 outputs, 8 inputs, NX-ECT101, 16 inputs, then twice 4 outputs that a program copies to 4 inputs. The last two
share a byte of outputs and a byte of inputs in logical memory.
"""

import bench
import pysoem

UNITS = 7
SHARED = 0xA5


def main(interface):
    pysoem.settings.timeouts.ret = bench.FRAME_TIMEOUT_US
    master = pysoem.Master()
    master.open(interface)
    try:
        bench.expect(master.config_init(), UNITS, "slaves on the line")
        bench.expect(master.state_check(pysoem.PREOP_STATE, bench.STATE_TIMEOUT_US), pysoem.PREOP_STATE, "state")
        bench.on_pre_op_to_safe_op(master.slaves[3], lambda slave: None)
        bench.to_op(master)
        first, second = master.slaves[5:7]
        first.output = second.output = bytes([SHARED])
        wait_for(master, lambda: first.input == second.input == bytes([SHARED]))
        bench.request(master, pysoem.INIT_STATE)
    finally:
        master.close()
    print(f"{UNITS} units in OP; two terminals share a byte")


def wait_for(master, is_there):
    for _ in bench.cycles(bench.ECHO_CYCLES):
        bench.exchange(master)
        if is_there():
            return
    seen = [bench.show(slave.input) for slave in master.slaves]
    raise bench.Failure(f"the copied bits did not come back: {seen}")


bench.run(main)
