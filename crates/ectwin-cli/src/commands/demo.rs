//! `ectwin demo`: a unit and an ethercrab master in this process, and their exchange.

mod exchange;
mod group;
mod step;
mod story;

use std::time::Duration;

use ectwin::{Live, Setup, Twin, UnitFile};
use ethercrab::std::ethercat_now;
use ethercrab::subdevice_group::PreOp;
use ethercrab::{MainDevice, MainDeviceConfig, PduStorage, RetryBehaviour, Timeouts};
use link::Statistics;
use plant::default_model;

use crate::failure::Failure;
use exchange::Exchanged;
use group::{Group, MAX_PROCESS_DATA_BYTES, MAX_UNITS};
use step::{failed, master_failed};
use story::Story;

const MAX_FRAMES: usize = 16;
const FRAME_BYTES: usize = PduStorage::element_size(1100);

static STORAGE: PduStorage<MAX_FRAMES, FRAME_BYTES> = PduStorage::new();

/// What the file of the unit has beside its model.
const CPU: &str = "[cpu]\nprogram = \"builtin:copy\"";

/// Runs the demo for a few seconds.
pub(crate) fn run() -> Result<(), Failure> {
    let runtime = tokio::runtime::Builder::new_current_thread().enable_time().build();
    let runtime = runtime.map_err(|error| failed("starting the master", error))?;
    runtime.block_on(demo())
}

async fn demo() -> Result<(), Failure> {
    let device = default_model().tables().device;
    let story = Story::begin(&format!(
        "a virtual {device} and the ethercrab master in one process, on a link in memory"
    ))?;
    let setup = Setup::from_toml(&format!("{}\n{CPU}", UnitFile::factory_text()))
        .map_err(|error| failed("reading the unit file", error))?;
    let (tx, rx, pdu_loop) =
        STORAGE.try_split().map_err(|()| failed("starting the master", "started twice"))?;
    let live = Twin::power_on([setup]).serve_ethercrab(tx, rx);
    let live = live.map_err(|error| failed("switching the unit on", error))?;
    story.tell("power on", "unit N1 at its factory setting; its CPU Unit copies what the master sends")?;

    let master = MainDevice::new(pdu_loop, timeouts(), master_config());
    let exchanged = bring_up_and_exchange(&master, &live, &story).await?;

    let statistics = live.stop().map_err(|error| failed("switching the unit off", error))?;
    conclude(&story, &exchanged, &statistics)
}

async fn bring_up_and_exchange(
    master: &MainDevice<'static>,
    live: &Live,
    story: &Story,
) -> Result<Exchanged, Failure> {
    let group = master.init_single_group::<MAX_UNITS, MAX_PROCESS_DATA_BYTES>(ethercat_now).await;
    let group = group.map_err(master_failed("INIT to PRE-OP"))?;
    tell_identity(master, &group, story).await?;
    let first_input = exchange::position_of_data(master, &group).await?;

    let group = group.into_safe_op(master).await.map_err(master_failed("PRE-OP to SAFE-OP"))?;
    let (outputs_bytes, inputs_bytes) = exchange::sizes(master, &group)?;
    story.tell("SAFE-OP", &format!("{outputs_bytes} bytes out, {inputs_bytes} bytes in"))?;

    let group = exchange::into_op(master, group).await?;
    story
        .tell("OP", "a cycle each millisecond; every word of the outputs carries the number of its cycle")?;
    let exchanged = exchange::run(master, &group, first_input, story).await?;

    let (state, word) = live.look(0, |unit| (unit.state(), unit.io().uints(1).map(|uints| uints[0])));
    let word = word.ok_or_else(|| failed("looking at the unit", "UINTs 01 are not allocated"))?;
    story.tell(
        "unit's side",
        &format!("it is in {state}; its CPU Unit has {word} in N1_UINTs_01_M_to_C[0]"),
    )?;

    let _stopped = group.into_safe_op(master).await.map_err(master_failed("OP to SAFE-OP"))?;
    story.tell("SAFE-OP", "the master has stopped the exchange")?;
    Ok(exchanged)
}

async fn tell_identity(
    master: &MainDevice<'static>,
    group: &Group<PreOp>,
    story: &Story,
) -> Result<(), Failure> {
    let unit = group.subdevice(master, 0).map_err(master_failed("finding the unit"))?;
    let (address, name, identity) = (unit.configured_address(), unit.name(), unit.identity());
    story
        .tell("PRE-OP", &format!("found {} unit: {name} at station address 0x{address:04X}", group.len()))?;
    let (vendor, product) = (identity.vendor_id, identity.product_id);
    let (revision, serial) = (identity.revision, identity.serial);
    story.more(format_args!(
        "vendor 0x{vendor:08X}, product 0x{product:08X}, revision 0x{revision:08X}, serial {serial}"
    ))?;
    let by_sdo: u32 = unit.sdo_read(0x1018, 4).await.map_err(master_failed("reading object 0x1018:04"))?;
    story.more(format_args!("by SDO: serial number (0x1018:04) is {by_sdo}"))
}

fn conclude(story: &Story, exchanged: &Exchanged, statistics: &Statistics) -> Result<(), Failure> {
    story.tell("done", &exchanged.to_string())?;
    let seconds = story.elapsed().as_secs_f64();
    let rate = statistics.frames as f64 / seconds;
    story.more(format_args!(
        "{} frames answered in {seconds:.1} s, {rate:.0} each second",
        statistics.frames
    ))?;
    story.more(format_args!(
        "next: `ectwin run units/{}.toml --link udp:127.0.0.1`, and your own master",
        default_model().name()
    ))
}

/// With long time-outs: a machine that is busy with other work must not cause a failure.
fn timeouts() -> Timeouts {
    Timeouts {
        pdu: Duration::from_millis(500),
        eeprom: Duration::from_millis(500),
        state_transition: Duration::from_secs(10),
        mailbox_echo: Duration::from_secs(2),
        mailbox_response: Duration::from_secs(2),
        ..Timeouts::default()
    }
}

fn master_config() -> MainDeviceConfig {
    // A single unit has no other clock to synchronize with: a short synchronization is sufficient.
    MainDeviceConfig { dc_static_sync_iterations: 100, retry_behaviour: RetryBehaviour::None }
}
