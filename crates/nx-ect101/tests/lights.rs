//! The light test: every row of the manual's table of indicators.
//!
//! The expectations are written by hand from the manual, 8-2-2; they do not come from the tables of the crate.

use coe_kit::indicators::{Pattern, PortCondition};
use nx_ect101::{Event, EventCode, Indicator, IndicatorCauses, Indicators, Lights, NxCondition};
use proptest::prelude::*;
use time::{Duration, Instant};
use wire::{AlState, AlStatusCode};

/// A unit in OP with both cables, without errors.
const NORMAL: IndicatorCauses = IndicatorCauses {
    power: true,
    nx: NxCondition::Normal,
    state: AlState::Op,
    al_error: None,
    esc_error: false,
    in_port: PortCondition::Active,
    out_port: PortCondition::Link,
};

/// Manual, 8-2-2: RUN, ERR, TS green, TS red, cause; in the abbreviations of 8-2-1, `---` for undefined. Values
/// that are printed in the wrong column are in the correct one here.
const ROWS: &str = "
Lit      Not_Lit  Lit      Not_Lit  normal
Not_Lit  Not_Lit  FS_2s    Not_Lit  initializing
Not_Lit  Not_Lit  Not_Lit  Not_Lit  no_power
Not_Lit  Not_Lit  Not_Lit  Not_Lit  waiting
Not_Lit  Lit      Not_Lit  Lit      hardware_failure
Not_Lit  Not_Lit  Not_Lit  Lit      cpu_unit_malfunction
Not_Lit  Not_Lit  Not_Lit  Lit      00200000
Not_Lit  Not_Lit  Not_Lit  Lit      10410000
Not_Lit  Not_Lit  Not_Lit  Lit      40200000
Not_Lit  Not_Lit  Not_Lit  Lit      80240000
Not_Lit  Not_Lit  Not_Lit  FS_1s    80200000
Lit      Not_Lit  Lit      Not_Lit  39170000
Lit      Not_Lit  Lit      Not_Lit  39160000
---      ---      Not_Lit  ---      39190000
---      ---      Not_Lit  ---      39130000
---      ---      Not_Lit  ---      391B0000
---      ---      Not_Lit  ---      391A0000
---      ---      Not_Lit  ---      391D0000
---      ---      Not_Lit  ---      391C0000
---      B        ---      ---      09460000
---      B        ---      ---      39340000
---      B        ---      ---      350B0000
---      B        ---      ---      350C0000
---      SF       ---      ---      94B80000
---      FK       ---      ---      09450000
B        B        ---      ---      35050000
B        B        ---      ---      35060000
B        B        ---      ---      35070000
B        B        ---      ---      35090000
B        B        ---      ---      350A0000
B        B        ---      ---      35180000
B        B        ---      ---      39140000
B        B        ---      ---      39150000
B        B        ---      ---      391E0000
B        B        ---      ---      391F0000
B        B        ---      ---      392C0000
B        B        ---      ---      392D0000
B        B        ---      ---      392E0000
B        B        ---      ---      392F0000
B        B        ---      ---      39320000
B        B        ---      ---      39330000
SF       DF       ---      ---      85000000
";

fn at_ms(millis: u64) -> Instant {
    Instant::ZERO + Duration::from_millis(millis)
}

/// The state in a row of the manual, or else each state.
fn states(run: &str) -> Vec<AlState> {
    match run {
        "Lit" => vec![AlState::Op],
        "SF" => vec![AlState::SafeOp],
        "B" => vec![AlState::PreOp],
        "Not_Lit" => vec![AlState::Init],
        _ => AlState::ALL.to_vec(),
    }
}

/// The causes of a row, in a state.
fn causes(cause: &str, state: AlState) -> IndicatorCauses {
    let causes = IndicatorCauses { state, ..NORMAL };
    let nx = |nx| IndicatorCauses { nx, ..causes };
    match cause {
        "normal" => causes,
        "no_power" => IndicatorCauses { power: false, ..causes },
        "initializing" => nx(NxCondition::Initializing),
        "waiting" => nx(NxCondition::WaitingForInitialization),
        "hardware_failure" => nx(NxCondition::HardwareFailure),
        "cpu_unit_malfunction" => nx(NxCondition::CpuUnitMalfunction),
        code => event_causes(code, causes),
    }
}

