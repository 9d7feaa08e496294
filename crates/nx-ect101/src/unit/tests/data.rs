//! Status bits, messages, ID and memory of the unit.

use wire::SdoAbort;

use super::*;
use crate::memory::{MemoryAtPowerOn, NonVolatileMemory};
use nx_bus::{NxMessageError, NxRequest, NxValue};
use unit_model::keys::SlaveKeys;

impl Bench {
    fn sdo_read(&mut self, index: u16, sub: u8) -> Vec<u8> {
        let size_bytes = match index {
            0x3000 | 0x3001 => 200,
            0x1018 => 4,
            0x1009 | 0x100A => 20,
            0x6000 | 0x7000 => 30,
            _ => 2,
        };
        let mut value = vec![0; size_bytes];
        let objects = self.unit.objects().expect("a unit with a mailbox");
        objects.read(ObjectIndex(index), SubIndex(sub), &mut value).expect("readable");
        value
    }

    fn sdo_write(&mut self, index: u16, sub: u8, value: &[u8]) -> Result<(), SdoAbort> {
        let objects = self.unit.objects().expect("a unit with a mailbox");
        objects.write(ObjectIndex(index), SubIndex(sub), value)
    }

    /// A request of the CPU Unit for one object; the answer arrives with a refresh.
    fn nx(&mut self, index: u16, value: Option<&[u8]>) -> Result<Vec<u8>, NxMessageError> {
        self.nx_entry(index, 1, value)
    }

    fn nx_entry(&mut self, index: u16, sub: u8, value: Option<&[u8]>) -> Result<Vec<u8>, NxMessageError> {
        let value = value.map(|value| value.iter().copied().collect::<NxValue>());
        let request = NxRequest { number: 1, index: ObjectIndex(index), sub: SubIndex(sub), value };
        self.cpu.messages.send(request).expect("room");
        assert_eq!(self.cpu.messages.receive(), Ok(None), "not before the refresh");
        self.refresh(AlState::SafeOp, None);
        let response = self.cpu.messages.receive().expect("under power").expect("answered");
        response.result.map(|value| value.to_vec())
    }

    /// Whether a status has changed that the master must see immediately.
    fn wants_refresh(&mut self) -> bool {
        core::iter::from_fn(|| self.unit.take_action()).any(|action| action == Action::Refresh)
    }

    /// The message flags: NX 6003:01 bits 8 and 9, CoE 6003:04 and :05.
    fn message_flags(&mut self) -> [bool; 4] {
        self.refresh(AlState::SafeOp, None);
        let status = self.cpu.m_to_c.newest().header.status;
        let inputs = self.inputs[0];
        [status & 0x0100 != 0, status & 0x0200 != 0, inputs & 0x08 != 0, inputs & 0x10 != 0]
    }
}

const IDLE: [bool; 4] = [false, true, false, true];

#[test]
fn the_links_are_told_to_the_cpu_unit() {
    let mut bench = Bench::factory();
    let mut status = |in_port, out_port| {
        bench.links = PortLinks { in_port, out_port };
        bench.refresh(AlState::Init, None);
        bench.cpu.m_to_c.newest().header.status
    };
    assert_eq!(status(true, false), 0x0240);
    assert_eq!(status(false, true), 0x0280);
    assert_eq!(status(true, true), 0x02C0);
    assert_eq!(status(false, false), 0x0200);
}

#[test]
fn the_master_is_told_whether_the_cpu_unit_does_messages() {
    let mut bench = Bench::factory();
    bench.enter_safe_op();
    for (messages_enabled, bit) in [(false, 0), (true, 1)] {
        bench.cpu.c_to_m.publish(CpuHeader { messages_enabled, ..REFRESHING }, &[0; 180]);
        bench.refresh(AlState::SafeOp, None);
        assert_eq!(bench.inputs[0] & 1, bit);
    }
}

#[test]
fn a_message_goes_from_master_to_cpu_unit_by_its_handshake() {
    let mut bench = Bench::factory();
    bench.enter_safe_op();
    assert_eq!(bench.message_flags(), IDLE);
    assert_eq!(bench.sdo_write(0x3001, 1, &[1; 200]), Ok(()));
    assert!(bench.wants_refresh() && !bench.wants_refresh());
    assert_eq!(bench.message_flags(), [true, true, false, false]);
    assert_eq!(bench.sdo_write(0x3001, 1, &[2; 200]), Err(SdoAbort::LOCAL_CONTROL));
    assert!(!bench.wants_refresh());
    assert_eq!(bench.sdo_read(0x3001, 1), [1; 200], "the master sees what it wrote");
    assert_eq!(bench.nx(0x5000, None), Ok(vec![1; 200]));
    assert_eq!(bench.message_flags(), IDLE);
}

