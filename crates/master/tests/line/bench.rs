//! Slaves in the same process: NX-ECT101, and terminals of some bits without a mailbox.

use device::{
    Buffers, DataDirection, DataLength, DeviceConfig, Exchange, Network, OutputsBeforeOp, ProcessDataConfig,
    SmIndex, StartUp, Unit,
};
use esi::{DeviceDescription, FmmuUsage, Pdo, PdoEntry, SyncManager, SyncManagerType, Timeouts, Vendor};
use master::{Connected, Line, Master};
use nx_ect101::{NxEct101, UnitSettings, device_config};
use segment::FrameFate;
use time::{Duration, Instant};
use wire::{AlState, DataType, ObjectIndex, SubIndex};

/// Slaves under power, and every frame that the master has sent.
pub(crate) struct Slaves<U> {
    pub(crate) network: Network<U>,
    pub(crate) frames: Vec<Vec<u8>>,
}

impl<U: Unit> Slaves<U> {
    pub(crate) fn power_on(units: impl IntoIterator<Item = (DeviceConfig, U)>) -> Self {
        Self { network: Network::power_on(units, Instant::ZERO), frames: Vec::new() }
    }

    pub(crate) fn state(&self, position: usize) -> AlState {
        self.network.device(position).map_or(AlState::Other(0), |device| device.al_status().state)
    }
}

impl<U: Unit> Line for Slaves<U> {
    fn frame(&mut self, now: Instant, frame: &mut [u8]) -> bool {
        self.frames.push(frame.to_vec());
        self.network.frame(now, frame) == FrameFate::Returned
    }

    fn poll(&mut self, now: Instant) {
        self.network.poll(now);
    }

    fn deadline(&self) -> Instant {
        self.network.deadline()
    }
}

/// A master with this many NX-ECT101 with the factory setting, changed as `change` says.
pub(crate) fn connected_with(
    master: Master,
    count: usize,
    change: impl Fn(usize, &mut DeviceConfig),
) -> Connected<Slaves<NxEct101>> {
    let settings = UnitSettings::default();
    let units = (0..count).map(|position| {
        let (unit, _) = NxEct101::power_on(&settings);
        let mut config = device_config(&settings);
        config.start_up = StartUp::default();
        change(position, &mut config);
        (config, unit)
    });
    Connected::new(master, Slaves::power_on(units), Instant::ZERO)
}

/// A master with this many NX-ECT101.
pub(crate) fn connected(count: usize) -> Connected<Slaves<NxEct101>> {
    connected_with(Master::default(), count, |_, _| {})
}

/// A terminal of up to eight outputs and up to eight inputs, without a mailbox.
#[derive(Debug)]
pub(crate) struct Terminal {
    pub(crate) outputs: u8,
    pub(crate) inputs: u8,
}

const OUTPUTS_START: u16 = 0x1000;
const INPUTS_START: u16 = 0x1100;

impl Unit for Terminal {
    fn refresh_period(&self) -> Option<Duration> {
        Some(Duration::from_millis(1))
    }

    fn refresh(&mut self, _now: Instant, exchange: Exchange<'_>) {
        self.outputs = exchange.outputs.and_then(|outputs| outputs.first().copied()).unwrap_or(0);
        exchange.inputs.fill(self.inputs);
    }
}

/// What a terminal of so many bits says of itself.
pub(crate) fn description(outputs: u8, inputs: u8) -> DeviceDescription {
    let pdo = |index: u16, sync_manager, bits: u8| Pdo {
        index: ObjectIndex(index),
        name: "Channels".into(),
        entries: (1..=bits).map(|sub| entry(index, sub)).collect(),
        sync_manager: Some(sync_manager),
        fixed: true,
        mandatory: true,
    };
    let sync_manager = |usage, start, bits: u8, control| SyncManager {
        usage,
        start,
        default_bytes: u16::from(bits.div_ceil(8)),
        min_bytes: None,
        max_bytes: None,
        control,
        enable: 1,
    };
    DeviceDescription {
        vendor: Vendor { id: 2, name: "Terminals".into() },
        order_code: "T".into(),
        name: "Terminal".into(),
        product_code: 1,
        eeprom_bytes: 2_048,
        fmmus: vec![FmmuUsage::Outputs, FmmuUsage::Inputs],
        sync_managers: vec![
            sync_manager(SyncManagerType::Outputs, OUTPUTS_START, outputs, 0x64),
            sync_manager(SyncManagerType::Inputs, INPUTS_START, inputs, 0x20),
        ],
        rx_pdos: Some(pdo(0x1600, 0, outputs)).filter(|_| outputs > 0).into_iter().collect(),
        tx_pdos: Some(pdo(0x1A00, 1, inputs)).filter(|_| inputs > 0).into_iter().collect(),
        timeouts: Timeouts::default(),
        ..DeviceDescription::default()
    }
}

fn entry(pdo: u16, sub: u8) -> PdoEntry {
    let index = if pdo < 0x1A00 { 0x7000 } else { 0x6000 };
    let name = format!("Channel {sub}");
    PdoEntry {
        index: ObjectIndex(index),
        sub: SubIndex(sub),
        name,
        data_type: DataType::BOOLEAN,
        bit_length: 1,
    }
}

/// A master with terminals of so many outputs and inputs each.
pub(crate) fn terminals(master: Master, bits: &[(u8, u8)]) -> Connected<Slaves<Terminal>> {
    let units = bits.iter().map(|&(outputs, inputs)| {
        let areas =
            [(DataDirection::Outputs, OUTPUTS_START, outputs), (DataDirection::Inputs, INPUTS_START, inputs)];
        let process_data = (0..).map(SmIndex).zip(areas).map(|(sync_manager, (direction, start, bits))| {
            let length = DataLength::Fixed(u16::from(bits.div_ceil(8)));
            ProcessDataConfig { sync_manager, direction, start, length, buffers: Buffers::Three }
        });
        let config = DeviceConfig {
            sii_image: esi::sii::image(&description(outputs, inputs)),
            process_data: process_data.collect(),
            outputs_before_op: OutputsBeforeOp::Within(Duration::from_secs(1)),
            ..DeviceConfig::default()
        };
        (config, Terminal { outputs: 0, inputs: 0 })
    });
    Connected::new(master, Slaves::power_on(units), Instant::ZERO)
}
