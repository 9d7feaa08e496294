//! One unit and its CPU Unit behind real frames, in virtual time: from power-on to data that comes back.

use device::Network;
use nx_ect101::{DataSetKind, Direction, IoAllocation, NxEct101, UnitSettings, device_config, layout};
use plc::{CpuSettings, CpuUnit, Echo};
use time::{Duration, Instant};
use wire::{Command, FrameBuilder, Returned, returned_datagrams};

const PRE_OP: u8 = 0x02;
const SAFE_OP: u8 = 0x04;
const OP: u8 = 0x08;
const TASK_PERIOD: Duration = Duration::from_millis(1);

/// A master that sends a frame every 100 µs, and what it is wired to.
struct Bench {
    network: Network<NxEct101>,
    cpu: CpuUnit,
    now: Instant,
    counter: u8,
}

impl Bench {
    fn power_on(io_allocation: IoAllocation) -> Self {
        let settings = UnitSettings { io_allocation, ..UnitSettings::default() };
        let (unit, cpu_end) = NxEct101::power_on(&settings);
        let now = Instant::ZERO;
        let cpu_settings = CpuSettings { task_period: TASK_PERIOD, ..CpuSettings::default() };
        Self {
            network: Network::power_on([(device_config(&settings), unit)], now),
            cpu: CpuUnit::power_on(now, cpu_settings, cpu_end, Box::new(Echo)),
            now,
            counter: 0,
        }
    }

    fn run_for(&mut self, duration: Duration) {
        let end = self.now + duration;
        loop {
            let next = self.network.deadline().min(self.cpu.deadline());
            if next > end {
                self.now = end;
                return;
            }
            self.now = next;
            if self.cpu.deadline() <= next {
                self.cpu.cycle(next);
            }
            self.network.poll(next);
        }
    }

    fn send(&mut self, command: Command, offset: u16, data: &[u8]) -> Returned {
        self.run_for(Duration::from_micros(100));
        let mut frame = FrameBuilder::new().physical(command, 0, offset, data).finish();
        self.network.frame(self.now, &mut frame);
        self.network.poll(self.now);
        returned_datagrams(&frame).remove(0)
    }

    fn write(&mut self, offset: u16, data: &[u8]) {
        assert_eq!(self.send(Command::Apwr, offset, data).working_counter, 1, "write to {offset:#06X}");
    }

    fn read(&mut self, offset: u16, length_bytes: usize) -> Vec<u8> {
        self.send(Command::Aprd, offset, &vec![0; length_bytes]).data
    }

    fn set_sync_manager(&mut self, number: u16, start: u16, length_bytes: u16, control: u8) {
        let ([s0, s1], [l0, l1]) = (start.to_le_bytes(), length_bytes.to_le_bytes());
        self.write(0x0800 + 8 * number, &[s0, s1, l0, l1, control, 0, 1, 0]);
    }

    /// Asks for a state; AL status and AL status code as they are then.
    fn request(&mut self, state: u8) -> (u8, u16) {
        self.write(0x0120, &[state, 0]);
        let status = self.read(0x0130, 6);
        (status[0], u16::from_le_bytes([status[4], status[5]]))
    }

    fn into_pre_op(mut self) -> Self {
        let length_bytes = layout::MAILBOX_BYTES;
        self.set_sync_manager(
            0,
            layout::MAILBOX_RECEIVE_START,
            length_bytes,
            layout::MAILBOX_RECEIVE_CONTROL,
        );
        self.set_sync_manager(1, layout::MAILBOX_SEND_START, length_bytes, layout::MAILBOX_SEND_CONTROL);
        assert_eq!(self.request(PRE_OP), (PRE_OP, 0));
        self
    }

    fn set_process_data(&mut self, outputs_bytes: u16, inputs_bytes: u16) {
        self.set_sync_manager(2, layout::OUTPUTS_START, outputs_bytes, layout::OUTPUTS_CONTROL);
        self.set_sync_manager(3, layout::INPUTS_START, inputs_bytes, layout::INPUTS_CONTROL);
    }

    fn into_op(mut self, outputs_bytes: u16, inputs_bytes: u16) -> Self {
        self.set_process_data(outputs_bytes, inputs_bytes);
        assert_eq!(self.request(SAFE_OP), (SAFE_OP, 0));
        assert_eq!(self.request(OP), (OP, 0));
        self
    }

