use ectwin::{AlState, AlStatusCode, Duration, EventCode, EventLevel, Fault, Setup, Twin};

const PROCESSING_ERROR: EventCode = EventCode(0x4020_0000);
const A_WHILE: Duration = Duration::from_millis(10);
/// The time that the unit needs to restart, with a margin.
const START_UP: Duration = Duration::from_millis(310);

#[test]
fn a_unit_that_fails_says_so_and_comes_back_when_it_is_restarted() {
    // The time stamps of events come from the CPU Unit.
    let setup = Setup::from_toml("model = \"nx-ect101\"").unwrap();
    let mut twin = Twin::power_on([setup.system_time_ns(1_800_000_000_000_000_000)]);
    twin.run_for(A_WHILE);

    // The cause appears, and the unit detects it: INIT with the error indication.
    twin.unit(0).inject(Fault::Processing);
    twin.run_for(A_WHILE);
    let mut side = twin.unit(0);
    assert_eq!((side.state(), side.al_status().error), (AlState::Init, true));
    assert_eq!(side.al_status_code(), AlStatusCode(0x0001));

    // The log, as 10F3 shows it to the master, and the current errors of 2004.
    let record = side.error_log().history().last().unwrap();
    assert_eq!(record.event, PROCESSING_ERROR);
    assert_eq!(record.time_ns, 1_800_000_000_010_000_000);
    assert_eq!(record.diagnosis_message()[..8], [0x00, 0xE8, 0x50, 0x61, 0x12, 0x02, 0x20, 0x40]);
    assert_eq!(side.current_errors(EventLevel::MinorFault)[0].event, PROCESSING_ERROR);
    assert_eq!(side.error_status(), 0x20);

    // The recovery is on its page in docs/events: remove the cause and restart the unit.
    side.remove(Fault::Processing);
    side.restart();
    twin.run_for(START_UP);
    let side = twin.unit(0);
    assert_eq!(side.al_status_code(), AlStatusCode(0x0060), "slave restarted locally");
    assert_eq!((side.error_status(), side.error_log().history().count()), (0, 1), "the log remembers");
}