#[test]
fn a_message_goes_from_cpu_unit_to_master_by_its_handshake() {
    let mut bench = Bench::factory();
    bench.enter_safe_op();
    assert_eq!(bench.nx(0x5001, Some(&[3; 200])), Ok(vec![]));
    assert_eq!(bench.message_flags(), [false, false, true, true]);
    assert_eq!(bench.nx(0x5001, Some(&[4; 200])), Err(NxMessageError::NotReady));
    assert_eq!(bench.nx(0x5001, None), Ok(vec![3; 200]), "the CPU Unit sees what it wrote");
    assert_eq!(bench.sdo_read(0x3000, 1), [3; 200]);
    assert!(bench.wants_refresh());
    assert_eq!(bench.message_flags(), IDLE);
    assert_eq!(bench.sdo_read(0x3000, 1), [3; 200], "the last message stays to be read");
    assert!(!bench.wants_refresh());
}

#[test]
fn both_directions_are_apart() {
    let mut bench = Bench::factory();
    bench.enter_safe_op();
    bench.sdo_write(0x3001, 1, &[5; 200]).expect("ready");
    bench.nx(0x5001, Some(&[6; 200])).expect("ready");
    assert_eq!(bench.message_flags(), [true, false, true, false]);
    assert_eq!(bench.sdo_read(0x3000, 1), [6; 200]);
    assert_eq!(bench.message_flags(), [true, true, false, false]);
    assert_eq!(bench.nx(0x5000, None), Ok(vec![5; 200]));
    assert_eq!(bench.message_flags(), IDLE);
}

#[test]
fn no_flag_is_older_than_the_response_that_goes_with_it() {
    let mut bench = Bench::factory();
    bench.enter_safe_op();
    bench.sdo_write(0x3001, 1, &[1; 200]).expect("ready");
    bench.nx(0x5000, None).expect("a message");
    let status = bench.cpu.m_to_c.newest().header.status;
    assert_eq!(status & 0x0100, 0, "in the refresh that has answered");
    assert_eq!(bench.inputs[0] & 0x10, 0x10, "and so for the master");
}

#[test]
fn what_is_set_in_pre_op_counts_from_the_next_safe_op_on() {
    let mut bench = Bench::factory();
    bench.enter_safe_op();
    bench.refresh(AlState::Op, Some(&[7; 180]));
    bench.unit.entered(NOW, AlState::PreOp);
    set(&mut bench.unit.objects.mapping, 0x1601, &[0x7000_01F0, 0x7000_02F0]).expect("mappable");
    let (cause, links) = (RefreshCause::Period, bench.links);
    let exchange = Exchange { cause, state: AlState::PreOp, links, outputs: None, inputs: &mut [] };
    bench.unit.refresh(NOW, exchange);
    assert_eq!(bench.cpu.m_to_c.newest().bytes(), [7; 180], "not before");
    bench.enter_safe_op();
    bench.refresh(AlState::SafeOp, None);
    assert_eq!(bench.cpu.m_to_c.newest().bytes(), [0; 180]);
    bench.refresh(AlState::Op, Some(&[8; 60]));
    assert_eq!(bench.cpu.m_to_c.newest().bytes(), [[8; 60].as_slice(), &[0; 120]].concat());
}

/// A unit whose ID is set by software, with its EEPROM.
fn without_switch() -> (Bench, Vec<u8>) {
    let bench = Bench::power_on(&UnitSettings { id_switch: 0, ..UnitSettings::default() });
    let image = bench.unit.memory().sii_image().to_vec();
    (bench, image)
}