    /// An SDO download by complete access; how long the response took.
    fn download_complete(&mut self, index: u16, value: &[u8]) -> Duration {
        self.counter = self.counter % 7 + 1;
        let [i0, i1] = index.to_le_bytes();
        let mut message =
            vec![10 + value.len() as u8, 0, 0, 0, 0, self.counter << 4 | 3, 0, 0x20, 0x31, i0, i1, 0];
        message.extend((value.len() as u32).to_le_bytes());
        message.extend(value);
        message.resize(usize::from(layout::MAILBOX_BYTES), 0);
        self.write(layout::MAILBOX_RECEIVE_START, &message);
        let sent = self.now;
        while self.read(0x080D, 1)[0] & 0x08 == 0 {
            assert!(self.now.saturating_since(sent) < Duration::from_millis(100), "no response");
        }
        let response = self.read(layout::MAILBOX_SEND_START, usize::from(layout::MAILBOX_BYTES));
        assert_eq!(response[8] & 0xE0, 0x60, "download response to {index:#06X}: {:02X?}", &response[8..16]);
        self.now.saturating_since(sent)
    }

    /// Sends outputs long enough for them to come back; the inputs then.
    fn exchange(&mut self, outputs: &[u8], inputs_bytes: usize) -> Vec<u8> {
        for _ in 0..100 {
            self.write(layout::OUTPUTS_START, outputs);
        }
        self.read(layout::INPUTS_START, inputs_bytes)
    }
}

/// The octets of a PDO mapping object with its entries 1 to `count`.
fn mapping(base: u32, count: u8) -> Vec<u8> {
    let entries = (1..=u32::from(count)).flat_map(|sub| (base | sub << 8).to_le_bytes());
    [count, 0].into_iter().chain(entries).collect()
}

fn counting(length_bytes: usize) -> Vec<u8> {
    (0..length_bytes).map(|at| at as u8).collect()
}

#[test]
fn the_factory_setting_goes_to_op_and_echoes() {
    let mut bench = Bench::power_on(IoAllocation::factory()).into_pre_op().into_op(180, 183);
    let inputs = bench.exchange(&counting(180), 183);
    assert_eq!(inputs, [&[0x17, 0x00][..], &counting(180), &[0]].concat());
}

#[test]
fn the_largest_mapping_goes_to_op_and_echoes() {
    let mut allocation = IoAllocation::empty();
    allocation.select(Direction::MToC, DataSetKind::Uints, 40);
    allocation.select(Direction::CToM, DataSetKind::Uints, 40);
    let mut bench = Bench::power_on(allocation).into_pre_op();
    bench.download_complete(0x1601, &mapping(0x7000_00F0, 40));
    bench.download_complete(0x1A01, &mapping(0x6000_00F0, 40));
    bench.download_complete(0x1C13, &[4, 0, 0x00, 0x1A, 0x01, 0x1A, 0xFE, 0x1B, 0xFF, 0x1B]);
    let mut bench = bench.into_op(1200, 1204);
    let inputs = bench.exchange(&counting(1200), 1204);
    assert_eq!(inputs, [&[0x17, 0x00][..], &counting(1200), &[0, 0]].concat());
}

#[test]
fn lengths_that_do_not_fit_the_mapping_are_refused() {
    for (outputs_bytes, inputs_bytes, code) in [(181, 183, 0x001D), (180, 182, 0x001E)] {
        let mut bench = Bench::power_on(IoAllocation::factory()).into_pre_op();
        bench.set_process_data(outputs_bytes, inputs_bytes);
        assert_eq!(bench.request(SAFE_OP), (PRE_OP | 0x10, code));
    }
}

#[test]
fn a_mapping_without_the_unit_status_is_refused() {
    let mut bench = Bench::power_on(IoAllocation::factory()).into_pre_op();
    bench.download_complete(0x1C13, &[1, 0, 0x01, 0x1A]);
    bench.set_process_data(180, 180);
    assert_eq!(bench.request(SAFE_OP), (PRE_OP | 0x10, 0x0024));
}

#[test]
fn an_sdo_response_is_complete_after_2_ms() {
    let mut bench = Bench::power_on(IoAllocation::factory()).into_pre_op();
    let took = bench.download_complete(0x1C12, &[1, 0, 0x01, 0x16]);
    assert!(took >= Duration::from_millis(2) && took < Duration::from_micros(2_500), "{took}");
}

#[test]
fn the_id_switch_is_in_the_alias_register_and_in_al_status() {
    let mut bench = Bench::power_on(IoAllocation::factory()).into_pre_op();
    assert_eq!(bench.read(0x0012, 2), [1, 0]);
    assert_eq!(bench.request(PRE_OP | 0x20), (PRE_OP | 0x20, 1));
}
