//! Without a master library: frames as bytes, virtual time, the unit's side.

use ectwin::{AlState, AlStatusCode, Duration, FrameFate, Setup, SetupError, Twin};

const UNIT: &str = "model = \"nx-ect101\"";

/// APWR or APRD of a register of the first unit, as one frame. Returns data and working counter.
fn register(twin: &mut Twin, command: u8, offset: u16, data: [u8; 2]) -> ([u8; 2], u16) {
    let mut frame = [0; 60];
    frame[12..14].copy_from_slice(&[0x88, 0xA4]);
    frame[14..16].copy_from_slice(&[14, 0x10]);
    frame[16] = command;
    frame[20..22].copy_from_slice(&offset.to_le_bytes());
    frame[22] = 2;
    frame[26..28].copy_from_slice(&data);
    assert_eq!(twin.frame(&mut frame), FrameFate::Returned);
    ([frame[26], frame[27]], u16::from_le_bytes([frame[28], frame[29]]))
}

const APRD: u8 = 1;
const APWR: u8 = 2;
const AL_CONTROL: u16 = 0x0120;
const AL_STATUS: u16 = 0x0130;
const AL_STATUS_CODE: u16 = 0x0134;

#[test]
fn a_state_that_cannot_be_reached_is_refused_on_both_sides() {
    let mut twin = Twin::from_toml(UNIT).unwrap();
    assert_eq!(twin.unit(0).state(), AlState::Init);
    assert_eq!(register(&mut twin, APWR, AL_CONTROL, [8, 0]).1, 1);
    twin.run_for(Duration::from_millis(1));
    assert_eq!(register(&mut twin, APRD, AL_STATUS, [0; 2]), ([0x11, 0], 1));
    assert_eq!(register(&mut twin, APRD, AL_STATUS_CODE, [0; 2]), ([0x11, 0], 1));
    let side = twin.unit(0);
    assert!(side.al_status().error);
    assert_eq!(side.al_status_code(), AlStatusCode::INVALID_REQUESTED_STATE_CHANGE);
}

#[test]
fn time_passes_only_when_it_is_told_to() {
    let mut twin = Twin::from_toml(UNIT).unwrap();
    let power_on = twin.now();
    register(&mut twin, APRD, AL_STATUS, [0; 2]);
    assert_eq!(twin.now(), power_on);
    twin.run_for(Duration::from_secs(3600));
    assert_eq!(twin.now(), power_on + Duration::from_secs(3600));
}

#[test]
fn each_unit_of_a_line_has_its_own_side() {
    let mut twin = Twin::power_on((0..3).map(|_| Setup::from_toml(UNIT).unwrap()));
    assert_eq!(twin.len(), 3);
    for position in 0..3 {
        assert_eq!(twin.unit(position).outputs().len(), 180);
    }
}

#[test]
fn a_bad_unit_file_tells_where() {
    let Err(SetupError::UnitFile(errors)) = Twin::from_toml("model = \"nx-ect101\"\nserail = 1\n") else {
        panic!("it was taken")
    };
    let error = errors.iter().next().unwrap();
    assert_eq!((error.line, error.column, error.nearest.as_deref()), (2, 1, Some("serial")));
}

#[test]
fn a_text_has_no_folder_to_find_a_program_in() {
    let text = "model = \"nx-ect101\"\n[cpu]\nprogram = \"echo.st\"\n";
    let error = Twin::from_toml(text).unwrap_err();
    assert!(
        matches!(&error, SetupError::ProgramUnreadable { span: Some(span), .. } if text[span.clone()] == *"\"echo.st\""),
        "{error}"
    );
}