#[test]
fn a_software_id_is_in_force_at_once_in_the_register_and_after_a_restart_as_the_id() {
    let (mut bench, mut image) = without_switch();
    assert_eq!((bench.unit.explicit_device_id(), alias(&bench.unit)), (None, None));
    bench.sdo_write(0x10E0, 1, &500_u16.to_le_bytes()).expect("the switch is at 0x00");
    assert_eq!((bench.unit.explicit_device_id(), alias(&bench.unit)), (None, Some(500)));
    assert_eq!(image[8..10], [0, 0]);
    bench.unit.restart(NOW, Start::Restart, &mut image);
    assert_eq!((bench.unit.explicit_device_id(), alias(&bench.unit)), (Some(500), Some(500)));
    assert_eq!(image[8..10], 500_u16.to_le_bytes());
    assert!(esi::sii::lint(&image).is_empty());
}

#[test]
fn a_station_alias_in_the_sii_is_a_software_id_from_the_next_restart_on() {
    let (mut bench, mut image) = without_switch();
    let foreign = UnitSettings { id_switch: 0, software_id: 0x0777, ..UnitSettings::default() };
    image.copy_from_slice(NonVolatileMemory::factory(&foreign).sii_image());
    bench.unit.restart(NOW, Start::Restart, &mut image);
    assert_eq!(bench.unit.explicit_device_id(), Some(0x0777));
    assert_eq!(bench.sdo_read(0x10E0, 1), 0x0777_u16.to_le_bytes());
}

#[test]
fn the_switch_is_looked_at_when_the_unit_starts() {
    let mut bench = Bench::factory();
    let mut image = bench.unit.memory().sii_image().to_vec();
    bench.unit.set_id_switch(0x2A);
    assert_eq!((bench.unit.explicit_device_id(), bench.sdo_read(0x10E0, 3)), (Some(1), vec![1, 0]));
    bench.unit.restart(NOW, Start::Restart, &mut image);
    assert_eq!((bench.unit.explicit_device_id(), bench.sdo_read(0x10E0, 3)), (Some(0x2A), vec![0x2A, 0]));
    assert_eq!(image[8..10], [0x2A, 0]);
}

#[test]
fn a_restart_forgets_messages_and_the_mapping() {
    let mut bench = Bench::factory();
    bench.sdo_write(0x3001, 1, &[1; 200]).expect("ready");
    set(&mut bench.unit.objects.mapping, 0x1601, &[0x7000_01F0]).expect("mappable");
    let mut image = bench.unit.memory().sii_image().to_vec();
    bench.unit.restart(NOW, Start::Restart, &mut image);
    assert_eq!(bench.unit.mapped_bytes(SmIndex::OUTPUTS), 180);
    bench.enter_safe_op();
    assert_eq!(bench.message_flags(), IDLE);
}

#[test]
fn what_a_unit_stores_it_finds_again() {
    let (mut bench, image) = without_switch();
    assert!(bench.unit.take_memory_change(&image, 0), "the first time");
    assert!(!bench.unit.take_memory_change(&image, 0));
    bench.sdo_write(0x10E0, 1, &500_u16.to_le_bytes()).expect("the switch is at 0x00");
    assert!(bench.unit.take_memory_change(&image, 0));
    let mut written = image.clone();
    written[1000] ^= 0xFF;
    assert!(bench.unit.take_memory_change(&written, 1));
    assert!(!bench.unit.take_memory_change(&written, 1));

    let mut bytes = Vec::new();
    bench.unit.memory().encode_into(&mut bytes);
    let stored = Box::new(NonVolatileMemory::decode(&bytes).expect("whole"));
    let settings = UnitSettings { id_switch: 0, ..UnitSettings::default() };
    let (unit, _cpu) = NxEct101::power_on_with(&settings, MemoryAtPowerOn::Stored(stored));
    assert_eq!(unit.explicit_device_id(), Some(500));
    assert_eq!(unit.memory().sii_image()[8..10], 500_u16.to_le_bytes());
    assert_eq!(unit.memory().sii_image()[1000], written[1000]);
}

