"""Every object of the table reads with its default and refuses what it must refuse: INTERFACE TABLE.

The table is crates/nx-ect101/tables/coe_objects.toml; the unit has the factory setting. What a refusal must
be is written here, from the manual (7-6-2 and A-6), not read from the code.
"""

import tomllib

import bench
import pysoem

ACCESS_NOT_SUPPORTED = 0x0601_0000
READ_ONLY = 0x0601_0002
SUBINDEX_0_IS_NOT_0 = 0x0601_0003
NO_OBJECT = 0x0602_0000
WRONG_LENGTH = 0x0607_0010
NO_SUBINDEX = 0x0609_0011
OUT_OF_RANGE = 0x0609_0030
INTERNAL_STATUS = 0x0800_0021
WRONG_STATE = 0x0800_0022

READ_IN_PRE_OP = ("ro", "rw", "rw_pre_op")
WRITE_IN_PRE_OP = ("rw", "rw_pre_op")
# What the factory setting maps: 1601 and 1A01 with six entries each, 1A00, 1BFE.
MAPPED = {0x6000: range(1, 7), 0x7000: range(1, 7), 0x6003: range(1, 6)}
# The serial number is the unit file's; 10E0 shows the ID switch; the time and the cycle are running.
OF_THE_UNIT = {(0x1018, 4), (0x10E0, 1), (0x10E0, 3), (0x10F8, 0), (0x1C32, 2), (0x1C33, 2)}


def main(interface, table):
    with open(table, "rb") as file:
        objects = tomllib.load(file)["object"]
    with bench.network(interface, 1) as master:
        (slave,) = master.slaves
        seen = in_pre_op(slave, objects)
        bench.on_pre_op_to_safe_op(slave, lambda _: None)
        bench.to_op(master)
        seen += in_op(master, slave, objects)
    print(f"{len(objects)} objects, {seen} accesses as they must be")


def entries(described):
    """The entries of an object, runs unrolled."""
    for entry in described["entries"]:
        for sub in range(entry.get("from", entry.get("sub")), entry.get("to", entry.get("sub")) + 1):
            yield sub, entry


def size_bytes(entry):
    return (entry["size_bits"] + 7) // 8


def default(entry, sub):
    """The bytes of the value at power-on."""
    size = size_bytes(entry)
    if "default_base" in entry:
        return (entry["default_base"] | sub << 8).to_bytes(size, "little")
    value = entry.get("default", 0)
    return value.encode().ljust(size) if isinstance(value, str) else value.to_bytes(size, "little")


def in_pre_op(slave, objects):
    seen = 0
    for described in objects:
        index = described["index"]
        for sub, entry in entries(described):
            seen += read_in_pre_op(slave, index, sub, entry) + write_in_pre_op(slave, index, sub, entry)
        seen += absent_subindexes(slave, described) + complete_access(slave, described)
    for index in (0x1001, 0x1600, 0x1604, 0x1A04, 0x2001, 0x6004, 0x7003, 0xF000):
        refuse_read(slave, index, 0, NO_OBJECT)
        refuse_write(slave, index, 0, b"\x00", NO_OBJECT)
        seen += 2
    return seen


def read_in_pre_op(slave, index, sub, entry):
    if entry["access"] in READ_IN_PRE_OP:
        value = slave.sdo_read(index, sub)
        bench.expect(len(value), size_bytes(entry), f"bytes of {index:04X}:{sub:02X}")
        if (index, sub) not in OF_THE_UNIT:
            bench.expect(value, default(entry, sub), f"default of {index:04X}:{sub:02X}")
    else:
        refuse_read(slave, index, sub, WRONG_STATE)
    return 1


