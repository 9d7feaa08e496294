//! Every device of the ESI files in `units/esi` comes to OP with our master, with the process data that its file says, or
//! says what is missing.

#![expect(clippy::expect_used, reason = "a test ends where something is not as it should be")]

use std::path::PathBuf;
use std::{env, fs};

use device::Network;
use esi::file::{DeviceElement, EsiFile};
use esi_device::{IoImage, NotYet, device_config};
use master::{Connected, Line, Master};
use segment::FrameFate;
use time::{Duration, Instant};
use wire::AlState;

/// One slave with power.
struct Slave(Network<IoImage>);

impl Slave {
    fn image(&mut self) -> &mut IoImage {
        self.0.device_mut(0).expect("the slave").unit_mut()
    }
}

impl Line for Slave {
    fn frame(&mut self, now: Instant, frame: &mut [u8]) -> bool {
        self.0.frame(now, frame) == FrameFate::Returned
    }

    fn poll(&mut self, now: Instant) {
        self.0.poll(now);
    }

    fn deadline(&self) -> Instant {
        self.0.deadline()
    }
}

/// The devices of all files of the folder.
fn devices() -> Vec<DeviceElement> {
    let folder: PathBuf = [env!("CARGO_MANIFEST_DIR"), "..", "..", "units", "esi"].iter().collect();
    let mut files: Vec<PathBuf> =
        fs::read_dir(&folder).expect("the folder").map(|entry| entry.expect("an entry").path()).collect();
    files.sort();
    let external = |name: &str| fs::read(folder.join(name)).ok();
    // It has a dictionary only, for another file.
    files.retain(|path| !path.ends_with("sensor-dictionary.xml"));
    let of = |path: PathBuf| {
        let file = EsiFile::read(&fs::read(&path).expect("a file"), &external);
        let devices = file.expect("an ESI file").devices;
        assert!(!devices.is_empty(), "{}: no device", path.display());
        devices
    };
    files.into_iter().flat_map(of).collect()
}

/// The bits that the PDOs of a direction use, SyncManager by SyncManager, counted from the elements of the file.
fn used_bits(device: &DeviceElement, pdos: &[esi::Pdo]) -> Vec<u8> {
    let bits = |number: u8| -> u32 {
        pdos.iter().filter(|pdo| pdo.sync_manager == Some(number)).map(esi::Pdo::bit_length).sum()
    };
    let bytes = |bits: u32| {
        let rest = (!bits.is_multiple_of(8)).then_some((1_u8 << (bits % 8)) - 1);
        vec![0xFF; bits as usize / 8].into_iter().chain(rest)
    };
    (0..).take(device.sync_managers.len()).map(bits).flat_map(bytes).collect()
}

/// Exchanges a pattern in both directions, and then its complement.
fn exchange(device: &DeviceElement, mut bench: Connected<Slave>) {
    let (code, described) = (&device.device_type.order_code, device.description());
    assert_eq!(bench.search(), Ok(1), "{code}");
    assert_eq!(bench.take_to(0, AlState::Op), Ok(()), "{code}");
    let [outputs, inputs] = [&described.rx_pdos, &described.tx_pdos].map(|pdos| used_bits(device, pdos));
    assert_eq!(bench.line.image().outputs().len(), outputs.len(), "{code}");
    assert_eq!(bench.master.outputs(0).len(), outputs.len(), "{code}");
    assert_eq!(bench.master.inputs(0).len(), inputs.len(), "{code}");
    let of = |used: &[u8], pattern: u8| -> Vec<u8> { used.iter().map(|bits| bits & pattern).collect() };
    for pattern in [0xA5, 0x5A] {
        bench.master.outputs_mut(0).fill(pattern);
        bench.line.image().inputs_mut().fill(pattern);
        bench.run_for(Duration::from_millis(5));
        assert_eq!(bench.line.image().outputs(), of(&outputs, pattern), "{code}");
        assert_eq!(bench.master.inputs(0), of(&inputs, pattern), "{code}");
    }
}

#[test]
fn each_device_without_a_mailbox_exchanges_what_its_file_says() {
    let mut exchanged = 0;
    for device in devices() {
        match device_config(&device) {
            Ok(config) => {
                let image = IoImage::power_on(&config);
                let slave = Slave(Network::power_on([(config, image)], Instant::ZERO));
                exchange(&device, Connected::new(Master::default(), slave, Instant::ZERO));
                exchanged += 1;
            }
            Err(missing) => assert_eq!(missing, NotYet::Mailbox, "{}", device.device_type.order_code),
        }
    }
    assert!(exchanged >= 10, "{exchanged}");
}

#[test]
fn a_device_that_needs_more_says_what_is_missing() {
    let with_slots = devices().into_iter().find(|device| device.slots.is_some()).expect("a modular device");
    let refused =
        |device: &DeviceElement| device_config(device).map(|_| ()).expect_err("refused").to_string();
    assert_eq!(refused(&with_slots), "the device has a mailbox, which is not emulated yet");
    let without_mailbox = DeviceElement { mailbox: None, ..with_slots };
    assert_eq!(refused(&without_mailbox), "the device has slots for modules, which are not emulated yet");
    let with_pdos = devices().into_iter().find(|device| device.tx_pdos.len() == 2).expect("two inputs");
    let mut exclusive = DeviceElement { mailbox: None, slots: None, ..with_pdos };
    exclusive.tx_pdos[0].excludes = vec![exclusive.tx_pdos[1].index];
    assert_eq!(
        refused(&exclusive),
        "PDO 1A00 excludes another PDO that has a SyncManager too: a choice between PDOs is not emulated yet"
    );
}