/// A blank EEPROM is a condition of a test, after which the SII of the memory is there again.
#[test]
fn what_is_written_to_a_blank_sii_is_not_stored() {
    let (bench, image) = without_switch();
    let mut bytes = Vec::new();
    bench.unit.memory().encode_into(&mut bytes);
    let stored = MemoryAtPowerOn::Stored(Box::new(NonVolatileMemory::decode(&bytes).expect("whole")));
    let slave = SlaveKeys { is_sii_blank: true, ..SlaveKeys::default() };
    let settings = UnitSettings { id_switch: 0, slave, ..UnitSettings::default() };
    let (unit, cpu) = NxEct101::power_on_with(&settings, stored);
    let mut bench = Bench { unit, cpu, inputs: Vec::new(), links: PortLinks::default() };

    let mut blank = vec![0xFF; image.len()];
    blank[0x0120..0x0122].copy_from_slice(&0xBEEF_u16.to_le_bytes());
    assert!(!bench.unit.take_memory_change(&blank, 1), "a word that the master has written is not stored");
    bench.sdo_write(0x10E0, 1, &500_u16.to_le_bytes()).expect("the switch is at 0x00");
    assert!(bench.unit.take_memory_change(&blank, 1), "the ID is stored as ever");
    let written = blank.clone();
    bench.unit.restart(NOW, Start::Restart, &mut blank);
    assert_eq!(blank, written, "a restart does not fill the EEPROM");
    assert_eq!(bench.unit.explicit_device_id(), Some(500));
    assert_eq!(bench.unit.memory().sii_image()[8..10], 500_u16.to_le_bytes());
    assert_eq!(bench.unit.memory().sii_image()[16..], image[16..]);
}

#[test]
fn the_serial_number_of_the_object_is_that_of_the_memory() {
    let mut bench = Bench::power_on(&UnitSettings { serial: 0xA1B2, ..UnitSettings::default() });
    assert_eq!(bench.sdo_read(0x1018, 4), 0xA1B2_u32.to_le_bytes());
    assert_eq!(bench.unit.memory().serial(), 0xA1B2);
}

#[test]
fn versions_lot_and_type_are_those_of_the_unit_file() {
    let text = "model = \"nx-ect101\"\ndevice_type = 0x20001\nunit_version = \"1.2\"\nlot_number = 0x1D0B1A00\n\
        hardware_version = \"V1.10\"\nsoftware_version = \"V1.02 V2.00\"";
    let file = UnitFile::parse(text).expect("a unit file");
    let mut bench = Bench::power_on(&UnitSettings::from_unit_file(&file));
    let mut image = bench.unit.memory().sii_image().to_vec();
    let (hardware, software) = (*b"V1.10               ", *b"V1.02 V2.00         ");
    for _ in 0..2 {
        let mut nx = |index, sub| bench.nx_entry(index, sub, None).expect("readable");
        assert_eq!(nx(0x1000, 3), 0x0002_0001_u32.to_le_bytes());
        assert_eq!(nx(0x1000, 6), 0x0102_0000_u32.to_le_bytes());
        assert_eq!(nx(0x1001, 1), 0x1D0B_1A00_u32.to_le_bytes());
        assert_eq!((nx(0x1001, 2), nx(0x1001, 3)), (hardware.to_vec(), software.to_vec()));
        assert_eq!(bench.sdo_read(0x1009, 0), hardware);
        assert_eq!(bench.sdo_read(0x100A, 0), software);
        bench.unit.restart(NOW, Start::Restart, &mut image);
        // The unit takes part in the NX bus again.
        bench.refresh(AlState::Init, None);
    }
}

#[test]
fn a_damaged_memory_is_a_fault_that_stores_nothing() {
    let (unit, cpu) = NxEct101::power_on_with(&UnitSettings::default(), MemoryAtPowerOn::Damaged);
    let mut bench = Bench { unit, cpu, inputs: Vec::new(), links: PortLinks::default() };
    assert_eq!(bench.unit.stop_in_init().map(|code| code.0), Some(0x0002));
    assert_eq!(bench.unit.faults().collect::<Vec<_>>(), [Fault::NonVolatileMemory]);
    bench.cpu.c_to_m.publish(REFRESHING, &[0; 180]);
    bench.refresh(AlState::Init, None);
    let header = bench.cpu.m_to_c.newest().header;
    assert_eq!((header.io_data_active, header.error), (false, true));
    let image = bench.unit.memory().sii_image().to_vec();
    assert!(!bench.unit.take_memory_change(&image, 7));
}

