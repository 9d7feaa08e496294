//! The unit between a master's SyncManagers and a CPU Unit's NX bus, without either.

use device::{PortLinks, RefreshCause};
use unit_model::keys::Timing;
use wire::{ObjectIndex, SubIndex};

use super::*;
use crate::allocation::tests::symmetric;
use crate::allocation::{IoAllocation, IoEntry};
use crate::data_sets::DataSetKind;
use crate::events::{EventCode, EventLevel};
use crate::pdo_settings::tests::set;
use crate::settings::{EventLevels, NewestAcknowledged};
use crate::timing::start_up;
use crate::unit_file::UnitFile;
use crate::unit_information::UnitInformation;

const NOW: Instant = Instant::ZERO;
const REFRESHING: CpuHeader = CpuHeader {
    refreshing: true,
    messages_enabled: true,
    io_stopped: false,
    error_resets: 0,
    task_periods: 0,
    task_period: Duration::ZERO,
    system_time_ns: 1_700_000_000_000_000_000,
};

struct Bench {
    unit: NxEct101,
    cpu: CpuEnd,
    inputs: Vec<u8>,
    links: PortLinks,
}

impl Bench {
    fn power_on(settings: &UnitSettings) -> Self {
        let (unit, cpu) = NxEct101::power_on(settings);
        Self { unit, cpu, inputs: Vec::new(), links: PortLinks::default() }
    }

    fn factory() -> Self {
        Self::power_on(&UnitSettings::default())
    }

    fn enter_safe_op(&mut self) {
        self.unit.check_transition(NOW, Check::ProcessData, &[]).expect("the mapping is right");
        self.unit.entered(NOW, AlState::SafeOp);
        self.inputs = vec![0xEE; usize::from(self.unit.mapped_bytes(SmIndex::INPUTS))];
    }

    fn refresh(&mut self, state: AlState, outputs: Option<&[u8]>) {
        let (cause, inputs) = (RefreshCause::Period, &mut self.inputs);
        self.unit.refresh(NOW, Exchange { cause, state, links: self.links, outputs, inputs });
    }
}

/// The station alias that the unit requests.
fn alias(unit: &NxEct101) -> Option<u16> {
    unit.objects.identification.station_alias()
}

#[test]
fn data_goes_both_ways_in_op() {
    let mut bench = Bench::factory();
    bench.enter_safe_op();
    let outputs: Vec<u8> = (0..180).collect();
    bench.cpu.c_to_m.publish(REFRESHING, &[0xA5; 180]);
    bench.refresh(AlState::Op, Some(&outputs));
    bench.refresh(AlState::Op, Some(&outputs));
    let image = bench.cpu.m_to_c.newest();
    assert_eq!(image.bytes(), outputs);
    assert_eq!((image.header.status, image.header.io_data_active), (0x0207, true));
    let expected = [&[0x17, 0x00][..], &[0xA5; 180], &[0x00]].concat();
    assert_eq!(bench.inputs, expected);
}

#[test]
fn the_valid_flags_follow_state_outputs_and_refreshing() {
    let mut bench = Bench::factory();
    bench.enter_safe_op();
    let mut status = |refreshing, state, outputs: Option<&[u8]>| {
        bench.cpu.c_to_m.publish(CpuHeader { refreshing, ..REFRESHING }, &[0; 180]);
        bench.refresh(state, outputs);
        (bench.unit.slave_status().bits(), bench.inputs[0])
    };
    assert_eq!(status(true, AlState::SafeOp, None), (0x0205, 0x13));
    assert_eq!(status(true, AlState::Op, None), (0x0205, 0x13));
    assert_eq!(status(true, AlState::Op, Some(&[0; 180])), (0x0207, 0x17));
    assert_eq!(status(false, AlState::Op, Some(&[0; 180])), (0x0201, 0x11));
}

#[test]
fn below_safe_op_only_sdo_communications_are_told() {
    let mut bench = Bench::factory();
    for (state, bits) in [(AlState::Init, 0x0200), (AlState::PreOp, 0x0201), (AlState::Boot, 0x0200)] {
        bench.cpu.c_to_m.publish(REFRESHING, &[0; 180]);
        bench.refresh(state, None);
        assert_eq!(bench.cpu.m_to_c.newest().header.status, bits, "{state}");
    }
}

