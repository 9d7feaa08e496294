"""A master that a scenario judges: INTERFACE. To OP, a cycle of 1 ms, and back to OP after an error, until the units are gone.

It ends with exit code 0 when nobody answers any more: the run of the scenario is over.
"""

import bench
import pysoem

# Cycles without any answer, after which the units are gone.
SILENT_CYCLES = 1_000
LOOK_EVERY_CYCLES = 20
LIMIT_CYCLES = 120_000


def main(interface):
    master = pysoem.Master()
    master.open(interface)
    try:
        bench.expect(master.config_init(), 1, "slaves on the line")
        bench.to_op(master)
        # Shorter from here on: frames are lost on purpose.
        pysoem.settings.timeouts.ret = 2_000
        bench.expect(judged(master), True, "the run is over")
    finally:
        master.close()


def judged(master):
    """Whether the units are gone."""
    silent = 0
    for cycle in bench.cycles(LIMIT_CYCLES):
        master.send_processdata()
        silent = silent + 1 if master.receive_processdata(2_000) <= 0 else 0
        if silent >= SILENT_CYCLES:
            return True
        if cycle % LOOK_EVERY_CYCLES == 0:
            recover(master)
    return False


def recover(master):
    """One step back to OP, as SOEM's simple_test does it."""
    master.read_state()
    slave = master.slaves[0]
    if slave.state == pysoem.SAFEOP_STATE + pysoem.STATE_ERROR:
        slave.state = pysoem.SAFEOP_STATE + pysoem.STATE_ACK
        slave.write_state()
    elif slave.state == pysoem.SAFEOP_STATE:
        slave.state = pysoem.OP_STATE
        slave.write_state()


bench.run(main)