#[test]
fn messages_that_find_no_room_are_an_event_when_they_are_dropped() {
    let mut bench = Bench::factory();
    bench.cpu.c_to_m.publish(REFRESHING, &[0; 180]);
    let request = |number| NxRequest { number, index: ObjectIndex(0x1000), sub: SubIndex(2), value: None };
    let refused = (0..10).filter(|&number| bench.cpu.messages.send(request(number)).is_err()).count();
    bench.refresh(AlState::Init, None);
    assert_eq!(refused, 2);
    assert_eq!(bench.unit.error_log().history().count(), 0, "they can be sent later");
    (0..refused).for_each(|_| bench.cpu.messages.discard());
    bench.refresh(AlState::Init, None);
    bench.refresh(AlState::Init, None);
    let records: Vec<_> = bench.unit.error_log().history().collect();
    assert_eq!(records.len(), 1, "they came between two refreshes");
    assert_eq!(records[0].event, Event::MESSAGE_COMMUNICATIONS_ERROR);
    assert_eq!(records[0].details.as_slice(), [0, 0], "system information, NX bus");
}

/// Factory mapping of 6 UINT arrays, and a CPU Unit that has allocated 7 in each direction.
fn seven_of_six() -> Bench {
    let mut bench =
        Bench::power_on(&UnitSettings { io_allocation: symmetric([7, 0, 0]), ..UnitSettings::default() });
    bench.cpu.c_to_m.publish(REFRESHING, &[0; 210]);
    bench.enter_safe_op();
    bench
}

#[test]
fn an_entry_that_no_pdo_carries_goes_to_the_cpu_unit_by_sdo() {
    let mut bench = seven_of_six();
    assert_eq!(bench.sdo_write(0x7000, 7, &[0xA7; 30]), Ok(()));
    assert_eq!(bench.sdo_write(0x7000, 8, &[0xA8; 30]), Ok(()), "the CPU Unit has no such entry");
    bench.refresh(AlState::Op, Some(&[0x11; 180]));
    let expected = [&[0x11; 180][..], &[0xA7; 30]].concat();
    assert_eq!(bench.cpu.m_to_c.newest().bytes(), expected);
    assert_eq!((bench.sdo_read(0x7000, 7), bench.sdo_read(0x7000, 8)), (vec![0xA7; 30], vec![0xA8; 30]));
    bench.refresh(AlState::SafeOp, None);
    assert_eq!(bench.cpu.m_to_c.newest().bytes(), expected, "as outputs do, it stays");
}

#[test]
fn an_entry_that_no_pdo_carries_comes_from_the_cpu_unit_by_sdo() {
    let mut bench = seven_of_six();
    let image: Vec<u8> = (0..210).collect();
    bench.cpu.c_to_m.publish(REFRESHING, &image);
    bench.refresh(AlState::SafeOp, None);
    bench.refresh(AlState::SafeOp, None);
    assert_eq!(bench.sdo_read(0x6000, 7), image[180..]);
    assert_eq!(bench.sdo_read(0x6000, 8), [0; 30]);
    bench.cpu.c_to_m.publish(CpuHeader { io_stopped: true, ..REFRESHING }, &image);
    bench.refresh(AlState::SafeOp, None);
    assert_eq!(bench.sdo_read(0x6000, 7), [0; 30], "as inputs, without I/O refreshing it is 0");
}

#[test]
fn without_io_refreshing_nothing_reaches_the_cpu_unit_by_sdo_either() {
    let mut bench = seven_of_six();
    bench.cpu.c_to_m.publish(CpuHeader { io_stopped: true, ..REFRESHING }, &[0; 210]);
    bench.sdo_write(0x7000, 7, &[1; 30]).expect("not mapped");
    bench.refresh(AlState::Op, Some(&[2; 180]));
    assert_eq!(bench.cpu.m_to_c.newest().bytes(), [0; 210]);
}

#[test]
fn the_next_safe_op_gives_entries_their_defaults_and_follows_the_mapping() {
    let mut bench = seven_of_six();
    bench.sdo_write(0x7000, 7, &[1; 30]).expect("not mapped");
    bench.refresh(AlState::Op, Some(&[2; 180]));
    bench.unit.entered(NOW, AlState::PreOp);
    let elements: Vec<u32> = (1..=7).map(|sub| 0x7000_00F0 | sub << 8).collect();
    set(&mut bench.unit.objects.mapping, 0x1601, &elements).expect("mappable");
    bench.enter_safe_op();
    bench.refresh(AlState::Op, Some(&[3; 210]));
    assert_eq!(bench.cpu.m_to_c.newest().bytes(), [3; 210]);
    assert_eq!(bench.sdo_write(0x7000, 7, &[4; 30]), Err(SdoAbort::LOCAL_CONTROL));
    assert_eq!(bench.sdo_read(0x7000, 8), [0; 30]);
}