#[test]
fn the_last_outputs_stay_when_they_stop() {
    let mut bench = Bench::factory();
    bench.enter_safe_op();
    bench.refresh(AlState::Op, Some(&[7; 180]));
    bench.refresh(AlState::SafeOp, None);
    bench.refresh(AlState::SafeOp, None);
    let image = bench.cpu.m_to_c.newest();
    assert_eq!(image.bytes(), [7; 180]);
    assert_eq!(image.header.status & 0b010, 0, "the data M to C is not valid");
}

#[test]
fn what_only_one_side_has_stays_0() {
    let io_allocation = symmetric([2, 1, 0]);
    let mut bench = Bench::power_on(&UnitSettings { io_allocation, ..UnitSettings::default() });
    bench.enter_safe_op();
    bench.cpu.c_to_m.publish(REFRESHING, &[9; 70]);
    bench.refresh(AlState::Op, Some(&[5; 180]));
    bench.refresh(AlState::Op, Some(&[5; 180]));
    assert_eq!(
        bench.cpu.m_to_c.newest().bytes(),
        [[5; 10]; 6].concat().into_iter().chain([0; 10]).collect::<Vec<_>>()
    );
    assert!(bench.inputs[2..62].iter().all(|&byte| byte == 9));
    assert!(bench.inputs[62..182].iter().all(|&byte| byte == 0));
    assert_eq!(bench.inputs[182], 1, "the mismatch is a new message");
}

#[test]
fn a_mapping_without_the_unit_status_is_refused() {
    let mut bench = Bench::factory();
    set(&mut bench.unit.objects.mapping, 0x1C13, &[0x1A01]).expect("assignable");
    assert_eq!(
        bench.unit.check_transition(NOW, Check::ProcessData, &[]),
        Err(AlStatusCode::INVALID_INPUT_MAPPING)
    );
}

#[test]
fn a_mapping_beyond_the_limits_is_refused() {
    let forty = |base: u32| (1..=40).map(|sub| base | sub << 8).collect::<Vec<_>>();
    let mut outputs = Bench::factory();
    set(&mut outputs.unit.objects.mapping, 0x1601, &forty(0x7000_00F0)).expect("1,200 bytes");
    assert_eq!(outputs.unit.check_transition(NOW, Check::ProcessData, &[]), Ok(()));
    set(&mut outputs.unit.objects.mapping, 0x1C12, &[0x1601, 0x1603]).expect("assignable");
    assert_eq!(
        outputs.unit.check_transition(NOW, Check::ProcessData, &[]),
        Err(AlStatusCode::INVALID_OUTPUT_MAPPING)
    );

    let mut inputs = Bench::factory();
    set(&mut inputs.unit.objects.mapping, 0x1A01, &forty(0x6000_00F0)).expect("1,200 bytes");
    set(&mut inputs.unit.objects.mapping, 0x1C13, &[0x1A00, 0x1A01, 0x1BFE, 0x1BFF]).expect("1,204 bytes");
    assert_eq!(inputs.unit.check_transition(NOW, Check::ProcessData, &[]), Ok(()));
    set(&mut inputs.unit.objects.mapping, 0x1C13, &[0x1A00, 0x1A01, 0x1A02, 0x1BFE]).expect("assignable");
    assert_eq!(
        inputs.unit.check_transition(NOW, Check::ProcessData, &[]),
        Err(AlStatusCode::INVALID_INPUT_MAPPING)
    );
}

#[test]
fn a_unit_starts_with_180_and_183_bytes_every_millisecond() {
    let (unit, _cpu) = NxEct101::power_on(&UnitSettings::default());
    assert_eq!([SmIndex::OUTPUTS, SmIndex::INPUTS].map(|index| unit.mapped_bytes(index)), [180, 183]);
    assert_eq!(unit.refresh_period(), Some(Duration::from_millis(1)));
    assert_eq!((unit.explicit_device_id(), alias(&unit)), (Some(1), Some(1)));
}