fn event_causes(code: &str, causes: IndicatorCauses) -> IndicatorCauses {
    let code = u32::from_str_radix(code, 16).map(EventCode);
    let Some(event) = code.ok().and_then(Event::find) else { panic!("no such event") };
    let nx = NxCondition::Error(event.code);
    let esc_error = event.code == Event::ESC_ERROR;
    IndicatorCauses { nx, al_error: event.al_status_code, esc_error, ..causes }
}

/// In the manual's abbreviations.
fn abbreviation(pattern: Pattern) -> &'static str {
    match pattern {
        Pattern::NotLit => "Not_Lit",
        Pattern::Lit => "Lit",
        Pattern::Flickering => "FK",
        Pattern::Blinking => "B",
        Pattern::SingleFlash => "SF",
        Pattern::DoubleFlash => "DF",
        Pattern::Flashing1s => "FS_1s",
        Pattern::Flashing2s => "FS_2s",
    }
}

/// The row as the unit shows it; undefined values of the manual are ignored.
fn shown(row: &str, state: AlState) -> String {
    let words: Vec<&str> = row.split_whitespace().collect();
    let Some((cause, columns)) = words.split_last() else { panic!("an empty row") };
    let shown = Indicators::of(&causes(cause, state));
    let patterns = [shown.run, shown.err, shown.ts_green, shown.ts_red].map(abbreviation);
    let column = |(&printed, shown)| format!("{:<9}", if printed == "---" { "---" } else { shown });
    columns.iter().zip(patterns).map(column).chain([(*cause).to_owned()]).collect()
}

#[test]
fn every_row_of_the_manual_is_shown() {
    for row in ROWS.trim().lines() {
        for state in states(row.split_whitespace().next().unwrap()) {
            assert_eq!(shown(row, state), row, "in {state}");
        }
    }
}

/// The two events without a row change nothing.
#[test]
fn every_event_has_a_row_or_shows_nothing() {
    let without: Vec<EventCode> = Event::all()
        .iter()
        .map(|event| event.code)
        .filter(|code| !ROWS.contains(&code.to_string()))
        .inspect(|&code| {
            let causes = IndicatorCauses { nx: NxCondition::Error(code), ..NORMAL };
            assert_eq!(Indicators::of(&causes), Indicators::of(&NORMAL), "{code}");
        })
        .collect();
    assert_eq!(without, [Event::MESSAGE_COMMUNICATIONS_ERROR, Event::EVENT_LOG_CLEARED]);
}

#[test]
fn events_that_share_an_al_status_code_share_the_pattern_of_err() {
    for event in Event::all().iter().filter(|event| event.al_status_code.is_some()) {
        let alike = Event::all().iter().filter(|other| other.al_status_code == event.al_status_code);
        alike.for_each(|other| assert_eq!(other.err, event.err, "{} and {}", event.code, other.code));
    }
}

/// So ERR needs no other input than ESC Error in addition to the AL status code.
#[test]
fn an_event_that_lights_err_has_an_al_status_code_or_is_esc_error() {
    for event in Event::all() {
        let lights = event.err.pattern().is_some_and(|pattern| pattern != Pattern::NotLit);
        let told = event.al_status_code.is_some() || event.code == Event::ESC_ERROR;
        assert!(!lights || told, "{}", event.code);
    }
}

#[test]
fn a_code_of_no_event_blinks_and_esc_error_comes_before_all_codes() {
    let refused = Some(AlStatusCode::BOOTSTRAP_NOT_SUPPORTED);
    let causes = IndicatorCauses { al_error: refused, ..NORMAL };
    assert_eq!(Indicators::of(&causes).err, Pattern::Blinking);
    let both = IndicatorCauses { esc_error: true, ..causes };
    assert_eq!(Indicators::of(&both).err, Pattern::Flickering);
}

#[test]
fn l_a_follows_the_port_whatever_else_is_wrong() {
    for nx in [NxCondition::Normal, NxCondition::HardwareFailure, NxCondition::WaitingForInitialization] {
        let shown = Indicators::of(&IndicatorCauses { nx, ..NORMAL });
        assert_eq!((shown.la_in, shown.la_out), (Pattern::Flickering, Pattern::Lit));
    }
    let unplugged = PortCondition::new(false, true);
    let shown = Indicators::of(&IndicatorCauses { in_port: unplugged, ..NORMAL });
    assert_eq!((unplugged, shown.la_in), (PortCondition::NoLink, Pattern::NotLit));
}

