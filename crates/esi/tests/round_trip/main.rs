//! Any device → ESI file → the same device: description, dictionary, and so the SII.

mod descriptions;
mod dictionaries;

use esi::file::EsiFile;
use proptest::prelude::*;

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_device_is_read_as_it_was_written(
        description in descriptions::description(),
        table in dictionaries::dictionary(),
    ) {
        let text = esi::xml(&description, &table);
        let file = EsiFile::read(text.as_bytes(), &|_| None).unwrap();
        prop_assert_eq!(file.devices.len(), 1);
        let device = &file.devices[0];
        prop_assert_eq!(device.description(), description, "{}", text);
        prop_assert_eq!(device.objects(), table, "{}", text);
    }
}
