"""A unit in OP is steered by `ectwin ctl` meanwhile, and the master sees it: INTERFACE ECTWIN.

Forced values, lost frames, PROGRAM mode, a cable, a fault and a restart: each is an order of `ectwin ctl do`, an
expectation of `ectwin ctl expect`, and something that the master notices by itself.
"""

import subprocess
import time

import bench

# A host that does other things for a while is no master that has gone.
WATCHDOG_MS = 5_000
# A frame that has not come back by then is lost.
LOST_US = 50_000
FRAMES = 10
VALUE = 4660
FORCED = "N1_UINTs_01_C_to_M[0]"
PATIENCE_S = 20
CYCLE_S = 0.001


def main(interface, ectwin):
    with bench.network(interface, 1) as master:
        (slave,) = master.slaves
        slave.set_watchdog("processdata", WATCHDOG_MS)
        bench.on_pre_op_to_safe_op(slave, lambda _: None)
        bench.to_op(master)
        Steered(master, slave, ectwin).walk()
    print("forced, lost, stopped, unplugged, broken and restarted, and the master has seen all of it")


class Steered:
    """The master, its process data, and the command line beside it."""

    def __init__(self, master, slave, ectwin):
        self.master, self.slave, self.ectwin = master, slave, ectwin
        self.lost = 0

    def walk(self):
        self.expect("unit 1 is in OP")
        self.force()
        self.lose_frames()
        self.stop_program()
        self.unplug()
        self.break_it()
        self.restart()

    def force(self):
        self.ctl("force", f"{FORCED}={VALUE}")
        wanted = VALUE.to_bytes(2, "little")
        self.wait_for(lambda: bench.data_sets(self.slave)[:2] == wanted, "the forced value among the inputs")
        self.ctl("expect", f"variable {FORCED} has the value {VALUE}")
        self.ctl("release", FORCED)

    def lose_frames(self):
        before = self.lost
        self.ctl("do", f"lose the next {FRAMES} process data frames")
        self.wait_for(lambda: self.lost >= before + FRAMES, "lost frames")
        counters = [self.exchange() for _ in range(20)]
        bench.expect(counters, [self.master.expected_wkc] * 20, "working counters after the lost frames")
        self.expect("unit 1 is in OP")

    def stop_program(self):
        self.write(0x11)
        self.wait_for(lambda: self.is_read(0x11), "the outputs back in RUN mode")
        self.ctl("do", "set unit 1 to PROGRAM mode")
        # The program copies no more: the inputs stay, whatever the outputs are.
        self.write(0x77)
        for _ in range(50):
            self.exchange()
        bench.expect(self.is_read(0x11), True, "inputs that stay in PROGRAM mode")
        self.ctl("do", "set unit 1 to RUN mode")
        self.wait_for(lambda: self.is_read(0x77), "the outputs back in RUN mode again")

    def write(self, byte):
        self.slave.output = bytes([byte]) * len(self.slave.output)

    def is_read(self, byte):
        return set(bench.data_sets(self.slave)) == {byte}

    def unplug(self):
        self.ctl("do", "unplug cable 1")
        self.wait_for(lambda: self.exchange() < 0, "no frame comes back")
        self.ctl("do", "plug cable 1")
        self.wait_for(lambda: self.exchange() == self.master.expected_wkc, "frames come back")

    def break_it(self):
        self.ctl("do", "break Processing of unit 1")
        self.expect("unit 1 has the error 40200000")
        self.expect("unit 1 is in INIT with AL status code 0x0001")
        self.wait_for(lambda: self.state() == (0x11, 0x0001), "INIT with an error, read by the master")

    def restart(self):
        self.ctl("do", "repair Processing of unit 1", "restart unit 1")
        self.expect("unit 1 has recorded 94B80000")
        self.wait_for(lambda: self.state() == (0x01, 0x0000), "INIT without an error, read by the master")

    def state(self):
        self.master.read_state()
        return self.slave.state, self.slave.al_status

    def expect(self, condition):
        self.ctl("expect", condition, "--within", f"{PATIENCE_S}s")

    def ctl(self, *arguments):
        """Runs `ectwin ctl`, with process data beside it."""
        command = subprocess.Popen([self.ectwin, "ctl", *arguments], stdout=subprocess.PIPE, text=True)
        while not has_ended(command):
            self.exchange()
        if command.returncode != 0:
            raise bench.Failure(f"ctl {arguments}: exit code {command.returncode}: {command.stdout.read()}")

    def wait_for(self, is_there, what):
        end = time.monotonic() + PATIENCE_S
        while not is_there():
            if time.monotonic() > end:
                raise bench.Failure(f"{what}: not within {PATIENCE_S} s; inputs {bytes(self.slave.input).hex(' ')}")
            self.exchange()

    def exchange(self):
        """One cycle of process data; the working counter, or -1 if the frame was lost."""
        self.master.send_processdata()
        counter = self.master.receive_processdata(LOST_US)
        self.lost += counter < self.master.expected_wkc
        return counter


def has_ended(command):
    """Whether a process has ended, or ends within a cycle."""
    try:
        command.wait(CYCLE_S)
        return True
    except subprocess.TimeoutExpired:
        return False


bench.run(main)
