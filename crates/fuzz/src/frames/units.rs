//! The units of a line.

use device::{DeviceConfig, Network};
use digital::{BitImages, Channels, Terminal, TerminalSettings};
use nx_ect101::unit_file::UnitFile;
use nx_ect101::{NxEct101, UnitSettings};

use super::even::{self, Even};
use super::step::Model;
use super::watched::Watched;

/// Units of several models with power.
pub(super) type Units = Network<Box<dyn Watched>>;

impl Watched for NxEct101 {}
impl Watched for Terminal<BitImages> {}

/// A unit without start-up time at this position of a line, and its stack.
pub(super) fn unit(model: Model, number: usize) -> (DeviceConfig, Box<dyn Watched>) {
    match model {
        Model::Nx => nx(number),
        Model::Even => (even::config(number), Box::new(Even::default())),
        Model::Terminal => terminal(),
    }
}

/// Units differ in the settings that the unit file permits.
fn nx(number: usize) -> (DeviceConfig, Box<dyn Watched>) {
    let lenient = if number.is_multiple_of(2) { "" } else { "outputs_before_op = \"not-required\"\n" };
    let text = format!("model = \"nx-ect101\"\ntiming = \"fast\"\nid_switch = {}\n{lenient}", number + 1);
    let settings = UnitFile::parse(&text).map(|file| UnitSettings::from_unit_file(&file)).unwrap_or_default();
    (nx_ect101::device_config(&settings), Box::new(NxEct101::power_on(&settings).0))
}

fn terminal() -> (DeviceConfig, Box<dyn Watched>) {
    let channels = |count| Channels::new(count).unwrap_or_default();
    let settings =
        TerminalSettings { inputs: channels(16), outputs: channels(12), ..TerminalSettings::default() };
    let wiring = BitImages { inputs: 0x5AA5, outputs: 0 };
    (digital::device_config(&settings), Box::new(Terminal::power_on(&settings, wiring)))
}