#[test]
fn ts_tells_the_most_severe_condition_and_of_equals_the_first() {
    let error = |code| NxCondition::Error(EventCode(code));
    let rising = [
        NxCondition::Normal,
        error(0x3917_0000),
        error(0x3919_0000),
        NxCondition::Initializing,
        error(0x8020_0000),
        error(0x8024_0000),
        NxCondition::WaitingForInitialization,
        NxCondition::HardwareFailure,
    ];
    for (index, &lower) in rising.iter().enumerate() {
        for &higher in &rising[index..] {
            assert_eq!((lower.or_worse(higher), higher.or_worse(lower)), (higher, higher));
        }
    }
    let equal = [error(0x4020_0000), error(0x8024_0000)];
    assert_eq!(equal[0].or_worse(equal[1]), equal[0]);
}

/// A restart as an observer sees it: off, then TS flashes, then it is lit while ERR shows the restart.
#[test]
fn a_restart_goes_dark_flashes_and_ends_with_a_single_flash_of_err() {
    let step = |nx, al_error| IndicatorCauses { nx, al_error, state: AlState::Init, ..NORMAL };
    let restarted = Some(AlStatusCode::SLAVE_RESTARTED_LOCALLY);
    let drawn = |causes: IndicatorCauses| {
        let shown = Indicators::of(&causes);
        [shown.ts_green, shown.err].map(abbreviation)
    };
    assert_eq!(drawn(step(NxCondition::WaitingForInitialization, restarted)), ["Not_Lit", "Not_Lit"]);
    assert_eq!(drawn(step(NxCondition::Initializing, None)), ["FS_2s", "Not_Lit"]);
    assert_eq!(drawn(step(NxCondition::Normal, restarted)), ["Lit", "SF"]);
}

#[test]
fn lights_are_what_the_patterns_say_at_that_moment() {
    let causes = IndicatorCauses {
        state: AlState::SafeOp,
        al_error: Some(AlStatusCode::SYNC_MANAGER_WATCHDOG),
        ..NORMAL
    };
    let shown = Indicators::of(&causes);
    let lights = Lights { err: true, la_in: true, la_out: true, ts_green: true, ..Lights::default() };
    assert_eq!(shown.lights(at_ms(400)), lights);
    assert_eq!(shown.next_change(at_ms(400)), at_ms(450), "L/A IN flickers");
    assert_eq!(Indicators::DARK.lights(at_ms(0)), Lights::default());
    assert_eq!(Indicators::DARK.next_change(at_ms(0)), Instant::NEVER);
}

fn any_nx() -> impl Strategy<Value = NxCondition> {
    let event = (0..Event::all().len()).prop_map(|index| NxCondition::Error(Event::all()[index].code));
    prop_oneof![
        event,
        any::<u32>().prop_map(|code| NxCondition::Error(EventCode(code))),
        prop::sample::select(vec![
            NxCondition::WaitingForInitialization,
            NxCondition::Initializing,
            NxCondition::Normal,
            NxCondition::CpuUnitMalfunction,
            NxCondition::HardwareFailure,
        ]),
    ]
}

proptest! {
    /// Manual, 8-2-2: TS is never green and red at once.
    #[test]
    fn ts_is_never_green_and_red(
        power in any::<bool>(),
        nx in any_nx(),
        state in (0u16..16).prop_map(AlState::from_bits),
        al_error in prop::option::of(any::<u16>().prop_map(AlStatusCode)),
        esc_error in any::<bool>(),
    ) {
        let shown = Indicators::of(&IndicatorCauses { power, nx, state, al_error, esc_error, ..NORMAL });
        prop_assert!([shown.ts_green, shown.ts_red].contains(&Pattern::NotLit));
    }
}

/// Without an event, RUN, ERR and L/A follow the standard; the table contains the meaning of each pattern.
#[test]
fn the_table_has_a_row_for_every_pattern_that_can_be_shown() {
    let has = |name: &str, pattern| {
        let indicator = Indicator::all().iter().find(|row| row.names.iter().any(|known| known == name));
        indicator.is_some_and(|row| row.status.iter().any(|status| status.pattern == pattern))
    };
    for state in [AlState::Init, AlState::PreOp, AlState::SafeOp, AlState::Op] {
        assert!(has("RUN", Indicators::of(&IndicatorCauses { state, ..NORMAL }).run), "{state}");
    }
    for code in (0..0x100).map(AlStatusCode) {
        let shown = Indicators::of(&IndicatorCauses { al_error: Some(code), ..NORMAL }).err;
        assert!(has("ERR", shown), "{code}");
    }
    assert!(PortCondition::ALL.into_iter().all(|port| has("L/A IN", port.pattern())));
}
