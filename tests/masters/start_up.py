"""Units that are not ready: INTERFACE UNITS. Their unit files have a start-up time; a reset by register 0x0040 starts it.

A master that searches once finds all units, in INIT, and they stay there: the request for PRE-OP came while another
one waited. `ready_units` of docs/user/test-your-master.md searches again.
"""

import time

import bench
import pysoem

ESC_RESET = 0x0040
# Longer than the start-up time of the units.
LONG_US = 2_000_000


def ready_units(master, units, seconds):
    """Searches until all units are there, in PRE-OP: one that starts up has not got the request of this search."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if master.config_init() == units and master.state_check(pysoem.PREOP_STATE, 500_000) == pysoem.PREOP_STATE:
            return
    raise TimeoutError(f"not all of {units} units are in PRE-OP after {seconds} s")


def main(interface, units):
    units = int(units)
    pysoem.settings.timeouts.ret = bench.FRAME_TIMEOUT_US
    master = pysoem.Master()
    master.open(interface)
    try:
        ready_units(master, units, 10)
        restart(master)
        search_once(master, units)
        restart(master)
        ready_units(master, units, 10)
        for slave in master.slaves:
            bench.expect(slave.sdo_read(0x1018, 2)[:2], bench.PRODUCT_CODE.to_bytes(2, "little"), "product code by SDO")
    finally:
        master.close()
    print(f"{units} units that are not ready: in INIT after one search, in PRE-OP after further ones")


def restart(master):
    for slave in master.slaves:
        for letter in b"RES":
            slave._fpwr(ESC_RESET, bytes([letter]))


def search_once(master, units):
    bench.expect(master.config_init(), units, "slaves on the line")
    bench.expect(master.state_check(pysoem.PREOP_STATE, LONG_US), pysoem.INIT_STATE, "state after one search")
    for slave in master.slaves:
        try:
            slave.sdo_read(0x1018, 2)
        except bench.REFUSALS:
            continue
        raise bench.Failure("an SDO was answered in INIT")


bench.run(main)
