//! The ESI files in `units/esi`: each is read without a finding, and its devices have SII images that are right.

use esi::file::EsiFile;
use esi::lint::rules::Level;
use esi::sii;

use crate::files;

#[test]
fn the_files_have_no_findings() {
    for name in files::NAMES.iter().filter(|name| **name != "minimal.xml") {
        assert_eq!(findings(&files::read(name)), [""; 0], "{name}");
    }
}

#[test]
fn what_a_file_leaves_out_is_named_with_the_value_that_is_used() {
    insta::assert_snapshot!(findings(&files::read("minimal.xml")).join("\n"), @"
    9:7: warning: the device has no revision number; read as 0 (E203)
    9:7: warning: the device does not say which ports it has; read as YY (E206)
    9:7: warning: the device has no group (E208)
    9:7: warning: the device has no ConfigData; the usual one is used (E902)
    ");
}

#[test]
fn the_images_of_the_devices_are_right() {
    for name in files::NAMES {
        for device in files::read(name).devices {
            let description = device.description();
            let image = sii::try_image(&description).unwrap();
            assert_eq!(sii::lint(&image), [], "{name}");
            assert_eq!(sii::compare(&image, &description), [], "{name}");
        }
    }
}

#[test]
fn the_devices_are_as_the_files_say() {
    let mut lines = Vec::new();
    for name in files::NAMES {
        let file = files::read(name);
        lines.push(format!("{name}: {} modules", file.modules.len()));
        for device in &file.devices {
            let description = device.description();
            let sizes: Vec<String> = (0..device.sync_managers.len() as u8)
                .map(|number| format!("{:?} {}", device.usage(number), device.default_pdo_bytes(number)))
                .collect();
            let objects = device.objects().iter().count();
            let (code, revision) = (&description.order_code, description.revision);
            lines.push(format!("  {code} 0x{revision:08X}: {}; {objects} objects", sizes.join(", ")));
        }
    }
    insta::assert_snapshot!(lines.join("\n"), @"
    analog-inputs.xml: 0 modules
      AI2 0x00010000: MailboxOut 0, MailboxIn 0, Outputs 0, Inputs 8; 0 objects
    boot.xml: 0 modules
      BOOT 0x00010000: MailboxOut 0, MailboxIn 0, Outputs 1, Inputs 1; 0 objects
    coupler.xml: 0 modules
      COUPLER 0x00010000: ; 0 objects
    digital-terminals.xml: 0 modules
      DO1 0x00010000: Outputs 1; 0 objects
      DI2 0x00010000: Inputs 1; 0 objects
      DO4 0x00010000: Outputs 1; 0 objects
      DI8 0x00010000: Inputs 1; 0 objects
      DI8 0x00020000: Inputs 1; 0 objects
      DO16 0x00010000: Outputs 1, Outputs 1; 0 objects
      DI16 0x00010000: Inputs 2; 0 objects
    drive.xml: 0 modules
      DRIVE 0x00010000: MailboxOut 0, MailboxIn 0, Outputs 6, Inputs 6; 0 objects
    encoder.xml: 0 modules
      ENCODER 0x00010000: MailboxOut 0, MailboxIn 0, Outputs 6, Inputs 6; 11 objects
    minimal.xml: 0 modules
      MINIMAL 0x00000000: Inputs 2; 0 objects
    mixed-bits.xml: 0 modules
      MIXED 0x00010000: Outputs 7, Inputs 29; 0 objects
    modular.xml: 6 modules
      MODULAR 0x00010000: MailboxOut 0, MailboxIn 0, Outputs 0, Inputs 0; 0 objects
    sensor.xml: 0 modules
      SENSOR 0x00010000: MailboxOut 0, MailboxIn 0, Outputs 0, Inputs 2; 5 objects
    two-input-areas.xml: 0 modules
      TWO-AREAS 0x00010000: Inputs 3, Inputs 4; 0 objects
    valves.xml: 0 modules
      VALVES 0x00010000: Outputs 1, Outputs 1, Outputs 1, Outputs 1; 0 objects
    ");
}

#[test]
fn the_text_in_english_goes_first() {
    let file = files::read("drive.xml");
    let [drive] = file.devices.as_slice() else { panic!("one device") };
    assert_eq!(drive.name, "Servo drive");
    assert_eq!(drive.rx_pdos[0].entries[1].name, "Target position");
}

fn findings(file: &EsiFile) -> Vec<String> {
    let told = file.findings.list().iter().filter(|finding| finding.rule.level > Level::Note);
    told.map(ToString::to_string).collect()
}