def write_in_pre_op(slave, index, sub, entry):
    """One write that must be refused, for every reason that there is for this entry."""
    value, access = default(entry, sub), entry["access"]
    if access in ("ro", "ro_safe_op"):
        refuse_write(slave, index, sub, value, READ_ONLY)
        return 1
    if access not in WRITE_IN_PRE_OP:
        refuse_write(slave, index, sub, value, WRONG_STATE)
        return 1
    if access == "rw_pre_op" and sub > 0:
        refuse_write(slave, index, sub, value, SUBINDEX_0_IS_NOT_0)
        return 1
    refuse_write(slave, index, sub, value + b"\x00", WRONG_LENGTH)
    outside = outside_of(entry)
    if outside is not None:
        refuse_write(slave, index, sub, outside.to_bytes(size_bytes(entry), "little"), OUT_OF_RANGE)
    return 2


def outside_of(entry):
    """A value that no range of the entry holds, or None."""
    ranges = entry.get("range", [])
    highest = max((pair[1] for pair in ranges), default=None)
    if highest is None or highest + 1 >= 1 << entry["size_bits"]:
        return None
    return highest + 1


def absent_subindexes(slave, described):
    """The first gap in the subindexes, and the one after the last."""
    index, present = described["index"], {sub for sub, _ in entries(described)}
    absent = [sub for sub in range(max(present) + 2) if sub not in present]
    for sub in absent:
        refuse_read(slave, index, sub, NO_SUBINDEX)
        refuse_write(slave, index, sub, b"\x00", NO_SUBINDEX)
    return 2 * len(absent)


def complete_access(slave, described):
    index = described["index"]
    if not described["complete_access"]:
        refuse_read(slave, index, 0, ACCESS_NOT_SUPPORTED, complete=True)
        return 1
    whole = slave.sdo_read(index, 0, 2048, True)
    number = dict(entries(described)).get(0)
    bench.expect(whole[:2], default(number, 0) + b"\x00", f"first 16 bits of all of {index:04X}")
    return 1


def in_op(master, slave, objects):
    """Process data objects that are not mapped can be read now; mapping objects can no longer be written."""
    seen = 0
    for described in objects:
        index = described["index"]
        for sub, entry in entries(described):
            # The watchdog of the outputs wants to see the master between mailbox accesses.
            bench.expect(bench.exchange(master), master.expected_wkc, "working counter")
            seen += one_in_op(slave, index, sub, entry)
    return seen


def one_in_op(slave, index, sub, entry):
    value, access = default(entry, sub), entry["access"]
    if access == "rw_pre_op":
        refuse_write(slave, index, sub, value, WRONG_STATE)
        return 1
    if access not in ("ro_safe_op", "rw_op"):
        return 0
    if sub in MAPPED.get(index, ()):
        refuse_read(slave, index, sub, INTERNAL_STATUS)
        refuse_write(slave, index, sub, value, READ_ONLY if access == "ro_safe_op" else INTERNAL_STATUS)
        return 2
    bench.expect(slave.sdo_read(index, sub), value, f"{index:04X}:{sub:02X} in OP")
    if access == "ro_safe_op":
        refuse_write(slave, index, sub, value, READ_ONLY)
    else:
        written = bench.pattern(index + sub, size_bytes(entry))
        slave.sdo_write(index, sub, written)
        bench.expect(slave.sdo_read(index, sub), written, f"{index:04X}:{sub:02X} after a write")
    return 2


def refuse_read(slave, index, sub, abort_code, complete=False):
    try:
        value = slave.sdo_read(index, sub, 2048, complete)
    except pysoem.SdoError as abort:
        bench.expect(abort.abort_code, abort_code, f"reading {index:04X}:{sub:02X}")
        return
    raise bench.Failure(f"reading {index:04X}:{sub:02X} gave {value.hex(' ')}, wanted abort {abort_code:08X}")


def refuse_write(slave, index, sub, value, abort_code):
    try:
        slave.sdo_write(index, sub, value)
    except pysoem.SdoError as abort:
        bench.expect(abort.abort_code, abort_code, f"writing {index:04X}:{sub:02X}")
        return
    raise bench.Failure(f"writing {index:04X}:{sub:02X} was taken, wanted abort {abort_code:08X}")


bench.run(main)