#[test]
fn a_unit_file_sets_up_a_unit() {
    let text = "model = \"nx-ect101\"\nserial = 77\nid_switch = 0x21\ntiming = \"fast\"\n\
                [io_allocation.m_to_c]\nudint = 3\n[event_levels]\n39170000 = \"observation\"\n";
    let file = UnitFile::parse(text).expect("a right file");
    let mut io_allocation = IoAllocation::empty();
    io_allocation.select(Direction::MToC, DataSetKind::Udint, 3);
    let mut event_levels = EventLevels::default();
    event_levels.set(EventCode(0x3917_0000), EventLevel::Observation).expect("changeable");
    let expected = UnitSettings {
        serial: 77,
        id_switch: 0x21,
        software_id: 0,
        information: UnitInformation::default(),
        timing: Timing::Fast,
        start_up: start_up(Timing::Fast, None),
        refresh_phase: Duration::ZERO,
        io_allocation,
        event_levels,
        newest_acknowledged: NewestAcknowledged::NewestRecord,
        ..UnitSettings::default()
    };
    assert_eq!(UnitSettings::from_unit_file(&file), expected);
    let least = UnitFile::parse("model = \"nx-ect101\"").expect("a right file");
    assert_eq!(UnitSettings::from_unit_file(&least), UnitSettings::default());
}

#[test]
fn the_timestamp_is_the_system_time_of_the_cpu_unit() {
    let mut bench = Bench::factory();
    bench.cpu.c_to_m.publish(REFRESHING, &[0; 180]);
    bench.refresh(AlState::PreOp, None);
    let mut value = [0; 8];
    let objects = bench.unit.objects().expect("a unit with a mailbox");
    objects.read(ObjectIndex(0x10F8), SubIndex::ZERO, &mut value).expect("readable");
    assert_eq!(u64::from_le_bytes(value), REFRESHING.system_time_ns);
}

/// The AL status code and the event codes that result from a mapping.
fn asking_for_safe_op(bench: &mut Bench) -> (Option<AlStatusCode>, Vec<String>) {
    let code = bench.unit.check_transition(NOW, Check::ProcessData, &[]).err();
    (code, bench.unit.findings().map(|finding| finding.event.to_string()).collect())
}

#[test]
fn every_finding_in_the_mapping_is_kept_and_the_first_tells_the_master() {
    let mut bench = Bench::factory();
    set(&mut bench.unit.objects.mapping, 0x1601, &[0x7000_02F0, 0x7001_0150]).expect("mappable");
    set(&mut bench.unit.objects.mapping, 0x1C13, &[0x1A01, 0x1A00]).expect("assignable");
    let events = ["392F0000", "391E0000", "39140000"].map(str::to_owned).to_vec();
    assert_eq!(asking_for_safe_op(&mut bench), (Some(AlStatusCode::INVALID_INPUT_MAPPING), events));
    set(&mut bench.unit.objects.mapping, 0x1601, &[0x7000_01F0]).expect("mappable");
    set(&mut bench.unit.objects.mapping, 0x1C13, &[0x1A00, 0x1A01]).expect("assignable");
    let mismatch = vec!["39170000".to_owned()];
    assert_eq!(asking_for_safe_op(&mut bench), (None, mismatch), "a mismatch stops nothing");
}

#[test]
fn a_wrong_io_allocation_keeps_io_from_being_refreshed_and_ethercat_goes_on() {
    let mut io_allocation = IoAllocation::factory();
    let second = IoEntry { index: ObjectIndex(0x6000), sub: SubIndex(2) };
    io_allocation.allocate(Direction::MToC, DataSetKind::Uints, vec![second]);
    let mut bench = Bench::power_on(&UnitSettings { io_allocation, ..UnitSettings::default() });
    assert_eq!(asking_for_safe_op(&mut bench), (None, vec!["39190000".to_owned()]));
    bench.enter_safe_op();
    bench.cpu.c_to_m.publish(REFRESHING, &[9; 180]);
    bench.refresh(AlState::Op, Some(&[5; 180]));
    let image = bench.cpu.m_to_c.newest();
    assert_eq!(image.bytes(), [0; 30]);
    assert_eq!((image.header.io_data_active, image.header.error), (false, true));
    assert_eq!(image.header.status & 0b110, 0, "the data of neither direction is valid");
    assert!(bench.inputs[2..182].iter().all(|&byte| byte == 0));
    assert_eq!(bench.inputs[182], 1, "the wrong allocation is a new message");
}

mod data;
